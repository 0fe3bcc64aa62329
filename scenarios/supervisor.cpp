#include "scenarios/supervisor.h"

#include <execinfo.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <string_view>
#include <utility>

#include "base/error.h"

namespace alula::scenarios {
namespace {

constexpr std::int64_t kGlance = 50'000'000;           // ns between looks at a process
constexpr std::int64_t kGlanceAtMemory = 10'000'000;   // memory can be taken fast
constexpr std::int64_t kTimeForTrace = 2'000'000'000;  // that a hanging process has to write its stack

/// A page of zeros that a fork does not copy.
class SharedPulse {
 public:
  SharedPulse() {
    void* const page = ::mmap(nullptr, sizeof(Pulse), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (page == MAP_FAILED) throw base::FaultError("memory", "no shared page for the supervisor");
    pulse_ = new (page) Pulse;
  }
  ~SharedPulse() { ::munmap(pulse_, sizeof(Pulse)); }
  SharedPulse(const SharedPulse&) = delete;
  SharedPulse& operator=(const SharedPulse&) = delete;
  Pulse& operator*() const { return *pulse_; }

 private:
  Pulse* pulse_;
};

std::uint64_t ResidentBytes(pid_t pid) {
  std::FILE* const file = std::fopen(("/proc/" + std::to_string(pid) + "/statm").c_str(), "r");
  if (file == nullptr) return 0;
  unsigned long long size = 0, resident = 0;
  const int read = std::fscanf(file, "%llu %llu", &size, &resident);
  std::fclose(file);
  return read == 2 ? resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

std::string SignalText(int signal) {
  const char* const name = ::sigdescr_np(signal);
  return "signal " + std::to_string(signal) + (name == nullptr ? "" : std::string(" (") + name + ")");
}

std::string Seconds(base::Duration duration) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g s", duration.Seconds());
  return text.data();
}

/// The watching side.
class Watch {
 public:
  Watch(pid_t pid, const Limits& limits, const Pulse& pulse) : pid_(pid), limits_(limits), pulse_(pulse) {}

  Ending UntilTheEnd() {
    while (!Ended()) {
      Sleep();
      if (!reason_.empty()) continue;  // it is being killed
      JudgeTime();
      JudgeMemory();
    }
    return Result();
  }

 private:
  bool Ended() { return ::waitpid(pid_, &status_, WNOHANG) == pid_; }

  /// Until the process ends or the next look is due. What the process has slept through (Ctrl-Z) is not counted.
  void Sleep() {
    const std::int64_t glance = limits_.memory ? kGlanceAtMemory : kGlance;
    const timespec timeout{0, static_cast<long>(glance)};
    const sigset_t signals = WatchedSignals();
    siginfo_t info;
    const int signal = ::sigtimedwait(&signals, &info, &timeout);
    if (signal == SIGINT || signal == SIGTERM) PassOn(signal, info);
    if (signal > 0) return;
    wall_ns_ += glance;
    still_ns_ += glance;
    if (!reason_.empty() && still_ns_ >= kTimeForTrace) ::kill(pid_, SIGKILL);
  }

  /// A terminal tells all of its processes by itself. A second request does not wait for the work to agree.
  void PassOn(int signal, const siginfo_t& info) {
    if (interrupted_) {
      ::kill(pid_, SIGKILL);
    } else if (info.si_code != SI_KERNEL) {
      ::kill(pid_, signal);
    }
    interrupted_ = true;
  }

  void JudgeTime() {
    const std::int64_t simulated = pulse_.simulated_ns.load(std::memory_order_relaxed);
    if (simulated != seen_ns_) still_ns_ = 0;
    seen_ns_ = simulated;
    if (still_ns_ >= limits_.stall.ns) {
      Kill("hang", "no step of the simulation in " + Seconds(limits_.stall) + " of wall time", SIGABRT);
    } else if (limits_.wall && wall_ns_ >= limits_.wall->ns) {
      Kill("hang", "still running after " + Seconds(*limits_.wall) + " of wall time", SIGABRT);
    }
  }

  void JudgeMemory() {
    if (!limits_.memory || !reason_.empty()) return;
    const std::uint64_t resident = ResidentBytes(pid_);
    if (resident <= *limits_.memory) return;
    const auto megabytes = [](std::uint64_t bytes) { return std::to_string(bytes / 1'000'000) + " MB"; };
    Kill("memory", "took " + megabytes(resident) + "; the limit is " + megabytes(*limits_.memory), SIGKILL);
  }

  void Kill(const char* reason, std::string message, int signal) {
    reason_ = reason;
    message_ = std::move(message);
    still_ns_ = 0;
    ::kill(pid_, signal);
  }

  Ending Result() const {
    Ending ending;
    ending.pid = pid_;
    ending.interrupted = interrupted_;
    const base::Time simulated{pulse_.simulated_ns.load()};
    if (!reason_.empty()) {
      ending.death = Death{reason_, message_, simulated};
    } else if (WIFSIGNALED(status_)) {
      const int signal = WTERMSIG(status_);
      const std::string text = SignalText(signal);
      if (signal == SIGKILL) {
        ending.death = Death{"killed", "killed from outside by " + text + "; was memory short?", simulated};
      } else {
        ending.death = Death{"crash", "died of " + text, simulated};
      }
    } else if (!pulse_.finished.load()) {
      const std::string code = std::to_string(WEXITSTATUS(status_));
      ending.death = Death{"exit", "the process ended itself in the middle, with exit code " + code, simulated};
    } else {
      ending.report.exit_code = WEXITSTATUS(status_);
    }
    if (ending.interrupted) ending.death.reset();
    return ending;
  }

  pid_t pid_;
  Limits limits_;
  const Pulse& pulse_;
  int status_ = 0;
  std::int64_t wall_ns_ = 0;
  std::int64_t still_ns_ = 0;  // since the simulation was last seen to step, or since it was told to die
  std::int64_t seen_ns_ = 0;
  std::string reason_, message_;
  bool interrupted_ = false;
};

/// A nameless file through which a process hands its report to its supervisor.
class ReportFile {
 public:
  ReportFile() : file_(::memfd_create("alula_report", MFD_CLOEXEC)) {
    if (file_ < 0) throw base::FaultError("process", std::string("no file for the report: ") + std::strerror(errno));
  }
  ~ReportFile() { ::close(file_); }
  ReportFile(const ReportFile&) = delete;
  ReportFile& operator=(const ReportFile&) = delete;

  void Write(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = ::write(file_, text.data(), text.size());
      if (written <= 0) throw base::FaultError("memory", "the report could not be handed over");
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  std::string Read() const {
    std::string text(static_cast<std::size_t>(::lseek(file_, 0, SEEK_END)), '\0');
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, ::pread(file_, text.data(), text.size(), 0))));
    return text;
  }

 private:
  int file_;
};

[[noreturn]] void BeTheProcess(pid_t supervisor, const Limits& limits, const sigset_t& mask, Pulse& pulse,
                               const ReportFile& file, const std::function<Report(Pulse&)>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != supervisor) std::_Exit(0);
  ::sigprocmask(SIG_SETMASK, &mask, nullptr);
  if (limits.memory) {  // the supervisor looks from time to time; this stops what is faster
    const rlimit most{2 * *limits.memory, 2 * *limits.memory};
    ::setrlimit(RLIMIT_DATA, &most);
  }
  const Report report = work(pulse);
  file.Write(report.text);
  std::fflush(nullptr);
  pulse.finished.store(true);
  std::_Exit(report.exit_code);
}

std::array<char, 4096> trace_file{};

/// Nothing here takes memory or a lock: backtrace() was loaded when the handler was set.
void WriteStack(int signal) {
  const int file = ::open(trace_file.data(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file >= 0) {
    const char* const name = ::sigdescr_np(signal);
    if (name != nullptr && ::write(file, name, std::strlen(name)) >= 0 && ::write(file, "\n", 1) == 1) {
      std::array<void*, 64> frames{};
      ::backtrace_symbols_fd(frames.data(), ::backtrace(frames.data(), frames.size()), file);
    }
    ::close(file);
  }
  ::raise(signal);  // the handler is gone by now (SA_RESETHAND): the process dies as it would have
}

}  // namespace

sigset_t WatchedSignals() {
  sigset_t signals;
  ::sigemptyset(&signals);
  for (const int signal : {SIGCHLD, SIGINT, SIGTERM}) ::sigaddset(&signals, signal);
  return signals;
}

Ending Supervise(const Limits& limits, const std::function<Report(Pulse&)>& work) {
  const SharedPulse pulse;
  const ReportFile file;
  const sigset_t signals = WatchedSignals();
  sigset_t before;
  ::sigprocmask(SIG_BLOCK, &signals, &before);
  std::fflush(nullptr);
  const pid_t supervisor = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0) throw base::FaultError("process", std::string("cannot start a process: ") + std::strerror(errno));
  if (pid == 0) BeTheProcess(supervisor, limits, before, *pulse, file, work);
  Ending ending = Watch(pid, limits, *pulse).UntilTheEnd();
  ending.report.text = file.Read();
  ::sigprocmask(SIG_SETMASK, &before, nullptr);
  return ending;
}

void LeaveStackTraceIn(const std::filesystem::path& file) {
  const std::string name = std::filesystem::absolute(file).string();
  if (name.size() >= trace_file.size()) return;  // no run folder has such a name
  std::copy(name.begin(), name.end(), trace_file.begin());
  std::array<void*, 1> frame{};
  ::backtrace(frame.data(), frame.size());  // loads what it needs, now and not in the handler

  static std::array<char, 64 * 1024> stack;  // of its own: a stack that overflowed is no place to work
  const stack_t alternative{stack.data(), 0, stack.size()};
  ::sigaltstack(&alternative, nullptr);
  struct sigaction action = {};
  action.sa_handler = WriteStack;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_ONSTACK | SA_NODEFER);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::sigaction(signal, &action, nullptr);
}

}  // namespace alula::scenarios

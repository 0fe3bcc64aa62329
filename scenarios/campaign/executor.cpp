#include "scenarios/campaign/executor.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "scenarios/exit_codes.h"

namespace alula::scenarios::campaign {
namespace fs = std::filesystem;
namespace {

std::string ReadText(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void WriteText(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw base::FaultError("disk", "cannot write " + file.string() + ": " + std::strerror(errno));
}

/// The last line that says something.
std::string LastLine(const std::string& text) {
  const std::size_t end = text.find_last_not_of("\r\n ");
  if (end == std::string::npos) return {};
  const std::size_t begin = text.find_last_of("\r\n", end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

/// Between fork and exec.
[[noreturn]] void BecomeRun(std::vector<std::string> arguments, const fs::path& errors, pid_t parent,
                            const sigset_t& mask) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) std::_Exit(kExitFault);
  const int nowhere = ::open("/dev/null", O_RDWR);
  const int log = ::open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (nowhere < 0 || log < 0) std::_Exit(kExitFault);
  ::dup2(nowhere, STDIN_FILENO);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  ::sigprocmask(SIG_SETMASK, &mask, nullptr);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::execv("/proc/self/exe", argv.data());
  std::_Exit(kExitFault);
}

}  // namespace

std::string ProgramHash() {
  const std::string bytes = ReadText("/proc/self/exe");
  base::RollingHash hash;
  hash.Add(std::string_view(bytes));
  return hash.Hex();
}

Executor::Executor(ExecutorOptions options) : options_(std::move(options)), program_(ProgramHash()) {
  const sigset_t signals = WatchedSignals();
  ::sigprocmask(SIG_BLOCK, &signals, &mask_before_);
}

Executor::~Executor() {
  for (const auto& [pid, flight] : flying_) ::kill(pid, SIGTERM);
  for (const auto& [pid, flight] : flying_) {
    int status = 0;
    ::waitpid(pid, &status, 0);
  }
  std::error_code ignored;
  fs::remove_all(options_.work, ignored);
  fs::remove(options_.folder / "runs", ignored);  // where nothing was kept
  ::sigprocmask(SIG_SETMASK, &mask_before_, nullptr);
}

fs::path Executor::FolderOf(std::uint64_t seed) const { return options_.folder / "runs" / std::to_string(seed); }
fs::path Executor::WorkOf(std::uint64_t seed) const { return options_.work / std::to_string(seed); }

void Executor::Start(Case next) {
  const fs::path work = WorkOf(next.seed);
  std::error_code error;
  fs::create_directories(work, error);
  if (error) {
    throw base::FaultError("disk", "cannot write to " + options_.folder.string() + ": " + error.message());
  }
  fs::remove_all(FolderOf(next.seed), error);
  WriteText(work / (options_.name + ".yaml"), next.scenario_yaml);
  const auto begin = std::chrono::steady_clock::now();
  const pid_t pid = Spawn(next);
  flying_.emplace(pid, Flight{std::move(next), begin});
}

pid_t Executor::Spawn(const Case& next) const {
  const Limits& limits = options_.limits;
  std::vector<std::string> arguments = {"alula",
                                        "run",
                                        (WorkOf(next.seed) / (options_.name + ".yaml")).string(),
                                        "--out",
                                        FolderOf(next.seed).string(),
                                        "--quiet",
                                        "--render",
                                        options_.render,
                                        "--workers",
                                        std::to_string(options_.workers),
                                        "--hang-limit",
                                        std::to_string(limits.stall.Seconds())};
  if (limits.wall) arguments.insert(arguments.end(), {"--wall-limit", std::to_string(limits.wall->Seconds())});
  if (limits.memory) {
    arguments.insert(arguments.end(), {"--memory-limit", std::to_string(static_cast<double>(*limits.memory) * 1e-6)});
  }
  const fs::path errors = WorkOf(next.seed) / "stderr";
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid == 0) BecomeRun(std::move(arguments), errors, parent, mask_before_);
  if (pid < 0) throw base::FaultError("process", std::string("cannot start a run: ") + std::strerror(errno));
  return pid;
}

std::optional<Executor::Finished> Executor::Wait(std::chrono::milliseconds patience) {
  const auto until = std::chrono::steady_clock::now() + patience;
  for (;;) {
    if (std::optional<Finished> finished = Reap()) return finished;
    const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(until - std::chrono::steady_clock::now());
    if (left.count() <= 0) return std::nullopt;
    constexpr std::int64_t kSecond = 1'000'000'000;
    const timespec timeout{left.count() / kSecond, static_cast<long>(left.count() % kSecond)};
    const sigset_t signals = WatchedSignals();
    siginfo_t info;
    const int signal = ::sigtimedwait(&signals, &info, &timeout);
    if (signal == SIGINT || signal == SIGTERM) {
      interrupted_ = true;
      return std::nullopt;
    }
  }
}

std::optional<Executor::Finished> Executor::Reap() {
  for (auto entry = flying_.begin(); entry != flying_.end(); ++entry) {
    int status = 0;
    rusage usage = {};
    if (::wait4(entry->first, &status, WNOHANG, &usage) != entry->first) continue;
    const Flight flight = std::move(entry->second);
    flying_.erase(entry);
    if (WIFEXITED(status) && WEXITSTATUS(status) == kExitInterrupted) {
      interrupted_ = true;
      return std::nullopt;
    }
    Finished finished{flight.flown.index, RowOf(flight.flown, status)};
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    finished.row.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - flight.begin).count();
    finished.row.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    finished.row.peak_memory_mb = static_cast<double>(usage.ru_maxrss) * 1.024e-3;
    return finished;
  }
  return std::nullopt;
}

Row Executor::RowOf(const Case& flown, int status) const {
  Row row;
  row.parameters = flown.parameters;
  row.scenario_yaml = flown.scenario_yaml;
  row.program = program_;
  const fs::path folder = FolderOf(flown.seed);
  const std::string errors = LastLine(ReadText(WorkOf(flown.seed) / "stderr"));
  if (fs::exists(folder / "verdict.json")) {
    row.verdict = VerdictFromJson(ReadText(folder / "verdict.json"));
    row.interval_digests = ReadText(folder / "digests.csv");
  } else if (WIFEXITED(status) && WEXITSTATUS(status) == kExitBadInput) {
    throw base::InputError("seed " + std::to_string(flown.seed) + ": " + errors);
  } else {
    constexpr std::string_view kDisk = "fault (disk): ";
    const bool disk = errors.starts_with(kDisk);
    row.verdict.outcome = Outcome::kFault;
    row.verdict.reason = disk ? "disk" : "lost";
    row.verdict.message = disk             ? errors.substr(kDisk.size())
                          : errors.empty() ? "its process ended without a verdict"
                                           : errors;
    row.verdict.seed = flown.seed;
    row.verdict.scenario = options_.name;
  }
  // The machine's trouble, not the scenario's: no result.
  if (row.verdict.reason == "disk") throw base::FaultError("disk", row.verdict.message);
  return row;
}

std::optional<Row> Executor::Adopt(const Case& flown) const {
  const fs::path folder = FolderOf(flown.seed);
  if (!fs::exists(folder / "verdict.json") || ReadText(folder / "scenario.yaml") != flown.scenario_yaml) {
    return std::nullopt;
  }
  Row row = RowOf(flown, 0);
  const nlohmann::json timing = nlohmann::json::parse(ReadText(folder / "timing.json"), nullptr, false);
  if (timing.is_object()) row.wall_s = timing.value("wall_s", 0.0);  // a run that died has none
  return row;
}

void Executor::Settle(const Row& row) const {
  const bool kept =
      options_.keep == Keep::kAll || (options_.keep == Keep::kFailed && row.verdict.outcome != Outcome::kPass);
  std::error_code ignored;
  fs::remove_all(WorkOf(row.verdict.seed), ignored);
  if (!kept) fs::remove_all(FolderOf(row.verdict.seed), ignored);
}

}  // namespace alula::scenarios::campaign

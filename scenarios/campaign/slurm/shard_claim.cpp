#include "scenarios/campaign/slurm/shard_claim.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>
#include <utility>

#include "base/error.h"

namespace alula::scenarios::slurm {

namespace {

std::string Variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

std::string FileText(const ClaimHolder& holder) {
  return "host " + holder.host + "\npid " + std::to_string(holder.pid) + "\ntask " + holder.task + "\ntoken " +
         holder.token + "\n";
}

[[noreturn]] void Refuse(const std::filesystem::path& file, const std::string& what) {
  throw base::InputError(file.string() + ": " + what);
}

/// True: locked; false: another has it.
bool Lock(int fd, const std::filesystem::path& file) {
  struct flock whole = {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  int result = -1;
  do result = ::fcntl(fd, F_OFD_SETLK, &whole);
  while (result != 0 && errno == EINTR);
  if (result == 0) return true;
  if (errno == EAGAIN || errno == EACCES) return false;
  Refuse(file,
         std::string("cannot be locked (") + std::strerror(errno) +
             "); name a folder whose file system has locks for all nodes (NFSv4, or Lustre mounted with -o flock)");
}

/// Puts the text in the file's place, through the lock to the server.
bool Write(int fd, const std::string& text) {
  const ssize_t n = ::pwrite(fd, text.data(), text.size(), 0);
  return n == static_cast<ssize_t>(text.size()) && ::ftruncate(fd, n) == 0 && ::fdatasync(fd) == 0;
}

}  // namespace

std::string ClaimHolder::Text() const {
  std::string text = "process " + std::to_string(pid) + " on " + host;
  if (!task.empty()) text += " (Slurm task " + task + ")";
  return text;
}

ClaimHolder ThisProcess() {
  ClaimHolder self;
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) == 0) self.host = host.data();
  self.pid = static_cast<int>(::getpid());
  const std::string job = Variable("SLURM_ARRAY_JOB_ID"), index = Variable("SLURM_ARRAY_TASK_ID");
  if (!job.empty() && !index.empty()) self.task = job + "_" + index;
  std::ifstream("/proc/sys/kernel/random/uuid") >> self.token;  // pids of containers repeat
  return self;
}

std::optional<ClaimHolder> ReadHolder(const std::filesystem::path& file) {
  std::ifstream stream(file);
  ClaimHolder holder;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "host") words >> holder.host;
    if (key == "pid") words >> holder.pid;
    if (key == "task") words >> holder.task;
    if (key == "token") words >> holder.token;
  }
  if (holder.host.empty()) return std::nullopt;
  return holder;
}

std::optional<ShardClaim> ShardClaim::Try(const std::filesystem::path& file, const ClaimHolder& self) {
  const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (fd < 0) Refuse(file, std::string("cannot be opened for writing: ") + std::strerror(errno));
  ShardClaim claim(fd, file, self);  // closes the file whatever comes
  if (!Lock(fd, file)) return std::nullopt;
  if (!Write(fd, FileText(self))) Refuse(file, std::string("cannot be written: ") + std::strerror(errno));
  return claim;
}

std::optional<ShardClaim> ShardClaim::Wait(const std::filesystem::path& file, const ClaimHolder& self, double limit_s,
                                           const std::atomic<bool>* interrupt) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kPause = std::chrono::milliseconds(1000);
  const auto end = Clock::now() + std::chrono::milliseconds(static_cast<std::int64_t>(limit_s * 1e3));
  for (;;) {
    if (std::optional<ShardClaim> claim = Try(file, self)) return claim;
    if (interrupt != nullptr && interrupt->load(std::memory_order_relaxed)) return std::nullopt;
    if (Clock::now() + kPause > end) return std::nullopt;
    std::this_thread::sleep_for(kPause);  // a signal does not cut it short: a second is soon enough
  }
}

bool ShardClaim::StillHeld() const {
  struct stat locked = {}, named = {};
  if (::fstat(fd_, &locked) != 0 || ::stat(file_.c_str(), &named) != 0) return false;
  if (locked.st_ino != named.st_ino || locked.st_dev != named.st_dev) return false;
  // Opened anew, so that NFS asks the server; then written, which it refuses where the lock was lost.
  const std::optional<ClaimHolder> holder = ReadHolder(file_);
  return holder && holder->token == self_.token && Write(fd_, FileText(self_));
}

ShardClaim::ShardClaim(int fd, std::filesystem::path file, ClaimHolder self)
    : fd_(fd), file_(std::move(file)), self_(std::move(self)) {}

ShardClaim::ShardClaim(ShardClaim&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), file_(std::move(other.file_)), self_(std::move(other.self_)) {}

ShardClaim& ShardClaim::operator=(ShardClaim&& other) noexcept {
  if (this != &other) {
    if (fd_ >= 0) ::close(fd_);
    fd_ = std::exchange(other.fd_, -1);
    file_ = std::move(other.file_);
    self_ = std::move(other.self_);
  }
  return *this;
}

ShardClaim::~ShardClaim() {
  if (fd_ >= 0) ::close(fd_);
}

}  // namespace alula::scenarios::slurm

#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

namespace alula::scenarios::slurm {

/// Who holds a shard: written into the claim's file for people and for the messages of those who wait.
struct ClaimHolder {
  std::string host;
  int pid = 0;
  std::string task;   ///< "17_4" of Slurm, empty outside of it
  std::string token;  ///< of this process alone

  /// "process 4711 on n1 (Slurm task 17_4)".
  std::string Text() const;
};

/// This process; the task from Slurm's variables in the environment.
ClaimHolder ThisProcess();

/// What a claim's file says; nothing where it is missing or says nothing.
std::optional<ClaimHolder> ReadHolder(const std::filesystem::path& file);

/// The exclusive right to work on one shard, as a lock on a file of its own that stays in the folder.
///
/// The lock is an open-file-description lock (F_OFD_SETLK): the kernel lets it go when the process ends, however it
/// ends, also on kill -9; NFSv4 and Lustre (mounted with -o flock) carry it between hosts; and, other than a POSIX
/// lock, it is not lost when some library opens and closes the same file. A child that is forked without exec shares
/// it: the shard then stays claimed until that child has ended too. A child that is exec'ed does not.
class ShardClaim {
 public:
  /// Nothing where another holds it. Throws InputError where the file cannot be made or its file system has no locks.
  static std::optional<ShardClaim> Try(const std::filesystem::path& file, const ClaimHolder& self);

  /// Tries once a second for `limit_s` or until `*interrupt` (may be null). A task that was requeued because its node
  /// seemed dead may find the old one still at work: it is to wait, and then to end without success, so that the shard
  /// is submitted again.
  static std::optional<ShardClaim> Wait(const std::filesystem::path& file, const ClaimHolder& self, double limit_s,
                                        const std::atomic<bool>* interrupt);

  /// Whether the shard is still this process's: the file is the one that was locked, it names this process, and the
  /// file system still takes writes to it (NFS refuses them once a lock was lost, such as after the host was cut off
  /// for longer than the lease). To be asked before each row is committed.
  bool StillHeld() const;

  ShardClaim(ShardClaim&& other) noexcept;
  ShardClaim& operator=(ShardClaim&& other) noexcept;
  ~ShardClaim();

 private:
  ShardClaim(int fd, std::filesystem::path file, ClaimHolder self);

  int fd_ = -1;
  std::filesystem::path file_;
  ClaimHolder self_;
};

}  // namespace alula::scenarios::slurm

#include "scenarios/campaign/slurm/shard_claim.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>

#include "base/error.h"
#include "scenarios/campaign/slurm/run_command.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::slurm {
namespace {

using testing::TemporaryFolder;

/// A process that claims a shard, says so, and lives until it is killed or its standard input ends.
class Claimant {
 public:
  explicit Claimant(const std::filesystem::path& file) {
    EXPECT_EQ(::pipe(told_.data()), 0);
    child_ = ::fork();
    if (child_ == 0) {
      const std::optional<ShardClaim> claim = ShardClaim::Try(file, ThisProcess());
      const char answer = claim ? 'y' : 'n';
      if (::write(told_[1], &answer, 1) != 1) ::_exit(1);
      for (;;) ::pause();
    }
    EXPECT_EQ(::read(told_[0], &answer_, 1), 1);
  }
  ~Claimant() {
    if (child_ > 0) Kill();
    ::close(told_[0]);
    ::close(told_[1]);
  }
  Claimant(const Claimant&) = delete;
  Claimant& operator=(const Claimant&) = delete;

  bool has_it() const { return answer_ == 'y'; }
  pid_t pid() const { return child_; }
  void Kill() {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
    child_ = -1;
  }

 private:
  std::array<int, 2> told_{};
  pid_t child_ = -1;
  char answer_ = '?';
};

TEST(ShardClaim, OneHoldsItAndSaysWho) {
  const TemporaryFolder folder("claim_one");
  const auto file = folder.path() / "3.claim";
  EXPECT_FALSE(ReadHolder(file));
  const Claimant first(file);
  ASSERT_TRUE(first.has_it());
  const Claimant second(file);
  EXPECT_FALSE(second.has_it());
  const auto holder = ReadHolder(file);
  ASSERT_TRUE(holder);
  EXPECT_EQ(holder->pid, first.pid());
  EXPECT_EQ(holder->host, ThisProcess().host);
}

TEST(ShardClaim, KillLetsItGo) {
  const TemporaryFolder folder("claim_kill");
  const auto file = folder.path() / "3.claim";
  Claimant first(file);
  ASSERT_TRUE(first.has_it());
  EXPECT_FALSE(ShardClaim::Try(file, ThisProcess()));
  first.Kill();
  const auto claim = ShardClaim::Try(file, ThisProcess());
  ASSERT_TRUE(claim);
  EXPECT_TRUE(claim->StillHeld());
  EXPECT_EQ(ReadHolder(file)->pid, ::getpid());
}

TEST(ShardClaim, ExclusiveWithinOneProcessToo) {
  const TemporaryFolder folder("claim_self");
  const auto file = folder.path() / "3.claim";
  auto claim = ShardClaim::Try(file, ThisProcess());
  ASSERT_TRUE(claim);
  EXPECT_FALSE(ShardClaim::Try(file, ThisProcess())) << "and neither this nor ReadHolder may lose the first one";
  EXPECT_TRUE(ReadHolder(file));
  EXPECT_FALSE(Claimant(file).has_it());
  claim.reset();
  EXPECT_TRUE(ShardClaim::Try(file, ThisProcess()));
}

TEST(ShardClaim, MovesWithItsOwner) {
  const TemporaryFolder folder("claim_move");
  const auto file = folder.path() / "3.claim";
  std::optional<ShardClaim> kept;
  {
    auto claim = ShardClaim::Try(file, ThisProcess());
    ASSERT_TRUE(claim);
    kept = std::move(claim);
  }
  EXPECT_FALSE(ShardClaim::Try(file, ThisProcess()));
  EXPECT_TRUE(kept->StillHeld());
}

TEST(ShardClaim, ProgramsThatAreStartedDoNotHoldIt) {
  const TemporaryFolder folder("claim_exec");
  const auto file = folder.path() / "3.claim";
  auto claim = ShardClaim::Try(file, ThisProcess());
  ASSERT_TRUE(claim);
  const CommandOutcome outcome = RunCommand({"bash", "-c", "ls -l /proc/self/fd"});
  EXPECT_EQ(outcome.out.find("3.claim"), std::string::npos) << outcome.out;
}

TEST(ShardClaim, AForkedChildKeepsItsShardClaimed) {
  const TemporaryFolder folder("claim_fork");
  const auto file = folder.path() / "3.claim";
  auto claim = ShardClaim::Try(file, ThisProcess());
  ASSERT_TRUE(claim);
  const pid_t child = ::fork();
  if (child == 0) {
    for (;;) ::pause();
  }
  claim.reset();
  EXPECT_FALSE(ShardClaim::Try(file, ThisProcess())) << "its run may still write";
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(ShardClaim::Try(file, ThisProcess()));
}

TEST(ShardClaim, NoticesThatItWasLost) {
  const TemporaryFolder folder("claim_lost");
  const auto file = folder.path() / "3.claim";
  const auto claim = ShardClaim::Try(file, ThisProcess());
  ASSERT_TRUE(claim);
  EXPECT_TRUE(claim->StillHeld());
  // A file system without working locks: another one has written its name.
  std::ofstream(file) << "host elsewhere\npid 4\ntask 17_3\ntoken other\n";
  EXPECT_FALSE(claim->StillHeld());
}

TEST(ShardClaim, NoticesThatItsFileWasReplaced) {
  const TemporaryFolder folder("claim_replaced");
  const auto file = folder.path() / "3.claim";
  const auto claim = ShardClaim::Try(file, ThisProcess());
  ASSERT_TRUE(claim);
  std::filesystem::remove(file);
  EXPECT_FALSE(claim->StillHeld());
  const Claimant other(file);
  EXPECT_TRUE(other.has_it());
  EXPECT_FALSE(claim->StillHeld());
}

TEST(ShardClaim, WaitingEndsWithTheLimitOrTheInterrupt) {
  const TemporaryFolder folder("claim_wait");
  const auto file = folder.path() / "3.claim";
  const Claimant first(file);
  ASSERT_TRUE(first.has_it());
  EXPECT_FALSE(ShardClaim::Wait(file, ThisProcess(), 0.0, nullptr));
  const std::atomic<bool> interrupt{true};
  EXPECT_FALSE(ShardClaim::Wait(file, ThisProcess(), 1e6, &interrupt));
}

TEST(ShardClaim, WaitingGetsItOnceTheHolderIsGone) {
  const TemporaryFolder folder("claim_wait_get");
  const auto file = folder.path() / "3.claim";
  Claimant first(file);
  ASSERT_TRUE(first.has_it());
  const pid_t waiter = ::fork();
  if (waiter == 0) ::_exit(ShardClaim::Wait(file, ThisProcess(), 60.0, nullptr) ? 0 : 1);
  first.Kill();
  int status = -1;
  ::waitpid(waiter, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

TEST(ShardClaim, FoldersThatCannotBeWrittenAreBadInput) {
  EXPECT_THROW(ShardClaim::Try("/proc/no/3.claim", ThisProcess()), base::InputError);
}

TEST(ClaimHolder, NamesItsSlurmTask) {
  ::setenv("SLURM_ARRAY_JOB_ID", "17", 1);
  ::setenv("SLURM_ARRAY_TASK_ID", "4", 1);
  const ClaimHolder self = ThisProcess();
  ::unsetenv("SLURM_ARRAY_JOB_ID");
  ::unsetenv("SLURM_ARRAY_TASK_ID");
  EXPECT_EQ(self.Text(), "process " + std::to_string(::getpid()) + " on " + self.host + " (Slurm task 17_4)");
}

}  // namespace
}  // namespace alula::scenarios::slurm

#include "scenarios/campaign/slurm/run_command.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "base/error.h"

namespace alula::scenarios::slurm {
namespace {

TEST(RunCommand, GivesBothStreamsAndTheCode) {
  const CommandOutcome outcome = RunCommand({"bash", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(outcome.out, "out\n");
  EXPECT_EQ(outcome.err, "err\n");
  EXPECT_EQ(outcome.exit_code, 3);
}

TEST(RunCommand, WordsReachTheProgramWithoutAShell) {
  EXPECT_EQ(RunCommand({"printf", "%s|", "a b", "$HOME", "'; id"}).out, "a b|$HOME|'; id|");
}

TEST(RunCommand, StreamsLongerThanAPipeDoNotBlock) {
  constexpr std::size_t kBytes = 1 << 20;
  const CommandOutcome outcome =
      RunCommand({"bash", "-c", "head -c 1048576 /dev/zero >&2; cat"}, {.input = std::string(kBytes, 'x')});
  EXPECT_EQ(outcome.out.size(), kBytes);
  EXPECT_EQ(outcome.err.size(), kBytes);
}

TEST(RunCommand, AProgramThatDoesNotReadItsInputIsNoTrouble) {
  EXPECT_EQ(RunCommand({"true"}, {.input = std::string(1 << 20, 'x')}).exit_code, 0);
}

TEST(RunCommand, MissingProgramsAreBadInput) { EXPECT_THROW(RunCommand({"alula-no-such-program"}), base::InputError); }

TEST(RunCommand, SignalsAreTold) { EXPECT_EQ(RunCommand({"bash", "-c", "kill -9 $$"}).exit_code, 128 + SIGKILL); }

TEST(RunCommand, EndsWhatHangs) {
  const CommandOutcome outcome =
      RunCommand({"bash", "-c", "echo begun; cat /dev/zero > /dev/null"}, {.time_limit_s = 0.5});
  EXPECT_TRUE(outcome.timed_out);
  EXPECT_EQ(outcome.exit_code, 128 + SIGKILL);
}

TEST(RunCommand, BlockedSignalsAreNotInherited) {
  sigset_t term, before;
  sigemptyset(&term);
  sigaddset(&term, SIGTERM);
  sigprocmask(SIG_BLOCK, &term, &before);
  EXPECT_EQ(RunCommand({"bash", "-c", "kill -TERM $$; exit 0"}).exit_code, 128 + SIGTERM);
  sigprocmask(SIG_SETMASK, &before, nullptr);
}

TEST(RunCommand, KeepsVariablesBack) {
  ::setenv("ALULA_TEST_ONE", "1", 1);
  ::setenv("ALULA_TEST_TWO", "2", 1);
  EXPECT_EQ(RunCommand({"bash", "-c", "echo \"$ALULA_TEST_ONE,$ALULA_TEST_TWO\""}, {.without = {"ALULA_TEST_T"}}).out,
            "1,\n");
}

}  // namespace
}  // namespace alula::scenarios::slurm

// What a supervisor makes of processes that do not come to their end.
#include "scenarios/supervisor.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <thread>
#include <vector>

#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios {
namespace {

using testing::ReadText;
using testing::TemporaryFolder;

Ending Watched(const std::function<void(Pulse&)>& work, const Limits& limits = {}) {
  return Supervise(limits, [&](Pulse& pulse) {
    work(pulse);
    return Report{};
  });
}

TEST(Supervisor, HandsTheReportOver) {
  const std::string text(200'000, 'x');
  const Ending ending = Supervise({}, [&](Pulse&) { return Report{7, text}; });
  EXPECT_FALSE(ending.death);
  EXPECT_FALSE(ending.interrupted);
  EXPECT_EQ(ending.report.exit_code, 7);
  EXPECT_EQ(ending.report.text, text);
}

TEST(Supervisor, CrashIsADeathWithItsSignalAndTime) {
  const TemporaryFolder folder("supervisor");
  const Ending ending = Watched([&](Pulse& pulse) {
    LeaveStackTraceIn(folder.path() / "crash.txt");
    pulse.simulated_ns = 1'500'000'000;
    std::raise(SIGSEGV);
  });
  ASSERT_TRUE(ending.death);
  EXPECT_EQ(ending.death->reason, "crash");
  EXPECT_EQ(ending.death->message, "died of signal 11 (Segmentation fault)");
  EXPECT_EQ(ending.death->simulated.ns, 1'500'000'000);
  EXPECT_TRUE(ReadText(folder.path() / "crash.txt").starts_with("Segmentation fault\n"));
}

TEST(Supervisor, AnExitInTheMiddleIsNoEnd) {
  const Ending ending = Watched([](Pulse&) { std::_Exit(0); });
  ASSERT_TRUE(ending.death);
  EXPECT_EQ(ending.death->reason, "exit");
}

TEST(Supervisor, KilledFromOutside) {
  const Ending ending = Watched([](Pulse&) { ::raise(SIGKILL); });
  ASSERT_TRUE(ending.death);
  EXPECT_EQ(ending.death->reason, "killed");
}

TEST(Supervisor, HangsAreEndedButSlowRunsAreNot) {
  Limits limits;
  limits.stall = base::Milliseconds(300);
  const auto forever = [](Pulse&) {
    for (;;) ::pause();
  };
  const Ending hanging = Watched(forever, limits);
  ASSERT_TRUE(hanging.death);
  EXPECT_EQ(hanging.death->reason, "hang");
  EXPECT_EQ(hanging.death->message, "no step of the simulation in 0.3 s of wall time");
  const auto slowly = [](Pulse& pulse) {
    for (int i = 0; i < 12; ++i) {
      ++pulse.simulated_ns;
      ::usleep(50'000);
    }
  };
  EXPECT_FALSE(Watched(slowly, limits).death);
  limits.wall = base::Milliseconds(200);
  const Ending late = Watched(slowly, limits);
  ASSERT_TRUE(late.death);
  EXPECT_EQ(late.death->message, "still running after 0.2 s of wall time");
}

TEST(Supervisor, MemoryHasALimit) {
  Limits limits;
  limits.memory = 200'000'000;
  const Ending ending = Watched(
      [](Pulse&) {
        std::vector<std::vector<char>> taken;
        for (;;) taken.emplace_back(1 << 20, 'x');
      },
      limits);
  ASSERT_TRUE(ending.death);
  EXPECT_TRUE(ending.death->reason == "memory" || ending.death->reason == "crash") << ending.death->reason;
}

TEST(Supervisor, PassesAnInterruptionOn) {
  const pid_t self = ::getpid();
  std::thread sender([self] {
    ::usleep(100'000);
    ::kill(self, SIGTERM);
  });
  sigset_t signals;  // this thread must not take the signal that is meant for the supervisor
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  const Ending ending = Watched([](Pulse&) {
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    for (;;) ::pause();
  });
  sender.join();
  EXPECT_TRUE(ending.interrupted);
  EXPECT_FALSE(ending.death);
}

}  // namespace
}  // namespace alula::scenarios

#include "scenarios/campaign/slurm/resubmission.h"

#include <gtest/gtest.h>

namespace alula::scenarios::slurm {
namespace {

constexpr int kCases = 10;

std::vector<ShardProgress> Shards(int count) {
  std::vector<ShardProgress> shards;
  for (int k = 0; k < count; ++k) shards.push_back({.shard = k, .cases = kCases});
  return shards;
}

QueueState Queue(std::vector<Task> tasks) { return {.known = true, .tasks = std::move(tasks)}; }
Task Running(int shard) { return {"17", shard, TaskState::kRunning, "RUNNING", "None"}; }
Task Waiting(int shard) { return {"17", shard, TaskState::kWaiting, "PENDING", "BeginTime"}; }

using Numbers = std::vector<int>;

TEST(ShardsToResubmit, AllAreNewAtFirst) {
  auto shards = Shards(3);
  EXPECT_EQ(ShardsToResubmit(shards, Queue({})).shards, (Numbers{0, 1, 2}));
}

TEST(ShardsToResubmit, ARunningSweepIsTakenOver) {
  auto shards = Shards(3);
  shards[2].done = kCases;
  EXPECT_EQ(ShardsToResubmit(shards, Queue({Running(0), Waiting(1)})).shards, Numbers{});
}

TEST(ShardsToResubmit, NothingFollowsFromAnUnknownQueue) {
  auto shards = Shards(2);
  CountAttempt(shards, {0, 1});
  for (int i = 0; i < 100; ++i) {
    const Resubmission now = ShardsToResubmit(shards, {.known = false, .problem = "Socket timed out"});
    EXPECT_TRUE(now.shards.empty() && now.cancel.empty() && now.give_up.empty());
  }
  EXPECT_EQ(shards[0].absences, 0);
}

TEST(ShardsToResubmit, ATaskIsLostAfterTwoAnswersWithoutIt) {
  auto shards = Shards(2);
  CountAttempt(shards, {0, 1});
  EXPECT_EQ(ShardsToResubmit(shards, Queue({Running(1)})).shards, Numbers{});
  EXPECT_EQ(ShardsToResubmit(shards, Queue({Running(1)})).shards, Numbers{0});
}

TEST(ShardsToResubmit, ATaskThatSlurmRequeuesIsNotLost) {
  auto shards = Shards(1);
  CountAttempt(shards, {0});
  // A node died: for one answer its task stands as ended, then it waits again.
  EXPECT_EQ(ShardsToResubmit(shards, Queue({{"17", 0, TaskState::kEnded, "NODE_FAIL", "None"}})).shards, Numbers{});
  for (int i = 0; i < 20; ++i) EXPECT_EQ(ShardsToResubmit(shards, Queue({Waiting(0)})).shards, Numbers{});
  EXPECT_EQ(ShardsToResubmit(shards, Queue({})).shards, Numbers{});
}

TEST(ShardsToResubmit, CompleteShardsAreLeftAlone) {
  auto shards = Shards(2);
  CountAttempt(shards, {0, 1});
  shards[0].done = shards[1].done = kCases;
  for (int i = 0; i < 5; ++i) {
    const Resubmission now = ShardsToResubmit(shards, Queue({}));
    EXPECT_TRUE(now.shards.empty() && now.give_up.empty());
  }
}

/// How many answers of an empty queue it takes until something is done.
int AnswersUntilSubmitted(std::vector<ShardProgress>& shards) {
  for (int answers = 1; answers < 1000; ++answers) {
    const Resubmission now = ShardsToResubmit(shards, Queue({}));
    if (!now.give_up.empty()) return -answers;
    if (now.shards.empty()) continue;
    CountAttempt(shards, now.shards);
    return answers;
  }
  return 0;
}

TEST(ShardsToResubmit, WaitsLongerEachTimeAndGivesUpAfterFive) {
  auto shards = Shards(1);
  EXPECT_EQ(AnswersUntilSubmitted(shards), 1);
  EXPECT_EQ(AnswersUntilSubmitted(shards), 2);
  EXPECT_EQ(AnswersUntilSubmitted(shards), 4);
  EXPECT_EQ(AnswersUntilSubmitted(shards), 8);
  EXPECT_EQ(AnswersUntilSubmitted(shards), 16);
  EXPECT_EQ(shards[0].attempts, 5);
  EXPECT_EQ(AnswersUntilSubmitted(shards), -2);
}

TEST(ShardsToResubmit, AShardThatGetsFurtherMayGoOnForEver) {
  auto shards = Shards(1);
  CountAttempt(shards, {0});
  for (int attempt = 1; attempt < kCases; ++attempt) {
    shards[0].done = attempt;  // one row before each time limit
    EXPECT_EQ(AnswersUntilSubmitted(shards), 2);
    EXPECT_EQ(shards[0].attempts, 1);
  }
}

TEST(ShardsToResubmit, GivesUpOnceTheOthersAreDone) {
  auto shards = Shards(3);
  for (ShardProgress& shard : shards) shard.attempts = 5;
  shards[0].done = kCases;
  const Task ended{"17", 1, TaskState::kEnded, "OUT_OF_MEMORY", "None"};
  const QueueState busy = Queue({ended, Running(2)});
  for (int i = 0; i < 5; ++i) EXPECT_EQ(ShardsToResubmit(shards, busy).give_up, "");
  shards[2].done = kCases;
  EXPECT_EQ(ShardsToResubmit(shards, Queue({ended})).give_up,
            "shard 1 got no row further in 5 submissions, last ended as OUT_OF_MEMORY; see the logs *_1.log in the "
            "sweep's folder slurm/, mend it and give the same command again to go on");
}

TEST(ShardsToResubmit, WhatSlurmHoldsIsCancelledAndSubmittedAnew) {
  auto shards = Shards(1);
  CountAttempt(shards, {0});
  const QueueState queue = Queue({{"17", 0, TaskState::kStuck, "PENDING", "launch_failed_requeued_held"}});
  EXPECT_TRUE(ShardsToResubmit(shards, queue).cancel.empty());
  const Resubmission now = ShardsToResubmit(shards, queue);
  EXPECT_EQ(now.shards, Numbers{0});
  EXPECT_EQ(now.cancel, std::vector<std::string>{"17_0"});
}

TEST(ShardsToResubmit, OneLivingTaskOfSeveralSubmissionsIsEnough) {
  auto shards = Shards(1);
  CountAttempt(shards, {0});
  Task lost{"16", 0, TaskState::kEnded, "NODE_FAIL", "None"};
  for (int i = 0; i < 5; ++i) EXPECT_EQ(ShardsToResubmit(shards, Queue({lost, Waiting(0)})).shards, Numbers{});
}

}  // namespace
}  // namespace alula::scenarios::slurm

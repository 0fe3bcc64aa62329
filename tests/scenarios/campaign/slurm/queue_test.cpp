#include "scenarios/campaign/slurm/queue.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/scenarios/campaign/slurm/fake_programs.h"

namespace alula::scenarios::slurm {
namespace {

using scenarios::testing::ReadText;
using testing::FakePrograms;

TEST(ParseJobId, OfOneClusterAndOfSeveral) {
  EXPECT_EQ(ParseJobId("17\n"), "17");
  EXPECT_EQ(ParseJobId("17;north\n"), "17");
  EXPECT_EQ(ParseJobId("Welcome to the cluster\n17\n"), "17");
  EXPECT_EQ(ParseJobId(""), "");
  EXPECT_EQ(ParseJobId("Submitted batch job 17\n"), "");
}

TEST(ParseQueue, StatesOfTasks) {
  const std::vector<Task> tasks = ParseQueue(
      "17|0|RUNNING|None\n"
      "17|1|PENDING|Resources\n"
      "17|2|PENDING|BeginTime\n"
      "17|3|COMPLETING|None\n"
      "17|4|OUT_OF_MEMORY|OutOfMemory\n"
      "17|5|PENDING|launch_failed_requeued_held\n"
      "17|6|PENDING|launch failed requeued held\n"
      "17|7|PENDING|JobHeldUser\n"
      "17|8|SOMETHING_NEW|None\n"
      "17|9|REQUEUE_HOLD|None\n"
      "17|10|NODE_FAIL|NodeDown\n");
  const std::vector<TaskState> expected = {TaskState::kRunning, TaskState::kWaiting, TaskState::kWaiting,
                                           TaskState::kRunning, TaskState::kEnded,   TaskState::kStuck,
                                           TaskState::kStuck,   TaskState::kWaiting, TaskState::kWaiting,
                                           TaskState::kStuck,   TaskState::kEnded};
  ASSERT_EQ(tasks.size(), expected.size());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    EXPECT_EQ(tasks[i].job, "17");
    EXPECT_EQ(tasks[i].shard, static_cast<int>(i));
    EXPECT_EQ(tasks[i].state, expected[i]) << tasks[i].slurm_state << " " << tasks[i].reason;
  }
}

TEST(ParseQueue, OtherLinesAreLeft) {
  EXPECT_TRUE(ParseQueue("").empty());
  EXPECT_TRUE(ParseQueue("CLUSTER: north\n").empty());
  EXPECT_TRUE(ParseQueue("17|N/A|RUNNING|None\n18|[0-3]|PENDING|None\n|||\n17|2\n").empty());
}

std::string Refusal(const std::string& script) {
  try {
    return "taken as " + Submit(script);
  } catch (const base::InputError& error) {
    return std::string("input: ") + error.what();
  } catch (const base::FaultError& error) {
    return error.reason() + ": " + error.what();
  }
}

TEST(Submit, WithoutSlurmSaysSo) {
  FakePrograms programs("none");
  programs.HideOthers();
  const std::string expected =
      "input: Slurm is not installed: there is no sbatch on the PATH; leave out --engine slurm or install slurm-wlm / "
      "load your site's module";
  EXPECT_EQ(Refusal("x"), expected);
  EXPECT_THROW(AskQueue("alula-x"), base::InputError);
}

TEST(Submit, HandsTheScriptOverAndReadsTheNumber) {
  FakePrograms programs("submit");
  programs.Add("sbatch", "cat > '" + (programs.path() / "script").string() +
                             "'; echo \"$@ $SBATCH_ARRAY_INX\" >&2; "
                             "echo '17;north'; [ -z \"$SBATCH_ARRAY_INX\" ] && [ \"$SBATCH_ACCOUNT\" = lab ]");
  ::setenv("SBATCH_ARRAY_INX", "0-99", 1);  // would take the place of the script's own
  ::setenv("SBATCH_ACCOUNT", "lab", 1);
  EXPECT_EQ(Refusal("#!/bin/bash\n"), "taken as 17");
  ::unsetenv("SBATCH_ARRAY_INX");
  ::unsetenv("SBATCH_ACCOUNT");
  EXPECT_EQ(ReadText(programs.path() / "script"), "#!/bin/bash\n");
}

TEST(Submit, RefusalsAreInSlurmsWordsInOneLine) {
  FakePrograms programs("refuse");
  programs.Add("sbatch",
               "echo 'sbatch: error: invalid partition specified: nosuch' >&2\n"
               "echo 'sbatch: error: Batch job submission failed: Invalid partition name specified' >&2\nexit 1");
  EXPECT_EQ(Refusal("x"),
            "input: Slurm refuses: sbatch: invalid partition specified: nosuch; Batch job submission failed: Invalid "
            "partition name specified");
}

TEST(Submit, AControllerThatDoesNotAnswerIsAnotherMatter) {
  FakePrograms programs("down");
  programs.Add("sbatch",
               "echo 'sbatch: error: Batch job submission failed: Unable to contact slurm controller "
               "(connect failure)' >&2; exit 1");
  EXPECT_TRUE(Refusal("x").starts_with("slurm_unavailable: sbatch: Batch job submission failed: Unable to contact"));
  programs.Add("sbatch",
               "echo 'sbatch: error: Batch job submission failed: Socket timed out on send/recv operation' "
               ">&2; exit 1");
  EXPECT_TRUE(Refusal("x").starts_with("slurm_unavailable: "));
}

TEST(AskQueue, AsksByNameWhateverTheUsersOwnFiltersAre) {
  FakePrograms programs("squeue");
  programs.Add("squeue",
               "[ -z \"$SQUEUE_PARTITION\" ] || exit 1\n[[ \"$*\" == *--name=alula-x* ]] || exit 1\n"
               "echo '17|3|RUNNING|None'");
  ::setenv("SQUEUE_PARTITION", "long", 1);
  const QueueState queue = AskQueue("alula-x");
  ::unsetenv("SQUEUE_PARTITION");
  ASSERT_TRUE(queue.known) << queue.problem;
  ASSERT_EQ(queue.tasks.size(), 1u);
  EXPECT_EQ(queue.tasks[0].shard, 3);
}

TEST(AskQueue, AFailureIsNeverAnEmptyQueue) {
  FakePrograms programs("unknown");
  programs.Add("squeue", "echo 'slurm_load_jobs error: Socket timed out on send/recv operation' >&2; exit 1");
  const QueueState queue = AskQueue("alula-x");
  EXPECT_FALSE(queue.known);
  EXPECT_EQ(queue.problem, "squeue: slurm_load_jobs error: Socket timed out on send/recv operation");
}

TEST(Cancel, WhatIsOverIsNoError) {
  FakePrograms programs("cancel");
  programs.Add("scancel", "echo \"$@\" > '" + (programs.path() / "asked").string() +
                              "'; echo 'scancel: error: Kill job error on job id 17: Invalid job id specified' >&2; "
                              "exit 1");
  EXPECT_NO_THROW(Cancel({"17", "18_4"}));
  EXPECT_EQ(ReadText(programs.path() / "asked"), "17 18_4\n");
  programs.Add("scancel", "echo 'scancel: error: Access/permission denied' >&2; exit 1");
  EXPECT_THROW(Cancel({"17"}), base::InputError);
}

TEST(MaxArraySize, AsTheClusterSays) {
  FakePrograms programs("config");
  programs.Add("scontrol", "echo 'MaxArraySize            = 501'");
  EXPECT_EQ(MaxArraySize(), 501);
  programs.Add("scontrol", "exit 1");
  EXPECT_EQ(MaxArraySize(), 1001);
}

}  // namespace
}  // namespace alula::scenarios::slurm

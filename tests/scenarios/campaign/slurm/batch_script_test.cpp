#include "scenarios/campaign/slurm/batch_script.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "scenarios/campaign/slurm/run_command.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::slurm {
namespace {

SlurmJob Job() {
  SlurmJob job;
  job.folder = "/shared/sweeps/hover";
  job.binary = "/opt/alula/bin/alula";
  job.name = "alula-hover-0123abcd";
  job.shards = {0, 1, 2, 3, 7};
  return job;
}

std::string Refusal(const SlurmJob& job) {
  try {
    BatchScript(job);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "taken";
}

SlurmJob WithOption(const std::string& option) {
  SlurmJob job = Job();
  job.options = {option};
  return job;
}

TEST(ArrayExpression, RangesAreShort) {
  EXPECT_EQ(ArrayExpression({}), "");
  EXPECT_EQ(ArrayExpression({5}), "5");
  EXPECT_EQ(ArrayExpression({0, 1, 2, 3, 4, 5, 6, 7, 12}), "0-7,12");
  EXPECT_EQ(ArrayExpression({12, 3, 2, 3, 1, 10, 11}), "1-3,10-12");
  EXPECT_EQ(ArrayExpression({0, 2, 4}), "0,2,4");
}

TEST(BatchScript, SaysWhatSlurmIsToDo) {
  SlurmJob job = Job();
  job.memory_mb = 2048;
  job.time_limit_minutes = 90;
  job.tasks_at_once = 4;
  job.options = {"--partition=short"};
  job.environment = {{"ALULA_DATA", "/data/it's here"}};
  EXPECT_EQ(BatchScript(job),
            "#!/bin/bash\n"
            "#SBATCH --job-name=\"alula-hover-0123abcd\"\n"
            "#SBATCH --array=0-3,7%4\n"
            "#SBATCH --output=\"/shared/sweeps/hover/slurm/%A_%a.log\"\n"
            "#SBATCH --open-mode=append\n"
            "#SBATCH --requeue\n"
            "#SBATCH --signal=B:TERM@30\n"
            "#SBATCH --export=ALL\n"
            "#SBATCH --ntasks=1\n"
            "#SBATCH --cpus-per-task=1\n"
            "#SBATCH --mem=2048M\n"
            "#SBATCH --time=90\n"
            "#SBATCH --partition=short\n"
            "\n"
            "# Shard by shard of a sweep; a task that runs again goes on where the last one stopped.\n"
            "export LC_ALL=C\n"
            "export ALULA_DATA='/data/it'\\''s here'\n"
            "exec '/opt/alula/bin/alula' sweep --worker '/shared/sweeps/hover' --shard \"$SLURM_ARRAY_TASK_ID\"\n");
}

TEST(BatchScript, WhatTheUserSetsTakesThePlaceOfOurs) {
  SlurmJob job = Job();
  job.memory_mb = 2048;
  job.options = {"--mem-per-cpu=1G", "--cpus-per-task 2"};
  const std::string script = BatchScript(job);
  EXPECT_EQ(script.find("--mem="), std::string::npos) << "sbatch takes --mem and --mem-per-cpu only one by one";
  EXPECT_EQ(script.find("--cpus-per-task=1"), std::string::npos);
  EXPECT_NE(script.find("#SBATCH --mem-per-cpu=1G\n#SBATCH --cpus-per-task 2\n"), std::string::npos);
}

TEST(BatchScript, PatternsAndQuotesInThePathOfLogs) {
  SlurmJob job = Job();
  job.folder = "/shared/100%j \"x\"";
  EXPECT_NE(BatchScript(job).find("--output=\"/shared/100%%j \\\"x\\\"/slurm/%A_%a.log\"\n"), std::string::npos);
}

TEST(BatchScript, WhatTheSweepLivesOnCannotBeReplaced) {
  EXPECT_EQ(Refusal(WithOption("--array=0-99")),
            "--slurm-option '--array=0-99': the sweep sets --array itself; leave it out");
  EXPECT_NE(Refusal(WithOption("--arr=0-99")), "taken") << "sbatch completes names";
  EXPECT_NE(Refusal(WithOption("--partition=short --no-requeue")), "taken") << "a line may hold several options";
  EXPECT_NE(Refusal(WithOption("--partition=short -J mine")), "taken");
  EXPECT_NE(Refusal(WithOption("-J mine")), "taken");
  EXPECT_NE(Refusal(WithOption("short")), "taken");
  EXPECT_NE(Refusal(WithOption("")), "taken");
  EXPECT_NE(Refusal(WithOption("--comment=a\nrm -rf /")), "taken");
  EXPECT_EQ(Refusal(WithOption("--wait-all-nodes=1")), "taken");
  EXPECT_EQ(Refusal(WithOption("--nice 5")), "taken");
}

TEST(BatchScript, WhatNoScriptCanSayIsRefused) {
  SlurmJob job = Job();
  job.folder = "/shared/a\nb";
  EXPECT_NE(Refusal(job), "taken");
  job = Job();
  job.folder = "/shared/a\\b";
  EXPECT_NE(Refusal(job), "taken");
  job = Job();
  job.time_limit_minutes = 2;
  EXPECT_NE(Refusal(job), "taken") << "Slurm would send its warning with the start";
}

/// bash itself reads the script: each word reaches the worker as it is, and nothing in a path is run.
TEST(BatchScript, BashHandsEveryWordOnAsItIs) {
  const testing::TemporaryFolder folder("batch_script");
  SlurmJob job = Job();
  job.folder = folder.path() / "o 'x' \"y\" $HOME `id` $(id) #z &;*é";
  job.binary = folder.path() / "my alula's";
  job.environment = {{"ODD", "a'b \"c\" $HOME"}};
  std::ofstream(job.binary) << "#!/bin/bash\nprintf '%s\\n' \"$@\" \"$ODD\" \"$LC_ALL\"\n";
  std::filesystem::permissions(job.binary, std::filesystem::perms::owner_all);
  const CommandOutcome outcome = RunCommand({"env", "SLURM_ARRAY_TASK_ID=7", "bash"}, {.input = BatchScript(job)});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, "sweep\n--worker\n" + job.folder.string() + "\n--shard\n7\na'b \"c\" $HOME\nC\n");
}

TEST(ShellQuoted, EveryByteSurvives) {
  std::string all;
  for (int c = 1; c < 256; ++c) all += static_cast<char>(c);
  EXPECT_EQ(RunCommand({"bash"}, {.input = "printf %s " + ShellQuoted(all)}).out, all);
}

TEST(JobName, TellsSweepsApartAndStaysPlain) {
  EXPECT_EQ(JobName("/a/hover"), JobName("/a/b/../hover"));
  EXPECT_NE(JobName("/a/hover"), JobName("/b/hover"));
  EXPECT_TRUE(JobName("/a/my, \"sweep\"").starts_with("alula-my___sweep_-")) << "squeue --name takes commas apart";
  EXPECT_TRUE(JobName("/a/hover/").starts_with("alula-hover-"));
}

}  // namespace
}  // namespace alula::scenarios::slurm

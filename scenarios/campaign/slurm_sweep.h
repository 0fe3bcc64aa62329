#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "scenarios/campaign/sweep.h"

namespace alula::scenarios::campaign {

struct SlurmRequest {
  SweepRequest sweep;                            // executor.jobs: runs at a time in one task
  int shards = 0;                                // tasks; 0: one for every ten runs
  std::vector<std::string> options;              // of sbatch
  bool watch = false;                            // stay until all is flown, and submit again what was lost
  std::function<void(const std::string&)> tell;  // of submissions and losses, a line each
};

struct SlurmResult {
  SweepResult sweep;  // as far as the shards are merged
  bool finished = false;
  std::string job;  // submitted by this call; empty where nothing was
};

/// The batch script that RunSlurmSweep would submit now.
std::string DryRun(const SlurmRequest& request);

/// The sweep as an array job (slurm/README.md). Called again it goes on: rows are merged, lost shards submitted again.
/// Throws base::InputError where there is no Slurm, base::FaultError("slurm") where shards end without success time
/// after time.
SlurmResult RunSlurmSweep(const SlurmRequest& request);

/// What a task of the array does: claims its shard and flies it.
SweepResult RunWorker(const std::filesystem::path& folder, int shard);

}  // namespace alula::scenarios::campaign

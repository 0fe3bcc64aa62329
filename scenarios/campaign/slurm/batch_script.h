#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace alula::scenarios::slurm {

/// One array job: a task a shard.
struct SlurmJob {
  std::filesystem::path folder;  ///< the sweep's, absolute, on a file system that all nodes share
  std::filesystem::path binary;  ///< alula itself, absolute, at the same place on every node
  std::string name;              ///< of the job, see JobName; the queue is asked by it
  std::vector<int> shards;       ///< to run, each below the cluster's MaxArraySize
  int cpus_per_task = 1;
  std::optional<int> memory_mb = {};           ///< a task; without it the partition's default
  std::optional<int> time_limit_minutes = {};  ///< a task, 3 or more; without it the partition's default
  std::optional<int> tasks_at_once = {};       ///< without it as many as the cluster gives
  /// The user's own #SBATCH options in their long form ("--partition=short"). They stand after ours and take their
  /// place, but for those that the sweep lives on (array, name, log, requeueing).
  std::vector<std::string> options = {};
  std::vector<std::pair<std::string, std::string>> environment = {};  ///< set for the worker, besides LC_ALL=C
};

/// Where the tasks write their logs, one file a task of a submission. sbatch does not make it; a task whose log cannot
/// be opened fails, so it must exist before Submit.
std::filesystem::path LogFolder(const std::filesystem::path& folder);

/// A name that tells this sweep's jobs from all others of the user: "alula-<last part of the path>-<hash of the path>".
std::string JobName(const std::filesystem::path& folder);

/// Numbers as Slurm's --array takes them: {0,1,2,3,12} → "0-3,12". Any order, doubles allowed.
std::string ArrayExpression(std::vector<int> numbers);

/// A word that bash reads back as `text`, whatever is in it.
std::string ShellQuoted(std::string_view text);

/// The script for sbatch. A task runs `BINARY sweep --worker FOLDER --shard K` in the place of its shell, so that the
/// signals of Slurm reach it: SIGTERM 30 to 90 s before its time limit (Slurm looks at limits once a minute), at
/// pre-emption and at scancel, then SIGKILL after the cluster's KillWait (30 s by default).
/// Throws InputError for what cannot be written into a script: line breaks, an option that the sweep sets itself.
std::string BatchScript(const SlurmJob& job);

}  // namespace alula::scenarios::slurm

#pragma once

#include <string>
#include <vector>

#include "scenarios/campaign/slurm/queue.h"

namespace alula::scenarios::slurm {

/// How far one shard is, as the watching process keeps it.
struct ShardProgress {
  int shard = 0;
  int cases = 0;              ///< of the plan
  int done = 0;               ///< rows in its database
  int done_at_attempt = 0;    ///< rows there were at the last submission
  int attempts = 0;           ///< submissions since it last got further; a shard that gets further may go on for ever
  int absences = 0;           ///< answers of the queue in a row without it
  std::string last_end = {};  ///< how its last task ended as far as Slurm tells ("TIMEOUT")

  bool complete() const { return done >= cases; }
};

struct ResubmissionRules {
  int max_attempts = 5;
  /// So many answers without the task before the shard is submitted again: right after a task's end its last rows may
  /// not be visible yet through the cluster's file system. Doubled with every attempt, so that a broken node that
  /// swallows task after task does not use them all up within a minute.
  int absences = 2;
};

/// What to do now.
struct Resubmission {
  std::vector<int> shards;          ///< to submit (again), as one array job
  std::vector<std::string> cancel;  ///< tasks to cancel before that ("17_4"): held by Slurm, they would never run
  std::string give_up;              ///< not empty: nothing more can be done, and why, in one line
};

/// Decides from how far each shard is and what the queue holds. To be called once per answer of the queue, with rows
/// counted after that answer came (else a task that ends in between looks lost); it keeps `shards` up to date. A shard
/// never submitted counts as one to submit now, so the same call starts a sweep, watches it, and takes a running one
/// over after the watching process was killed. Nothing follows from a queue that is not known.
Resubmission ShardsToResubmit(std::vector<ShardProgress>& shards, const QueueState& queue,
                              const ResubmissionRules& rules = {});

/// To be called after Submit took `submitted`.
void CountAttempt(std::vector<ShardProgress>& shards, const std::vector<int>& submitted);

}  // namespace alula::scenarios::slurm

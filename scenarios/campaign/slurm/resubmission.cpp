#include "scenarios/campaign/slurm/resubmission.h"

#include <algorithm>

namespace alula::scenarios::slurm {

namespace {

/// What the tasks of one shard come to; there may be several, of several submissions.
struct Presence {
  bool in_queue = false;           // waits or runs
  std::vector<std::string> stuck;  // "17_4"
  std::string ended;               // state of an ended one
};

Presence PresenceOf(int shard, const QueueState& queue) {
  Presence presence;
  long newest = -1;
  for (const Task& task : queue.tasks) {
    if (task.shard != shard) continue;
    switch (task.state) {
      case TaskState::kWaiting:
      case TaskState::kRunning:
        presence.in_queue = true;
        break;
      case TaskState::kStuck:
        presence.stuck.push_back(task.job + "_" + std::to_string(shard));
        break;
      case TaskState::kEnded:
        if (std::stol(task.job) > newest) {
          newest = std::stol(task.job);
          presence.ended = task.slurm_state;
        }
        break;
    }
  }
  return presence;
}

int AbsencesNeeded(const ShardProgress& shard, const ResubmissionRules& rules) {
  if (shard.attempts == 0) return 1;                                // never submitted: nothing to wait for
  if (shard.attempts >= rules.max_attempts) return rules.absences;  // nothing comes after it
  constexpr int kMostDoublings = 10;
  return rules.absences << std::min(shard.attempts - 1, kMostDoublings);
}

std::string GiveUpLine(const std::vector<ShardProgress>& shards, const ResubmissionRules& rules) {
  std::vector<const ShardProgress*> left;
  for (const ShardProgress& shard : shards) {
    if (!shard.complete()) left.push_back(&shard);
  }
  const ShardProgress& first = *left.front();
  std::string line = "shard " + std::to_string(first.shard);
  if (left.size() > 1) line += " and " + std::to_string(left.size() - 1) + " more";
  line += " got no row further in " + std::to_string(rules.max_attempts) + " submissions";
  if (!first.last_end.empty()) line += ", last ended as " + first.last_end;
  return line + "; see the logs *_" + std::to_string(first.shard) +
         ".log in the sweep's folder slurm/, mend it and give the same command again to go on";
}

}  // namespace

Resubmission ShardsToResubmit(std::vector<ShardProgress>& shards, const QueueState& queue,
                              const ResubmissionRules& rules) {
  Resubmission now;
  if (!queue.known) return now;
  bool others_go_on = false, exhausted = false;
  for (ShardProgress& shard : shards) {
    if (shard.complete()) continue;
    const Presence presence = PresenceOf(shard.shard, queue);
    if (!presence.ended.empty()) shard.last_end = presence.ended;
    if (presence.in_queue) {
      shard.absences = 0;
      others_go_on = true;
      continue;
    }
    if (shard.done > shard.done_at_attempt) shard.attempts = std::min(shard.attempts, 1);
    if (++shard.absences < AbsencesNeeded(shard, rules)) {
      others_go_on = true;
      continue;
    }
    now.cancel.insert(now.cancel.end(), presence.stuck.begin(), presence.stuck.end());
    if (shard.attempts >= rules.max_attempts) {
      exhausted = true;
    } else {
      now.shards.push_back(shard.shard);
    }
  }
  if (exhausted && !others_go_on && now.shards.empty()) now.give_up = GiveUpLine(shards, rules);
  return now;
}

void CountAttempt(std::vector<ShardProgress>& shards, const std::vector<int>& submitted) {
  for (ShardProgress& shard : shards) {
    if (std::find(submitted.begin(), submitted.end(), shard.shard) == submitted.end()) continue;
    shard.attempts = shard.done > shard.done_at_attempt ? 1 : shard.attempts + 1;
    shard.done_at_attempt = shard.done;
    shard.absences = 0;
  }
}

}  // namespace alula::scenarios::slurm

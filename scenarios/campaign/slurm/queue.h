#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace alula::scenarios::slurm {

enum class TaskState {
  kWaiting,  ///< in the queue, or requeued by Slurm after a node's death or a pre-emption
  kRunning,
  kStuck,  ///< held by Slurm itself after failed launches: it stays in the queue for ever
  kEnded,  ///< known to have ended, well or not; Slurm forgets such tasks after some minutes (MinJobAge)
};

/// One task of an array job as squeue tells of it.
struct Task {
  std::string job;  ///< id of the array job
  int shard = -1;   ///< its index in the array
  TaskState state = TaskState::kWaiting;
  std::string slurm_state;  ///< "RUNNING", "OUT_OF_MEMORY", …
  std::string reason;       ///< why it waits ("Resources", "BeginTime"), "None"
};

/// What the queue holds of one sweep. Where squeue could not be asked (the controller restarts, is busy), `known` is
/// false: nothing follows from it, least of all that tasks are gone.
struct QueueState {
  bool known = false;
  std::string problem = {};  ///< squeue's words in one line where not known
  std::vector<Task> tasks = {};
};

/// Submits a batch script and gives the id of the array job. Throws InputError where there is no Slurm or where it
/// refuses the job, in its own words; FaultError("slurm_unavailable") where the controller could not be reached or gave
/// no answer: the job may or may not have been taken, AskQueue tells.
std::string Submit(const std::string& script);

/// The state of all of this user's tasks of this job name, whichever submission they are of. Throws InputError where
/// there is no Slurm.
QueueState AskQueue(const std::string& job_name);

/// Ends jobs ("17") or single tasks ("17_4"); those that have ended already are no error. Throws
/// FaultError("slurm_unavailable") where the controller could not be reached, InputError where Slurm refuses.
void Cancel(const std::vector<std::string>& jobs);

/// One more than the largest index that an array may have here (MaxArraySize of scontrol show config; Slurm's own
/// default, 1001, where it is not told). 0: this cluster allows no array jobs.
int MaxArraySize();

/// Reads `squeue --format=%F|%K|%T|%r`, a task a line; other lines (names of clusters, jobs without an array) are left.
std::vector<Task> ParseQueue(std::string_view text);

/// Reads sbatch's --parsable answer, "17" or "17;cluster"; empty where it is neither.
std::string ParseJobId(std::string_view text);

}  // namespace alula::scenarios::slurm

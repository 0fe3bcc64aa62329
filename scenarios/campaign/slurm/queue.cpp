#include "scenarios/campaign/slurm/queue.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>
#include <sstream>

#include "base/error.h"
#include "scenarios/campaign/slurm/run_command.h"

namespace alula::scenarios::slurm {

namespace {

/// Variables that would change what the batch script says; those of the site (SBATCH_ACCOUNT, SBATCH_PARTITION, …)
/// stay.
const std::vector<std::string> kNotForSbatch = {
    "SBATCH_ARRAY_INX", "SBATCH_EXPORT",  "SBATCH_JOB_NAME",   "SBATCH_OPEN_MODE", "SBATCH_OUTPUT",
    "SBATCH_ERROR",     "SBATCH_REQUEUE", "SBATCH_NO_REQUEUE", "SBATCH_SIGNAL",    "SBATCH_WAIT"};

/// What Slurm's programs say when the controller, not the user, is the trouble.
constexpr std::array<std::string_view, 9> kTransient = {"Unable to contact slurm controller",
                                                        "Socket timed out",
                                                        "Connection refused",
                                                        "Connection timed out",
                                                        "Zero Bytes were transmitted or received",
                                                        "Slurm backup controller in standby mode",
                                                        "Slurm temporarily unable to accept job",
                                                        "Resource temporarily unavailable",
                                                        "Communication connection failure"};

/// A program's words in one line, without its own name before each.
std::string OneLine(const CommandOutcome& outcome, const std::string& program) {
  if (outcome.timed_out) return "no answer in time";
  std::istringstream lines(outcome.err.empty() ? outcome.out : outcome.err);
  std::string line, text;
  while (std::getline(lines, line)) {
    for (const std::string& prefix : {program + ": ", std::string("error: "), std::string("fatal: ")}) {
      if (line.starts_with(prefix)) line.erase(0, prefix.size());
    }
    if (line.empty()) continue;
    text += (text.empty() ? "" : "; ") + line;
  }
  return text.empty() ? "ended with code " + std::to_string(outcome.exit_code) : text;
}

bool IsTransient(const CommandOutcome& outcome) {
  return outcome.timed_out || std::any_of(kTransient.begin(), kTransient.end(), [&outcome](std::string_view words) {
           return outcome.err.find(words) != std::string::npos;
         });
}

CommandOutcome Ask(const std::vector<std::string>& argv, const CommandOptions& options) {
  try {
    return RunCommand(argv, options);
  } catch (const base::InputError&) {
    throw base::InputError("Slurm is not installed: there is no " + argv.front() + " on the PATH; leave out " +
                           "--engine slurm or install slurm-wlm / load your site's module");
  }
}

/// Throws for an answer that is not a success.
[[noreturn]] void Refuse(const std::string& program, const CommandOutcome& outcome) {
  const std::string words = program + ": " + OneLine(outcome, program);
  if (IsTransient(outcome)) throw base::FaultError("slurm_unavailable", words);
  throw base::InputError("Slurm refuses: " + words);
}

TaskState StateOf(const std::string& state, const std::string& reason) {
  constexpr std::array<std::string_view, 10> kOver = {"BOOT_FAIL", "CANCELLED",     "COMPLETED", "DEADLINE", "FAILED",
                                                      "NODE_FAIL", "OUT_OF_MEMORY", "PREEMPTED", "REVOKED",  "TIMEOUT"};
  constexpr std::array<std::string_view, 5> kOnNode = {"RUNNING", "COMPLETING", "SUSPENDED", "STOPPED", "SIGNALING"};
  // Held by Slurm itself. Held by a person (JobHeldUser, JobHeldAdmin) is waiting: somebody will let it go.
  constexpr std::array<std::string_view, 3> kHeld = {"launch_failed_requeued_held", "job_requeued_in_held_state",
                                                     "JobHoldMaxRequeue"};
  std::string word = reason;  // "(launch failed requeued held)" in older releases
  std::replace(word.begin(), word.end(), ' ', '_');
  const auto is_in = [](const auto& list, std::string_view what) {
    return std::any_of(list.begin(), list.end(), [what](auto w) { return what.find(w) != what.npos; });
  };
  if (state == "REQUEUE_HOLD" || state == "SPECIAL_EXIT" || is_in(kHeld, word)) return TaskState::kStuck;
  if (std::find(kOver.begin(), kOver.end(), state) != kOver.end()) return TaskState::kEnded;
  if (std::find(kOnNode.begin(), kOnNode.end(), state) != kOnNode.end()) return TaskState::kRunning;
  return TaskState::kWaiting;  // PENDING, CONFIGURING, REQUEUED and what later releases may add: not known to be gone
}

std::optional<int> NumberIn(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

}  // namespace

std::string ParseJobId(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.remove_suffix(1);
  text = text.substr(text.rfind('\n') + 1);  // a site's wrapper may greet first
  const std::string_view id = text.substr(0, text.find(';'));
  return NumberIn(id) ? std::string(id) : std::string();
}

std::vector<Task> ParseQueue(std::string_view text) {
  std::vector<Task> tasks;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    Task task;
    std::string index;
    std::getline(fields, task.job, '|');
    std::getline(fields, index, '|');
    std::getline(fields, task.slurm_state, '|');
    std::getline(fields, task.reason);
    const std::optional<int> shard = NumberIn(index);
    if (!shard || !NumberIn(task.job) || task.slurm_state.empty()) continue;
    task.shard = *shard;
    task.state = StateOf(task.slurm_state, task.reason);
    tasks.push_back(std::move(task));
  }
  return tasks;
}

std::string Submit(const std::string& script) {
  const CommandOutcome outcome = Ask({"sbatch", "--parsable"}, {.input = script, .without = kNotForSbatch});
  const std::string id = ParseJobId(outcome.out);
  if (outcome.exit_code != 0 || outcome.timed_out || id.empty()) Refuse("sbatch", outcome);
  return id;
}

QueueState AskQueue(const std::string& job_name) {
  // Asked by name, not by number: an unknown number is an error to squeue, and a submission whose answer got lost is
  // found again. Ended tasks are asked for too, because their state says why a shard has to run again.
  const CommandOutcome outcome =
      Ask({"squeue", "--noheader", "--array", "--states=all", "--user=" + std::to_string(::geteuid()),
           "--name=" + job_name, "--format=%F|%K|%T|%r"},
          {.without = {"SQUEUE_"}});
  if (outcome.exit_code != 0 || outcome.timed_out) {
    return {.problem = "squeue: " + OneLine(outcome, "squeue")};
  }
  return {.known = true, .tasks = ParseQueue(outcome.out)};
}

void Cancel(const std::vector<std::string>& jobs) {
  if (jobs.empty()) return;
  std::vector<std::string> argv = {"scancel"};
  argv.insert(argv.end(), jobs.begin(), jobs.end());
  const CommandOutcome outcome = Ask(argv, {.without = {"SCANCEL_"}});
  if (outcome.exit_code == 0 && !outcome.timed_out) return;
  // One that is over is no trouble, and does not keep scancel from the others.
  const bool over = outcome.err.find("Invalid job id") != std::string::npos ||
                    outcome.err.find("already completing or completed") != std::string::npos;
  if (!over || IsTransient(outcome)) Refuse("scancel", outcome);
}

int MaxArraySize() {
  constexpr int kSlurmDefault = 1001;
  const CommandOutcome outcome = Ask({"scontrol", "show", "config"}, {});
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key, equals;
    int value = 0;
    if (words >> key >> equals >> value && key == "MaxArraySize") return value;
  }
  return kSlurmDefault;
}

}  // namespace alula::scenarios::slurm

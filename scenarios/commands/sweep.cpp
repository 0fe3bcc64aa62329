#include "scenarios/campaign/sweep.h"

#include <sys/sysinfo.h>

#include <algorithm>
#include <cstdio>
#include <thread>

#include "base/error.h"
#include "scenarios/campaign/compare.h"
#include "scenarios/campaign/progress.h"
#include "scenarios/campaign/report.h"
#include "scenarios/campaign/slurm_sweep.h"
#include "scenarios/commands/verbs.h"
#include "scenarios/exit_codes.h"
#include "scenarios/scenario.h"
#include "scenarios/write_file.h"

namespace alula::scenarios::commands {
namespace fs = std::filesystem;
namespace {

using namespace campaign;

constexpr std::int64_t kRuns = 20;
constexpr std::int64_t kRunsToSearch = 2000;  // at most
constexpr std::int64_t kRunsToDecide = 1000;  // at most, where --require stops earlier

SweepPlan PlanOf(const CommandLine& line) {
  const SweepLine& asked = line.sweep;
  SweepPlan plan;
  plan.scenario = fs::absolute(FindScenario(line.names.front())).lexically_normal().string();
  plan.overrides = line.overrides;
  plan.order = ParseOrder(asked.order);
  for (const std::string& text : asked.grid) plan.grid.push_back(ParseGrid(text));
  if (!asked.list.empty()) {
    if (!plan.grid.empty()) throw base::InputError("sweep: --grid and --list exclude each other");
    ReadList(asked.list, plan);
  }
  if (!asked.seeds.empty()) {
    plan.seeds = ParseSeeds(asked.seeds);
    return plan;
  }
  const std::int64_t usual = !asked.search.empty()   ? kRunsToSearch
                             : plan.Variants() > 1   ? static_cast<std::int64_t>(plan.Variants())
                             : asked.require.empty() ? kRuns
                                                     : kRunsToDecide;
  constexpr std::uint64_t kLargest = 1'000'000'000'000'000'000;  // SQLite's integers have a sign
  const std::uint64_t first = line.seed.value_or(1);
  if (first > kLargest) throw base::InputError("--seed: a sweep's seeds end at " + std::to_string(kLargest));
  for (std::int64_t i = 0; i < asked.runs.value_or(usual); ++i) {
    plan.seeds.push_back(first + static_cast<std::uint64_t>(i));
  }
  return plan;
}

std::uint64_t PhysicalMemory() {
  struct sysinfo info = {};
  ::sysinfo(&info);
  return static_cast<std::uint64_t>(info.totalram) * info.mem_unit;
}

ExecutorOptions ExecutorOf(const CommandLine& line) {
  ExecutorOptions options;
  options.jobs =
      line.sweep.jobs > 0 ? line.sweep.jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  options.workers = line.workers;
  options.render = line.render;
  options.limits = line.limits;
  if (!options.limits.memory) {  // one run must not take the machine down, and the sweep with it
    options.limits.memory = PhysicalMemory() / 10 * 8 / static_cast<std::uint64_t>(options.jobs);
  }
  const std::string& keep = line.sweep.keep;
  options.keep = keep == "all" ? Keep::kAll : keep == "none" ? Keep::kNone : Keep::kFailed;
  return options;
}

int Compare(const CommandLine& line) {
  const Comparison comparison = CompareSweeps(line.sweep.compare.at(0), line.sweep.compare.at(1));
  if (line.json != "-") std::fputs(ToTable(comparison).c_str(), stdout);
  if (!line.json.empty()) WriteFile("--json", line.json, ToJson(comparison));
  return kExitPassed;
}

void WriteResult(const SweepResult& result, const CommandLine& line) {
  if (line.json != "-") std::fputs((line.quiet ? LastLine(result) + "\n" : ToTable(result)).c_str(), stdout);
  if (!line.json.empty()) WriteFile("--json", line.json, ToJson(result));
  if (!line.junit.empty()) WriteFile("--junit", line.junit, JunitXml(JunitCases(result)));
}

/// A budget that cannot decide whatever happens is said before an hour is spent on it.
void WarnOfSmallBudget(const SweepRequest& request) {
  for (const statistics::Requirement& requirement : request.requirements) {
    const std::int64_t least = statistics::RunsIfAllPass(requirement.rate);
    if (static_cast<std::int64_t>(request.plan.seeds.size()) >= least) continue;
    std::fprintf(stderr, "note: %s: cannot be confirmed by %zu runs; without a failure it takes %lld\n",
                 requirement.text.c_str(), request.plan.seeds.size(), static_cast<long long>(least));
  }
}

int Worker(const CommandLine& line) {
  const SweepResult result = RunWorker(line.sweep.worker, line.sweep.shard);
  std::printf("shard %d: %zu of %zu runs are there, %zu flown now\n", line.sweep.shard, result.rows.size(),
              result.planned, result.flown);
  return result.interrupted ? kExitInterrupted : kExitPassed;  // how runs ended is in their rows
}

int Search(const SweepRequest& request, const CommandLine& line) {
  if (!line.sweep.require.empty()) throw base::InputError("sweep: --search and --require exclude each other");
  SweepProgress progress(fs::path(request.plan.scenario).stem().string(), line.talks(), false);
  SweepRequest told = request;
  told.news = [&progress](const SweepNews& news) { progress.Show(news); };
  const FailureSweepResult result = SearchFailures(told, {});
  progress.Clear();
  if (result.sweep.interrupted) {
    std::fprintf(stderr, "interrupted: %zu runs are safe; the same command goes on\n", result.sweep.rows.size());
    return kExitInterrupted;
  }
  if (line.json != "-") std::fputs((line.quiet ? LastLine(result) + "\n" : ToTable(result)).c_str(), stdout);
  if (!line.json.empty()) WriteFile("--json", line.json, ToJson(result));
  return kExitPassed;
}

int SlurmSweep(const SweepRequest& sweep, const CommandLine& line) {
  SlurmRequest request{sweep, line.sweep.shards, line.sweep.slurm_options, line.sweep.watch, nullptr};
  if (line.sweep.jobs == 0) request.sweep.executor.jobs = 1;  // one processor a task
  request.sweep.executor.limits.memory = line.limits.memory;  // else the cluster's own limits hold
  if (line.sweep.dry_run) {
    std::fputs(DryRun(request).c_str(), stdout);
    return kExitPassed;
  }
  SweepProgress progress(fs::path(sweep.plan.scenario).stem().string(), line.talks());
  request.sweep.news = [&progress](const SweepNews& news) { progress.Show(news); };
  if (line.talks()) {
    request.tell = [&progress](const std::string& text) {
      progress.Clear();
      std::fprintf(stderr, "%s\n", text.c_str());
    };
  }
  const SlurmResult result = RunSlurmSweep(request);
  progress.Clear();
  if (result.finished) {
    WriteResult(result.sweep, line);
    return campaign::ExitCode(result.sweep);
  }
  std::printf("%zu of %zu runs are there; the cluster goes on, and the same command with --watch looks after it\n",
              result.sweep.rows.size(), result.sweep.planned);
  return result.sweep.interrupted ? kExitInterrupted : kExitPassed;
}

int SweepOrWorse(const CommandLine& line) {
  if (!line.sweep.worker.empty()) return Worker(line);
  if (!line.sweep.compare.empty()) return Compare(line);
  SweepRequest request;
  request.plan = PlanOf(line);
  const std::string name = fs::path(request.plan.scenario).stem().string();
  request.out = line.out ? *line.out : fs::path("sweeps") / name;
  request.fresh = line.sweep.fresh;
  for (const std::string& text : line.sweep.require) {
    request.requirements.push_back(statistics::ParseRequirement(text));
  }
  request.executor = ExecutorOf(line);
  WarnOfSmallBudget(request);
  if (line.sweep.engine == "slurm") return SlurmSweep(request, line);
  if (!line.sweep.search.empty()) return Search(request, line);
  SweepProgress progress(name, line.talks());
  request.news = [&progress](const SweepNews& news) { progress.Show(news); };
  const SweepResult result = RunSweep(request);
  progress.Clear();
  WriteResult(result, line);
  if (result.interrupted) {
    std::fprintf(stderr, "interrupted: %zu of %zu runs are safe; the same command goes on\n", result.rows.size(),
                 result.planned);
  }
  return campaign::ExitCode(result);
}

}  // namespace

int Sweep(const CommandLine& line) {
  try {
    return SweepOrWorse(line);
  } catch (const base::FaultError& e) {
    if (e.reason() != "disk") throw;
    throw base::FaultError(e.reason(), std::string(e.what()) + "; what was flown is safe, the same command goes on");
  }
}

}  // namespace alula::scenarios::commands

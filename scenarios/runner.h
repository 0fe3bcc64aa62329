#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/time.h"
#include "scenarios/factories.h"
#include "scenarios/scenario.h"
#include "scenarios/supervisor.h"
#include "scenarios/verdict.h"
#include "sim/interval_digests.h"

namespace alula::scenarios {

/// An observer that shows a run (a film) and leaves files in its folder.
class Spectator : public sim::Observer {
 public:
  /// The run has ended, however it did; called before its files are put in place.
  virtual void Finish() = 0;
};

/// What a spectator may want to know when it is made.
struct Stage {
  const worlds::World& world;
  const vehicles::VehicleBody& body;
  const stack::Calibration& calibration;  // the true one
  std::string render;                     // maker of pictures
  std::filesystem::path folder;           // where its files go; empty when the run writes none
};
using SpectatorMaker = std::function<std::unique_ptr<Spectator>(const Stage&)>;

struct RunOptions {
  int workers = 1;                           // threads inside the run; they change no result
  std::string render = "auto";               // maker of pictures
  std::optional<std::filesystem::path> out;  // the run's folder; none: nothing is written
  StackMaker stack;                          // flies in place of the scenario's own stack
  std::vector<SpectatorMaker> spectators;
  std::function<void(base::Time)> progress;                    // called every 100 ms of simulated time
  std::function<void(const sim::DigestRow&)> interval_digest;  // called with every row of digests.csv
  const std::atomic<bool>* interrupt = nullptr;
  std::atomic<std::int64_t>* pulse = nullptr;  // told the simulated time in ns after each step
};

/// The run was stopped from outside; nothing was written.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// Builds everything, flies it to its end and writes the run folder (DESIGN.md, section 5). A fault inside (an
/// exception, a NaN) is a verdict too; its folder holds what led to it. Throws base::InputError for bad input, and
/// Interrupted.
Verdict RunScenario(const Scenario& scenario, const RunOptions& options);

/// The verdict of a run whose process `pid` died. Its folder, where it had one, is completed: with what the process had
/// written there.
Verdict ConcludeDeadRun(const Scenario& scenario, const std::optional<std::filesystem::path>& out, pid_t pid,
                        const Death& death);

/// All parts of a scenario's simulation, without observers: for benchmarks and tests that step it themselves.
sim::SimulationParts BuildParts(const Scenario& scenario, const RunOptions& options);

/// Builds world, vehicle, autopilot and stack and throws them away: whatever is wrong with a scenario shows.
void TryToBuild(const Scenario& scenario);

/// When the run is expected to end at the latest, from its time limit; for progress bars.
std::optional<base::Duration> LimitOf(const ScenarioConfig& config);

}  // namespace alula::scenarios

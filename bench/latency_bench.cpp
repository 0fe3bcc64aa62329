#include <fmt/format.h>

#include <variant>

#include "base/error.h"
#include "bench/bench.h"
#include "scenarios/runner.h"
#include "sim/simulation.h"

namespace alula::bench {
namespace {

constexpr double kFlown = 30.0;  // s of seed 1: take-off, scan and most of the course

void Compare(const stack::StageTime& stage, base::Duration declared, Figures& figures) {
  const std::string key = "latency/courtyard/" + stage.name + "/";
  figures.Add(key + "p99_ms", stage.p99_ms);
  figures.Add(key + "declared_ms", declared.Seconds() * 1e3);
  if (stage.p99_ms <= declared.Seconds() * 1e3) return;
  figures.Fail(fmt::format("{}: declared {:.0f} ms, but one call in a hundred takes more than {:.0f} ms", stage.name,
                           declared.Seconds() * 1e3, stage.p99_ms));
}

}  // namespace

/// The stack's declared latencies beside the processor time that its jobs really take.
void Run_latency(Figures& figures) {
  const scenarios::Scenario scenario =
      scenarios::LoadScenario(scenarios::FindScenario("courtyard_gates"), {}, std::uint64_t{1});
  const auto* config = std::get_if<stack::pilot::VisualInertialConfig>(&scenario.config.stack);
  if (config == nullptr) throw base::FaultError("bench", "courtyard_gates does not fly the visual-inertial stack");
  sim::Simulation simulation(scenarios::BuildParts(scenario, {}));
  while (simulation.time().Seconds() < kFlown) simulation.Step();
  for (const stack::StageTime& stage : simulation.Timing()) {
    if (stage.name == "stack/odometry") Compare(stage, config->latency.odometry, figures);
    if (stage.name == "stack/mapping") Compare(stage, config->latency.mapping, figures);
    if (stage.name == "stack/planning") Compare(stage, config->latency.planning, figures);
  }
}

}  // namespace alula::bench

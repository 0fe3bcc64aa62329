#include "scenarios/runner.h"

#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "scenarios/end_of_stack.h"
#include "scenarios/numeric_class.h"
#include "scenarios/world_json.h"
#include "sim/actor_recorder.h"
#include "sim/faults/scope.h"
#include "sim/interval_digests.h"
#include "sim/run_folder.h"

namespace alula::scenarios {
namespace {

constexpr const char* kVehicle = "vehicle0";

/// Puts a run's files in place; what not every run leaves is named, so that none of an earlier run stays.
void Commit(sim::RunFolder& folder) {
  folder.Commit({"map.bt", "video.mp4", "dataset", "crash.txt", "world.json", "timing.json", "truth.tum",
                 "estimate.tum", "telemetry.csv", "digests.csv", "actors.csv"});
}

/// All that a run is made of besides the simulation itself.
struct Cast {
  stack::Calibration calibration;  // true
  std::vector<std::unique_ptr<Criterion>> criteria;
  std::vector<std::unique_ptr<Spectator>> spectators;
  std::unique_ptr<sim::IntervalDigests> digests;
  EndOfStack end_of_stack;
  std::unique_ptr<sim::RunFolder> folder;
  std::unique_ptr<sim::Recorder> recorder;
  std::unique_ptr<sim::ActorRecorder> actors;  // null: the world has none
};

std::vector<base::Vec3> Waypoints(const MissionConfig& mission, const base::Transform& X_WB) {
  std::vector<base::Vec3> waypoints;
  for (const base::Vec3& w : mission.waypoints) waypoints.push_back(X_WB.p + w);
  return waypoints;
}

stack::Calibration CalibrationOf(const Scenario& scenario, const vehicles::VehicleModel& vehicle) {
  return sim::TrueCalibration(scenario.config.sensors, vehicle.body(), kVehicle,
                              scenario.config.simulation.magnetic_field);
}

std::unique_ptr<stack::NavigationStack> MakeStack(const Scenario& scenario, const RunOptions& options,
                                                  const stack::Calibration& truth, const worlds::World& world,
                                                  const vehicles::VehicleModel& vehicle) {
  const StackMaker maker = options.stack ? options.stack : MakerOf(scenario.config.stack);
  if (!maker) return nullptr;
  const base::Transform X_WB =
      vehicle.body().prescribed ? vehicle.Prescribed({}).X_WB : sim::StartPose(world, truth.standing_height);
  const stack::Mission mission = sim::SurveyMission(world, X_WB, Waypoints(scenario.config.mission, X_WB),
                                                    scenario.config.knowledge, scenario.seed);
  const stack::Calibration calibration = sim::Misjudge(truth, scenario.config.knowledge, scenario.seed);
  try {
    return maker(calibration, mission, scenario.seed, options.workers);
  } catch (const base::InputError&) {
    throw;
  } catch (const std::exception& e) {
    throw base::FaultError("stack_exception", e.what());
  }
}

sim::SimulationParts MakeParts(const Scenario& scenario, const RunOptions& options) {
  const ScenarioConfig& config = scenario.config;
  sim::SimulationParts parts;
  parts.config = config.simulation;
  parts.sensors = config.sensors;
  parts.autopilot_sensors = config.autopilot_sensors;
  parts.faults = config.faults;
  parts.world = MakeWorld(config.world, scenario.seed);
  parts.vehicle = MakeVehicle(config.vehicle, kVehicle, scenario.seed);
  parts.autopilot = MakeAutopilot(config.autopilot, config.vehicle);
  parts.vehicle_id = kVehicle;
  parts.seed = scenario.seed;
  parts.workers = options.workers;
  if (sim::HasCameras(config.sensors)) {
    std::vector<render::Mover> movers;
    if (sim::SeesVehicle(config.sensors)) {
      for (const vehicles::Part& part : parts.vehicle->body().parts) {
        movers.push_back({part.name, part.shape, part.material});
      }
    }
    for (render::Mover& mover : render::MoversOf(*parts.world)) movers.push_back(std::move(mover));
    parts.renderer = render::MakeRenderer(options.render, *parts.world, movers);
  }
  return parts;
}

void Assemble(const Scenario& scenario, const RunOptions& options, sim::SimulationParts& parts, Cast& cast) {
  for (const CriterionConfig& criterion : scenario.config.criteria) {
    cast.criteria.push_back(MakeCriterion(criterion));
    parts.observers.push_back(cast.criteria.back().get());
  }
  parts.observers.push_back(&cast.end_of_stack);
  cast.digests = std::make_unique<sim::IntervalDigests>(scenario.config.recorder.digest_interval, cast.folder.get(),
                                                        options.interval_digest);
  parts.observers.push_back(cast.digests.get());
  if (cast.folder) {
    cast.recorder = std::make_unique<sim::Recorder>(scenario.config.recorder, *cast.folder);
    parts.observers.push_back(cast.recorder.get());
    if (!parts.world->actors.empty()) {
      cast.actors =
          std::make_unique<sim::ActorRecorder>(scenario.config.recorder.actors_rate, *parts.world, *cast.folder);
      parts.observers.push_back(cast.actors.get());
    }
  }
  const Stage stage{*parts.world, parts.vehicle->body(), cast.calibration, options.render,
                    cast.folder ? cast.folder->PathOf("") : std::filesystem::path()};
  for (const SpectatorMaker& maker : options.spectators) {
    cast.spectators.push_back(maker(stage));
    parts.observers.push_back(cast.spectators.back().get());
  }
}

/// Steps until an observer ends the run; its reason.
std::string Fly(sim::Simulation& simulation, const RunOptions& options) {
  constexpr std::int64_t kProgressPeriod = 100'000'000;
  for (;;) {
    if (options.interrupt != nullptr && options.interrupt->load(std::memory_order_relaxed)) throw Interrupted();
    const std::optional<std::string> reason = simulation.Step();
    if (options.pulse != nullptr) options.pulse->store(simulation.time().ns, std::memory_order_relaxed);
    if (reason) return *reason;
    if (options.progress && simulation.time().ns % kProgressPeriod == 0) options.progress(simulation.time());
  }
}

void Judge(const Cast& cast, Verdict& verdict) {
  bool passed = true;
  for (const auto& criterion : cast.criteria) {
    for (Check& check : criterion->Checks()) {
      passed = passed && check.passed;
      verdict.checks.push_back(std::move(check));
    }
    criterion->AddMetrics(verdict.metrics);
  }
  const bool fault = verdict.outcome == Outcome::kFault;
  verdict.checks.push_back(AtMost("faults", fault ? 1.0 : 0.0, 0.0, "1"));
  if (!fault) verdict.outcome = passed ? Outcome::kPass : Outcome::kFail;

  const sim::RunDigest& digest = cast.digests->digest();
  verdict.digest = digest.Hex();
  for (std::size_t i = 0; i < sim::kStreams; ++i) {
    verdict.digests.emplace(sim::kStreamNames[i], digest.streams[i].Hex());
  }
}

std::string TimingJson(const sim::Simulation* simulation, double wall_s) {
  nlohmann::ordered_json json;
  const double simulated_s = simulation != nullptr ? simulation->time().Seconds() : 0.0;
  json["real_time_factor"] = wall_s > 0.0 ? simulated_s / wall_s : 0.0;
  json["simulated_s"] = simulated_s;
  json["wall_s"] = wall_s;
  json["stages"] = nlohmann::ordered_json::object();
  json["details"] = nlohmann::ordered_json::object();
  if (simulation != nullptr) {
    for (const stack::StageTime& stage : simulation->Timing()) {
      json["stages"][stage.name] = stage.wall_ms;
      json["details"][stage.name] = {{"calls", stage.calls}, {"p99_ms", stage.p99_ms}};
    }
  }
  return json.dump(2) + "\n";
}

void WriteFolder(const Scenario& scenario, const worlds::World& world, const Verdict& verdict,
                 const std::string& timing, const std::vector<stack::StackFile>& files, Cast& cast) {
  const base::Time end =
      base::Time{} + base::Seconds(verdict.metrics.contains("duration_s") ? verdict.metrics.at("duration_s") : 0.0);
  cast.recorder->AddEvent(end, "run", "end",
                          verdict.message.empty() ? verdict.reason : verdict.reason + ": " + verdict.message);
  cast.recorder->Finish();
  if (cast.actors) cast.actors->Finish();
  for (const stack::StackFile& file : files) cast.folder->Write(file.name, file.bytes);  // first: ours stand
  cast.folder->Write("scenario.yaml", base::DumpConfig(scenario.config));
  cast.folder->Write("world.json", WorldToJson(world));
  cast.folder->Write("timing.json", timing);
  cast.folder->Write("verdict.json", ToJson(verdict));
  Commit(*cast.folder);
}

}  // namespace

Verdict RunScenario(const Scenario& scenario, const RunOptions& options) {
  Verdict verdict;
  verdict.seed = scenario.seed;
  verdict.scenario = scenario.name;
  Cast cast;
  sim::SimulationParts parts = MakeParts(scenario, options);
  cast.calibration = CalibrationOf(scenario, *parts.vehicle);
  verdict.versions = Versions(parts.renderer ? parts.renderer->Description() : "");
  verdict.numeric_class = NumericClass(verdict.versions);
  const std::shared_ptr<const worlds::World> world = parts.world;

  const auto begin = std::chrono::steady_clock::now();  // for timing.json only
  std::unique_ptr<sim::Simulation> simulation;
  const auto fault = [&](std::string reason, std::string message) {
    verdict.outcome = Outcome::kFault;
    verdict.reason = std::move(reason);
    verdict.message = std::move(message);
  };
  if (options.out) {
    cast.folder = std::make_unique<sim::RunFolder>(*options.out);
    cast.folder->Write("scenario.yaml", base::DumpConfig(scenario.config));  // first: a run may die at any time
  }
  Assemble(scenario, options, parts, cast);
  try {
    parts.stack = MakeStack(scenario, options, cast.calibration, *world, *parts.vehicle);
    if (const auto* plugin = std::get_if<PluginConfig>(&scenario.config.stack)) {
      verdict.versions["stack_library"] = HashOfLibrary(plugin->library);
    }
    simulation = std::make_unique<sim::Simulation>(std::move(parts));
    verdict.outcome = Outcome::kFail;
    verdict.reason = Fly(*simulation, options);
  } catch (const base::InputError&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const base::FaultError& e) {
    fault(e.reason(), e.what());
  } catch (const std::bad_alloc&) {
    fault("memory", "there is no more memory");
  } catch (const std::exception& e) {
    fault("exception", e.what());
  }
  std::vector<stack::StackFile> files;
  try {
    if (simulation && cast.folder) files = simulation->StackFiles();
  } catch (const base::FaultError& e) {
    if (verdict.outcome != Outcome::kFault) fault(e.reason(), e.what());
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  for (const auto& spectator : cast.spectators) spectator->Finish();
  cast.digests->Finish();
  Judge(cast, verdict);
  if (cast.folder) WriteFolder(scenario, *world, verdict, TimingJson(simulation.get(), wall.count()), files, cast);
  return verdict;
}

Verdict ConcludeDeadRun(const Scenario& scenario, const std::optional<std::filesystem::path>& out, pid_t pid,
                        const Death& death) {
  Verdict verdict;
  verdict.outcome = Outcome::kFault;
  verdict.reason = death.reason;
  verdict.message = fmt::format("{}, {:.3f} s into the flight", death.message, death.simulated.Seconds());
  verdict.checks = {AtMost("faults", 1.0, 0.0, "1")};
  verdict.metrics = {{"duration_s", death.simulated.Seconds()}};
  verdict.versions = Versions("");
  verdict.numeric_class = NumericClass(verdict.versions);
  verdict.seed = scenario.seed;
  verdict.scenario = scenario.name;
  if (!out) return verdict;
  sim::RunFolder folder(*out, pid);
  std::ofstream(folder.PathOf("events.jsonl"), std::ios::app)
      << sim::EventLine(death.simulated, "run", "end", verdict.reason + ": " + verdict.message);
  folder.Write("scenario.yaml", base::DumpConfig(scenario.config));
  folder.Write("verdict.json", ToJson(verdict));
  Commit(folder);
  return verdict;
}

sim::SimulationParts BuildParts(const Scenario& scenario, const RunOptions& options) {
  sim::SimulationParts parts = MakeParts(scenario, options);
  parts.stack = MakeStack(scenario, options, CalibrationOf(scenario, *parts.vehicle), *parts.world, *parts.vehicle);
  return parts;
}

void TryToBuild(const Scenario& scenario) {
  const auto world = MakeWorld(scenario.config.world, scenario.seed);
  const auto vehicle = MakeVehicle(scenario.config.vehicle, kVehicle);
  const auto autopilot = MakeAutopilot(scenario.config.autopilot, scenario.config.vehicle);
  const auto stack = MakeStack(scenario, {}, CalibrationOf(scenario, *vehicle), *world, *vehicle);
  const sim::faults::Scope scope =
      sim::faults::ScopeOf(scenario.config.sensors, *vehicle, *world, kVehicle, autopilot != nullptr, stack != nullptr);
  const sim::faults::Injector faults(scenario.config.faults, scope, scenario.seed);
}

std::optional<base::Duration> LimitOf(const ScenarioConfig& config) {
  for (const CriterionConfig& criterion : config.criteria) {
    if (const auto* limit = std::get_if<TimeLimitConfig>(&criterion)) return limit->limit;
  }
  return std::nullopt;
}

}  // namespace alula::scenarios

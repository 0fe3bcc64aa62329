#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "scenarios/check/landing_check.h"
#include "scenarios/check/rotor_check.h"
#include "scenarios/check/sensor_checks.h"
#include "scenarios/commands/verbs.h"
#include "scenarios/exit_codes.h"
#include "scenarios/factories.h"
#include "scenarios/runner.h"
#include "scenarios/scenario.h"
#include "scenarios/write_file.h"

namespace alula::scenarios::commands {

namespace {

/// What an entry says of itself: a scenario its `meaning`, a vehicle or a world the comment that its file begins with.
std::string MeaningOf(const CatalogEntry& entry) {
  if (entry.kind == "scenario") return LoadScenario(entry.file, {}, std::nullopt).config.meaning;
  std::ifstream file(entry.file);
  std::string first;
  std::getline(file, first);
  return first.starts_with("# ") ? first.substr(2) : std::string();
}

}  // namespace

int List(const CommandLine& line) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const CatalogEntry& entry : ListCatalogs()) {
    if (!line.kind.empty() && line.kind != entry.kind + "s") continue;
    const std::string meaning = MeaningOf(entry);
    json.push_back({{"kind", entry.kind}, {"name", entry.name}, {"meaning", meaning}});
    if (line.json != "-") std::printf("%-10s%-27s %s\n", entry.kind.c_str(), entry.name.c_str(), meaning.c_str());
  }
  if (!line.json.empty()) WriteFile("--json", line.json, json.dump(2) + "\n");
  return 0;
}

int CheckFiles(const CommandLine& line) {
  for (const std::string& name : line.names) {
    const CatalogEntry entry = FindAny(name);
    const std::uint64_t seed = line.seed.value_or(1);
    if (entry.kind == "vehicle") {
      MakeVehicle(LoadVehicle(entry.file, line.overrides, seed), "vehicle0");
    } else if (entry.kind == "world") {
      MakeWorld(LoadWorld(entry.file, line.overrides, seed), seed);
    } else {
      TryToBuild(LoadScenario(entry.file, line.overrides, line.seed));
    }
    if (!line.quiet) std::printf("%s: good\n", entry.file.c_str());
  }
  return 0;
}

int CheckSensors(const CommandLine& line) {
  const Scenario scenario = LoadScenario(FindScenario(line.names.front()), line.overrides, line.seed);
  const bool terminal = ::isatty(STDERR_FILENO) != 0;
  const auto told = [terminal](const std::string& what) {
    if (terminal) std::fprintf(stderr, "\r%-70s", what.c_str());
  };
  check::Rig rig;
  rig.sensors = scenario.config.sensors;
  rig.body = MakeVehicle(scenario.config.vehicle, check::kVehicle)->body();
  rig.step = scenario.config.simulation.step;
  rig.B_W = sim::FluxDensity(scenario.config.simulation.magnetic_field);
  rig.seed = scenario.seed;
  rig.render = line.render;
  check::Report report = check::CheckSensors(rig, scenario.config.sensors, told);
  if (const auto* quadrotor = std::get_if<vehicles::QuadrotorConfig>(&scenario.config.vehicle)) {
    told("rotors: ground effect, vortex ring");
    check::CheckRotors(*quadrotor, *quadrotor, scenario.seed, report);
  }
  if (terminal) std::fprintf(stderr, "\r%-70s\r", "");
  if (line.json != "-") std::fputs(check::ToTable(report).c_str(), stdout);
  if (!line.json.empty()) WriteFile("--json", line.json, check::ToJson(report, scenario.name));
  return report.passed() ? 0 : kExitFailed;
}

int CheckLanding(const CommandLine& line) {
  const CatalogEntry entry = FindAny(line.names.front());
  if (entry.kind != "world") {
    throw base::InputError(line.names.front() + ": is a " + entry.kind + ", no world ('alula list worlds' names them)");
  }
  const std::uint64_t seed = line.seed.value_or(1);
  const auto world = MakeWorld(LoadWorld(entry.file, line.overrides, seed), seed);
  const auto vehicle = MakeVehicle(LoadVehicle(FindAny("q250").file, {}, seed), check::kVehicle);
  const check::LandingReport report = check::CheckLandingSites(*world, vehicle->body(), line.drops, seed);
  if (line.out) {
    std::filesystem::create_directories(*line.out);
    WriteFile("--out", *line.out / "grid.pgm", check::ToPgm(report.sites));
    WriteFile("--out", *line.out / "grid.yaml", check::ToMapYaml(report.sites));
  }
  const bool passed = check::Passed(report);
  if (line.json != "-") {
    std::printf("%s%s: %s, seed %llu\n", check::ToTable(report).c_str(), entry.name.c_str(), passed ? "pass" : "fail",
                static_cast<unsigned long long>(seed));
  }
  if (!line.json.empty()) WriteFile("--json", line.json, check::ToJson(report, entry.name));
  return passed ? kExitPassed : kExitFailed;
}

}  // namespace alula::scenarios::commands

#include "scenarios/scenario.h"

#include <algorithm>

#include "base/error.h"
#include "base/nearest.h"
#include "worlds/assets.h"

namespace alula::scenarios {
namespace fs = std::filesystem;
namespace {

fs::path SourceTree() { return ALULA_SOURCE_DIR; }

}  // namespace

void Describe(base::Description& d, MissionConfig& c) {
  d.Field("waypoints", c.waypoints,
          {.unit = "m", .meaning = "places of the body origin in order, from where it stood at the start, world axes"});
}

void Describe(base::Description& d, ScenarioConfig& c) {
  d.Field("meaning", c.meaning, {.meaning = "one sentence for the list"});
  d.Field("seed", c.seed, {.meaning = "of all random numbers, unless the command line names one"});
  d.OneOf("world", c.world, {.meaning = "where it happens", .choices = {"open_ground", "courtyard"}});
  d.OneOf("vehicle", c.vehicle, {.meaning = "what moves", .choices = {"quadrotor", "prescribed"}});
  d.OneOf("autopilot", c.autopilot, {.meaning = "low-level control", .choices = {"none", "multicopter"}});
  d.Field("autopilot_sensors", c.autopilot_sensors, {.meaning = "what the autopilot owns"});
  d.Field("sensors", c.sensors, {.meaning = "what the stack is given"});
  d.Field("knowledge", c.knowledge, {.meaning = "how wrong the stack's calibration and mission are"});
  d.Field("mission", c.mission, {.meaning = "what is asked of the stack"});
  d.OneOf("stack", c.stack,
          {.meaning = "the software under test", .choices = {"none", "position_relay", "visual_inertial"}});
  d.Field("simulation", c.simulation, {.meaning = "the loop"});
  d.Field("recorder", c.recorder, {.meaning = "what is written down"});
  d.ListOf("criteria", c.criteria,
           {.meaning = "what the verdict is made of",
            .choices = {"time_limit", "contacts", "clearance", "gates", "target_reached", "mean_speed", "ate", "landed",
                        "hover_error", "bounds"}});
}

std::vector<fs::path> Catalogs() {
  return {SourceTree() / "scenarios" / "catalog", SourceTree() / "vehicles" / "catalog", worlds::CatalogPath()};
}

std::vector<fs::path> ListScenarios() {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(Catalogs().front())) {
    const fs::path& path = entry.path();
    if (path.extension() == ".yaml" && path.filename().string().front() != '_') files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  return files;
}

fs::path FindScenario(std::string_view name_or_path) {
  const fs::path given(name_or_path);
  if (given.extension() == ".yaml" || given.extension() == ".yml" || given.has_parent_path()) {
    if (!fs::is_regular_file(given)) throw base::InputError(given.string() + ": no such file");
    return given;
  }
  std::vector<std::string> names;
  for (const fs::path& file : ListScenarios()) {
    names.push_back(file.stem().string());
    if (names.back() == name_or_path) return file;
  }
  throw base::InputError("no scenario is called '" + std::string(name_or_path) + "'; " +
                         base::Suggestion(name_or_path, names, "scenarios"));
}

Scenario LoadScenario(const fs::path& file, const std::vector<base::Override>& overrides,
                      std::optional<std::uint64_t> seed) {
  const base::YamlDocument document = base::YamlDocument::Load(file, Catalogs(), overrides);
  if (!seed) seed = base::ReadConfig<ScenarioConfig>(document, 1).seed;
  Scenario scenario{file.stem().string(), *seed, base::ReadConfig<ScenarioConfig>(document, *seed)};
  scenario.config.seed = *seed;
  return scenario;
}

}  // namespace alula::scenarios

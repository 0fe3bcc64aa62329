#include "scenarios/scenario.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/nearest.h"
#include "worlds/assets.h"

namespace alula::scenarios {
namespace fs = std::filesystem;
namespace {

fs::path SourceTree() { return ALULA_SOURCE_DIR; }

constexpr const char* kKinds[] = {"scenario", "vehicle", "world"};  // in the order of Catalogs()

/// The words for the alternatives, as their structs say them.
template <typename... Ts>
std::vector<std::string_view> TypesOf(const std::variant<Ts...>&) {
  return {Ts::kType...};
}

void DescribeWorld(base::Description& d, WorldConfig& c) {
  d.OneOf("world", c, {.meaning = "where it happens", .choices = TypesOf(c)});
}
void DescribeVehicle(base::Description& d, VehicleConfig& c) {
  d.OneOf("vehicle", c, {.meaning = "what moves", .choices = {"quadrotor", "prescribed"}});
}

/// A scenario of which only one key is looked at.
struct VehiclePart {
  static constexpr const char* kKey = "vehicle";
  VehicleConfig vehicle;
};
void Describe(base::Description& d, VehiclePart& c) { DescribeVehicle(d, c.vehicle); }
struct WorldPart {
  static constexpr const char* kKey = "world";
  WorldConfig world;
};
void Describe(base::Description& d, WorldPart& c) { DescribeWorld(d, c.world); }

template <typename Part>
Part LoadPart(const fs::path& file, const std::vector<base::Override>& overrides, std::uint64_t seed) {
  const std::string text = std::string(Part::kKey) + ":\n  extends: " + fs::absolute(file).string() + "\n";
  return base::ReadConfig<Part>(base::YamlDocument::Parse(text, file.string(), Catalogs(), overrides), seed);
}

}  // namespace

void Describe(base::Description& d, MissionConfig& c) {
  d.Field("waypoints", c.waypoints,
          {.unit = "m", .meaning = "places of the body origin in order, from where it stood at the start, world axes"});
}

void Describe(base::Description& d, ScenarioConfig& c) {
  d.Field("meaning", c.meaning, {.meaning = "one sentence for the list"});
  d.Field("tags", c.tags, {.meaning = "groups for `alula run --all --tag`"});
  d.Field("seed", c.seed, {.meaning = "of all random numbers, unless the command line names one"});
  DescribeWorld(d, c.world);
  DescribeVehicle(d, c.vehicle);
  d.OneOf("autopilot", c.autopilot, {.meaning = "low-level control", .choices = {"none", "multicopter"}});
  d.Field("autopilot_sensors", c.autopilot_sensors, {.meaning = "what the autopilot owns"});
  d.Field("sensors", c.sensors, {.meaning = "what the stack is given"});
  sim::faults::DescribeFaults(d, c.faults);
  d.Field("knowledge", c.knowledge, {.meaning = "how wrong the stack's calibration and mission are"});
  d.Field("mission", c.mission, {.meaning = "what is asked of the stack"});
  d.OneOf("stack", c.stack,
          {.meaning = "the software under test",
           .choices = {"none", "position_relay", "visual_inertial", "slam", "plugin"}});
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

std::vector<CatalogEntry> ListCatalogs() {
  std::vector<CatalogEntry> entries;
  const std::vector<fs::path> folders = Catalogs();
  for (std::size_t i = 0; i < folders.size(); ++i) {
    const std::size_t first = entries.size();
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folders[i])) {
      const fs::path& path = entry.path();
      if (path.extension() != ".yaml" || path.filename().string().front() == '_') continue;
      entries.push_back({kKinds[i], NameOf(path), path});
    }
    std::sort(entries.begin() + static_cast<std::ptrdiff_t>(first), entries.end(),
              [](const CatalogEntry& a, const CatalogEntry& b) { return a.name < b.name; });
  }
  return entries;
}

std::vector<fs::path> ListScenarios() {
  std::vector<fs::path> files;
  for (const CatalogEntry& entry : ListCatalogs()) {
    if (entry.kind == kKinds[0]) files.push_back(entry.file);
  }
  return files;
}

std::string NameOf(const fs::path& file) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(file, error);
  for (const fs::path& folder : Catalogs()) {
    const fs::path inside = whole.lexically_relative(fs::weakly_canonical(folder, error));
    if (!inside.empty() && *inside.begin() != "..") return (inside.parent_path() / inside.stem()).generic_string();
  }
  return file.stem().string();
}

CatalogEntry FindAny(std::string_view name_or_path) {
  const fs::path given(name_or_path);
  std::vector<std::string> names;
  for (const CatalogEntry& entry : ListCatalogs()) {
    if (entry.name == name_or_path) return entry;
    names.push_back(entry.name);
  }
  if (given.extension() == ".yaml" || given.extension() == ".yml" || given.has_parent_path()) {
    if (!fs::is_regular_file(given)) throw base::InputError(given.string() + ": no such file");
    const std::vector<fs::path> folders = Catalogs();
    for (std::size_t i = 1; i < folders.size(); ++i) {
      if (fs::canonical(given).parent_path() == fs::canonical(folders[i])) {
        return {kKinds[i], given.stem().string(), given};
      }
    }
    return {kKinds[0], given.stem().string(), given};
  }
  throw base::InputError("nothing in the catalogs is called '" + std::string(name_or_path) + "'; " +
                         base::Suggestion(name_or_path, names, "names"));
}

fs::path FindScenario(std::string_view name_or_path) {
  const fs::path given(name_or_path);
  std::vector<std::string> names;
  for (const fs::path& file : ListScenarios()) {
    names.push_back(NameOf(file));
    if (names.back() == name_or_path) return file;
  }
  if (given.extension() == ".yaml" || given.extension() == ".yml" || given.has_parent_path()) {
    if (!fs::is_regular_file(given)) throw base::InputError(given.string() + ": no such file");
    return given;
  }
  throw base::InputError("no scenario is called '" + std::string(name_or_path) + "'; " +
                         base::Suggestion(name_or_path, names, "scenarios"));
}

VehicleConfig LoadVehicle(const fs::path& file, const std::vector<base::Override>& overrides, std::uint64_t seed) {
  return LoadPart<VehiclePart>(file, overrides, seed).vehicle;
}

WorldConfig LoadWorld(const fs::path& file, const std::vector<base::Override>& overrides, std::uint64_t seed) {
  return LoadPart<WorldPart>(file, overrides, seed).world;
}

Scenario ResolveScenario(const base::YamlDocument& document, std::string name, std::optional<std::uint64_t> seed,
                         base::Draws* draws) {
  if (!seed) seed = base::ReadConfig<ScenarioConfig>(document, 1).seed;
  Scenario scenario{std::move(name), *seed, base::ReadConfig<ScenarioConfig>(document, *seed, draws)};
  scenario.config.seed = *seed;
  return scenario;
}

base::YamlDocument LoadScenarioDocument(const fs::path& file, const std::vector<base::Override>& overrides) {
  return base::YamlDocument::Load(file, Catalogs(), overrides);
}

Scenario LoadScenario(const fs::path& file, const std::vector<base::Override>& overrides,
                      std::optional<std::uint64_t> seed) {
  return ResolveScenario(LoadScenarioDocument(file, overrides), NameOf(file), seed);
}

}  // namespace alula::scenarios

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/config.h"
#include "base/describe.h"
#include "scenarios/criteria/ate.h"
#include "scenarios/criteria/bounds.h"
#include "scenarios/criteria/clearance.h"
#include "scenarios/criteria/contacts.h"
#include "scenarios/criteria/gates.h"
#include "scenarios/criteria/hover_error.h"
#include "scenarios/criteria/landed.h"
#include "scenarios/criteria/mean_speed.h"
#include "scenarios/criteria/target_reached.h"
#include "scenarios/criteria/time_limit.h"
#include "scenarios/plugin/plugin_stack.h"
#include "sim/knowledge.h"
#include "sim/recorder.h"
#include "sim/simulation.h"
#include "stack/pilot/position_relay_stack.h"
#include "stack/pilot/slam_stack.h"
#include "stack/pilot/visual_inertial_stack.h"
#include "vehicles/multicopter_autopilot.h"
#include "vehicles/prescribed.h"
#include "vehicles/quadrotor.h"
#include "worlds/courtyard.h"
#include "worlds/indoor/machine_hall.h"
#include "worlds/indoor/office.h"
#include "worlds/indoor/office_floor.h"
#include "worlds/indoor/vicon_room.h"
#include "worlds/maps/planning_map.h"
#include "worlds/open_ground.h"
#include "worlds/outdoor/forest.h"
#include "worlds/outdoor/landing_town.h"
#include "worlds/outdoor/landing_woods.h"
#include "worlds/outdoor/open_field.h"
#include "worlds/outdoor/powerline.h"
#include "worlds/scene.h"

namespace alula::scenarios {

/// Nothing of its kind: no autopilot, no stack.
struct None {};
inline void Describe(base::Description&, None&) {}

// What a scenario can be made of. These lists, the words for them in scenario.cpp and the makers in factories.cpp are
// the one place that names concrete worlds, vehicles, autopilots, stacks and criteria. A world's config says its own
// word (kType), and worlds::MakeWorld makes it: its entry here is all that it needs.
using WorldConfig =
    std::variant<worlds::OpenGroundConfig, worlds::CourtyardConfig, worlds::PlanningMapConfig, worlds::SceneConfig,
                 worlds::ForestConfig, worlds::OpenFieldConfig, worlds::LandingForestConfig, worlds::LandingSlopeConfig,
                 worlds::LandingFieldConfig, worlds::LandingSquareConfig, worlds::LandingFlowerbedsConfig,
                 worlds::PowerlineConfig, worlds::MachineHallConfig, worlds::ViconRoomConfig, worlds::OfficeConfig,
                 worlds::OfficeFloorConfig>;
using VehicleConfig = std::variant<vehicles::QuadrotorConfig, vehicles::PrescribedConfig>;
using AutopilotConfig = std::variant<None, vehicles::MulticopterAutopilotConfig>;
using StackConfig = std::variant<None, stack::pilot::PositionRelayConfig, stack::pilot::VisualInertialConfig,
                                 stack::pilot::SlamStackConfig, PluginConfig>;
using CriterionConfig = std::variant<TimeLimitConfig, ContactsConfig, ClearanceConfig, GatesConfig, TargetReachedConfig,
                                     MeanSpeedConfig, AteConfig, LandedConfig, HoverErrorConfig, BoundsConfig>;

/// What is asked of the stack besides what the world says (gates, target).
struct MissionConfig {
  std::vector<base::Vec3> waypoints;  // of the body origin, from where it stood at the start, world axes, m
};
void Describe(base::Description& d, MissionConfig& c);

/// One scenario: everything that a run depends on but its seed.
struct ScenarioConfig {
  std::string meaning;            // one sentence for `alula list`
  std::vector<std::string> tags;  // groups for `alula run --all --tag`
  std::uint64_t seed = 1;         // unless the command line names one
  WorldConfig world;
  VehicleConfig vehicle;
  AutopilotConfig autopilot;
  sim::AutopilotSensorsConfig autopilot_sensors;
  sim::SensorsConfig sensors;
  std::vector<sim::faults::Config> faults;
  sim::KnowledgeErrors knowledge;
  MissionConfig mission;
  StackConfig stack;
  sim::SimulationConfig simulation;
  sim::RecorderConfig recorder;
  std::vector<CriterionConfig> criteria{TimeLimitConfig{}};
};
void Describe(base::Description& d, ScenarioConfig& c);

/// A scenario as read, with the name of its run folder.
struct Scenario {
  std::string name;
  std::uint64_t seed = 1;
  ScenarioConfig config;
};

/// The folders in which names are looked up, those of scenarios first.
std::vector<std::filesystem::path> Catalogs();

/// What a scenario's, vehicle's or world's file is called: in a catalog its path from there ("slam/white_wall"), else
/// its plain name; without ".yaml".
std::string NameOf(const std::filesystem::path& file);

/// A name of the catalog or the path of a file. Throws base::InputError with the nearest known name.
std::filesystem::path FindScenario(std::string_view name_or_path);

/// The scenario of one seed (the document's own where none is given). Draws are kept in `draws` where it is not null.
Scenario ResolveScenario(const base::YamlDocument& document, std::string name, std::optional<std::uint64_t> seed,
                         base::Draws* draws = nullptr);

/// A scenario's file, read and put together with what it extends.
base::YamlDocument LoadScenarioDocument(const std::filesystem::path& file,
                                        const std::vector<base::Override>& overrides);

/// Reads a scenario, draws its distributions from the seed (the file's own where none is given).
Scenario LoadScenario(const std::filesystem::path& file, const std::vector<base::Override>& overrides,
                      std::optional<std::uint64_t> seed);

/// What can be named: scenarios (their parts, which begin with '_', apart), vehicles, worlds.
struct CatalogEntry {
  std::string kind;  // "scenario", "vehicle", "world"
  std::string name;
  std::filesystem::path file;
};
/// All of the catalogs, by kind, then by name.
std::vector<CatalogEntry> ListCatalogs();
std::vector<std::filesystem::path> ListScenarios();

/// What a file is (the catalog that it lies in says it; a file elsewhere is a scenario), and where it is. Throws
/// base::InputError.
CatalogEntry FindAny(std::string_view name_or_path);

/// Reads a vehicle's or a world's file as scenarios do when they extend it.
VehicleConfig LoadVehicle(const std::filesystem::path& file, const std::vector<base::Override>& overrides,
                          std::uint64_t seed);
WorldConfig LoadWorld(const std::filesystem::path& file, const std::vector<base::Override>& overrides,
                      std::uint64_t seed);

}  // namespace alula::scenarios

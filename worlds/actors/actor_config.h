#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "base/describe.h"
#include "worlds/world.h"

namespace alula::worlds {

// Actors as a user lists them: each waypoint is a place on the ground (in the air for a drone), m.

struct PersonConfig {
  std::vector<base::Vec3> waypoints;  // one: stands there
  bool closed = false;
  double speed = 1.2;              // m/s
  std::optional<double> height{};  // m; null: drawn
  bool reactive = true;
};
void Describe(base::Description& d, PersonConfig& c);

struct CarConfig {
  std::vector<base::Vec3> waypoints;  // one: parked
  bool closed = false;
  double heading = 0.0;      // rad, of a parked one
  double speed = 6.0;        // m/s
  double turn_radius = 6.0;  // m
  bool reactive = true;
};
void Describe(base::Description& d, CarConfig& c);

struct DroneConfig {
  std::vector<base::Vec3> waypoints;  // one: hovers there
  bool closed = true;
  double speed = 2.0;        // m/s
  double turn_radius = 1.5;  // m
  double span = 0.45;        // m, from rotor axis to rotor axis across
  bool reactive = true;
};
void Describe(base::Description& d, DroneConfig& c);

struct PeopleConfig {
  int count = 3;
  double speed = 1.2;  // m/s
  bool reactive = true;
  base::Vec3 low{-5.0, -5.0, 0.0};  // of the place that they walk in; z is not looked at
  base::Vec3 high{5.0, 5.0, 0.0};
};
void Describe(base::Description& d, PeopleConfig& c);

struct GrassPatchConfig {
  int tufts = 80;
  double height = 0.25;  // m
  base::Vec3 low{-2.0, -2.0, 0.0};
  base::Vec3 high{2.0, 2.0, 0.0};
};
void Describe(base::Description& d, GrassPatchConfig& c);

using ActorConfig = std::variant<PersonConfig, CarConfig, DroneConfig, PeopleConfig, GrassPatchConfig>;
/// The key `actors` of a world.
void DescribeActors(base::Description& d, std::vector<ActorConfig>& actors);

/// Adds them in their order, on flat ground or on `ground`, as "person<i>", "car<i>", "drone<i>", "people<i>_<k>",
/// "grass<i>" with their place in the list. Nobody of a crowd begins or walks within 2 m of the start.
/// Throws base::InputError as AddCrowd and AddCar do.
void AddActors(World& world, const std::vector<ActorConfig>& actors, const std::shared_ptr<const HeightField>& ground,
               std::uint64_t seed);

}  // namespace alula::worlds

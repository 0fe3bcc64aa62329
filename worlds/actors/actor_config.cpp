#include "worlds/actors/actor_config.h"

#include <numbers>
#include <string>

#include "base/error.h"
#include "worlds/actors/grass.h"
#include "worlds/actors/machines.h"
#include "worlds/actors/path.h"
#include "worlds/actors/person.h"

namespace alula::worlds {
namespace {

template <typename... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <typename... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

void DescribeWay(base::Description& d, std::vector<base::Vec3>& waypoints, bool& closed, double& speed, double most) {
  d.Field(
      "waypoints", waypoints,
      {.unit = "m", .meaning = "its way; one place alone: it stays there", .min = -1e4, .max = 1e4, .required = true});
  d.Field("closed", closed, {.meaning = "whether the way leads from its end to its begin"});
  d.Field("speed", speed, {.unit = "m/s", .meaning = "as wished", .min = 0.05, .max = most});
  d.Check("waypoints",
          [&waypoints] { return waypoints.empty() ? std::string("needs at least one place") : std::string(); });
}

void DescribeReaction(base::Description& d, bool& reactive) {
  d.Field("reactive", reactive, {.meaning = "whether the vehicle is heeded"});
}

void DescribePlace(base::Description& d, base::Vec3& low, base::Vec3& high) {
  d.Field("low", low, {.unit = "m", .meaning = "a corner of its place", .min = -1e4, .max = 1e4});
  d.Field("high", high, {.unit = "m", .meaning = "the opposite corner", .min = -1e4, .max = 1e4});
  d.Check("high", [&low, &high] {
    return high.x() > low.x() && high.y() > low.y() ? std::string() : std::string("must be above low in x and y");
  });
}

/// A path that cannot be is the waypoints' fault, said with the key.
void CheckPath(base::Description& d, const std::vector<base::Vec3>& waypoints, const bool& closed,
               const double& radius) {
  d.Check("turn_radius", [&]() -> std::string {
    if (waypoints.size() < 2) return {};
    try {
      const RoundedPath path(waypoints, closed, radius, "its way");
      return {};
    } catch (const base::InputError& error) {
      return std::string("does not fit: ") + error.what();
    }
  });
}

}  // namespace

void Describe(base::Description& d, PersonConfig& c) {
  DescribeWay(d, c.waypoints, c.closed, c.speed, 3.0);
  d.Field("height", c.height, {.unit = "m", .meaning = "null: drawn", .min = 1.0, .max = 2.2});
  DescribeReaction(d, c.reactive);
}

void Describe(base::Description& d, CarConfig& c) {
  constexpr double kPi = std::numbers::pi;
  DescribeWay(d, c.waypoints, c.closed, c.speed, 40.0);
  d.Field("heading", c.heading,
          {.unit = "rad", .meaning = "of one that is parked", .min = -2.0 * kPi, .max = 2.0 * kPi});
  d.Field("turn_radius", c.turn_radius, {.unit = "m", .meaning = "of its bends", .min = 4.0, .max = 1e3});
  DescribeReaction(d, c.reactive);
  CheckPath(d, c.waypoints, c.closed, c.turn_radius);
}

void Describe(base::Description& d, DroneConfig& c) {
  DescribeWay(d, c.waypoints, c.closed, c.speed, 30.0);
  d.Field("turn_radius", c.turn_radius, {.unit = "m", .meaning = "of its bends", .min = 0.1, .max = 1e3});
  d.Field("span", c.span, {.unit = "m", .meaning = "from rotor axis to rotor axis across", .min = 0.05, .max = 5.0});
  DescribeReaction(d, c.reactive);
  CheckPath(d, c.waypoints, c.closed, c.turn_radius);
}

void Describe(base::Description& d, PeopleConfig& c) {
  d.Field("count", c.count, {.meaning = "people on ways that the seed draws", .min = 0, .max = 200});
  d.Field("speed", c.speed, {.unit = "m/s", .meaning = "mean of what they wish", .min = 0.05, .max = 3.0});
  DescribeReaction(d, c.reactive);
  DescribePlace(d, c.low, c.high);
}

void Describe(base::Description& d, GrassPatchConfig& c) {
  d.Field("tufts", c.tufts, {.meaning = "of grass", .min = 1, .max = 2000});
  d.Field("height", c.height, {.unit = "m", .meaning = "of a tuft, mean", .min = 0.02, .max = 2.0});
  DescribePlace(d, c.low, c.high);
}

void DescribeActors(base::Description& d, std::vector<ActorConfig>& actors) {
  d.ListOf("actors", actors,
           {.meaning = "what moves besides the vehicle", .choices = {"person", "car", "drone", "people", "grass"}});
}

void AddActors(World& world, const std::vector<ActorConfig>& actors, const std::shared_ptr<const HeightField>& ground,
               std::uint64_t seed) {
  constexpr double kClearOfStart = 2.0;  // m
  for (std::size_t i = 0; i < actors.size(); ++i) {
    const std::string number = std::to_string(i);
    std::visit(Overloaded{
                   [&](const PersonConfig& c) {
                     const std::string name = "person" + number;
                     const double height = c.height.value_or(PersonHeight(seed, name));
                     AddPerson(world, name,
                               {.route = c.waypoints,
                                .closed = c.closed,
                                .speed = c.speed,
                                .height = height,
                                .reactive = c.reactive,
                                .ground = ground},
                               seed);
                   },
                   [&](const CarConfig& c) {
                     AddCar(world, "car" + number,
                            {.waypoints = c.waypoints,
                             .closed = c.closed,
                             .heading = c.heading,
                             .speed = c.speed,
                             .turn_radius = c.turn_radius,
                             .reactive = c.reactive,
                             .ground = ground},
                            seed);
                   },
                   [&](const DroneConfig& c) {
                     AddDrone(world, "drone" + number,
                              {.waypoints = c.waypoints,
                               .closed = c.closed,
                               .speed = c.speed,
                               .turn_radius = c.turn_radius,
                               .reactive = c.reactive},
                              c.span, seed);
                   },
                   [&](const PeopleConfig& c) {
                     AddCrowd(world, "people" + number + "_",
                              {.count = c.count,
                               .speed = c.speed,
                               .reactive = c.reactive,
                               .low = c.low.head<2>(),
                               .high = c.high.head<2>(),
                               .free = {{world.X_WB_start.p.head<2>(), kClearOfStart}},
                               .ground = ground},
                              seed);
                   },
                   [&](const GrassPatchConfig& c) {
                     AddGrass(world, "grass" + number,
                              {.low = c.low.head<2>(),
                               .high = c.high.head<2>(),
                               .tufts = c.tufts,
                               .height = c.height,
                               .ground = ground},
                              seed);
                   },
               },
               actors[i]);
  }
}

}  // namespace alula::worlds

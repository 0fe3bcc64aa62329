#include "worlds/courtyard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "worlds/actors/machines.h"
#include "worlds/actors/person.h"
#include "worlds/assets.h"
#include "worlds/course.h"
#include "worlds/furniture.h"
#include "worlds/placement.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kPi = std::numbers::pi;
constexpr double kLength = kCourtyardHalfLength;
constexpr double kWidth = kCourtyardHalfWidth;

/// Slabs of different stone, each larger than what one sees of it sharply, so that no period shows.
void AddGround(World& world, const Looks& looks, RandomStream& random) {
  constexpr int kColumns = 5;
  constexpr int kRows = 3;
  constexpr double kDepth = 0.25;  // half the thickness, m
  const double half_x = kLength / kColumns;
  const double half_y = kWidth / kRows;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Vec3 centre(-kLength + (2 * column + 1) * half_x, -kWidth + (2 * row + 1) * half_y, -kDepth);
      const double yaw = random.Index(2) == 0 ? 0.0 : kPi;
      AddObject(world, "ground/" + std::to_string(row * kColumns + column), geometry::Box{{half_x, half_y, kDepth}},
                {base::FromYaw(yaw), centre}, looks.ground[random.Index(looks.ground.size())], random.Uniform(5.5, 8.0),
                SemanticClass::kGround);
    }
  }
}

/// One wall of panels with different looks; x runs along it, its inner face is y = 0, it lies on the side of y > 0.
void AddWall(World& world, const Looks& looks, const CourtyardConfig& config, const std::string& name,
             const Transform& X_WL, double half_length, RandomStream& random) {
  constexpr double kThickness = 0.15;  // half, m
  const int panels = static_cast<int>(std::lround(2.0 * half_length / 5.5));
  double x = -half_length;
  std::size_t before = looks.wall.size();
  for (int i = 0; i < panels; ++i) {
    const double rest = half_length - x;
    const double length = i + 1 == panels ? rest : rest / (panels - i) * random.Uniform(0.8, 1.2);
    const double height = random.Uniform(config.wall_height_min, config.wall_height_max);
    std::size_t look = random.Index(looks.wall.size());
    if (look == before) look = (look + 1) % looks.wall.size();
    const double yaw = random.Index(2) == 0 ? 0.0 : kPi;  // shows the other side
    const Transform X_LP{base::FromYaw(yaw), {x + 0.5 * length, kThickness, 0.5 * height}};
    AddObject(world, name + "/" + std::to_string(i), geometry::Box{{0.5 * length, kThickness, 0.5 * height}},
              X_WL * X_LP, looks.wall[look], random.Uniform(5.0, 7.5), SemanticClass::kWall);
    x += length;
    before = look;
  }
}

void AddWalls(World& world, const Looks& looks, const CourtyardConfig& config, RandomStream& random) {
  const auto wall = [&](const char* name, double yaw, const Vec2& p, double half_length) {
    AddWall(world, looks, config, std::string("wall/") + name, {base::FromYaw(yaw), {p.x(), p.y(), 0.0}}, half_length,
            random);
  };
  wall("north", 0.0, {0.0, kWidth}, kLength + 0.3);
  wall("south", kPi, {0.0, -kWidth}, kLength + 0.3);
  wall("east", -0.5 * kPi, {kLength, 0.0}, kWidth);
  wall("west", 0.5 * kPi, {-kLength, 0.0}, kWidth);
}

/// The mesh prop in the middle of the loop, where there is always room.
void AddProp(World& world, const Looks& looks, const CourtyardConfig& config, Placement& placement,
             RandomStream& random) {
  if (config.prop.empty()) return;
  auto mesh = std::make_shared<const geometry::Mesh>(geometry::LoadMesh(AssetPath(config.prop), 5'000));
  Footprint at;
  double lowest = mesh->vertices.front().position.z();
  for (const auto& v : mesh->vertices) {
    at.radius = std::max(at.radius, std::hypot<double>(v.position.x(), v.position.y()));
    lowest = std::min<double>(lowest, v.position.z());
  }
  Footprint drawn = at;
  for (int i = 0; i < 30; ++i) {
    drawn.centre = {random.Uniform(-3.5, 3.5), random.Uniform(-1.5, 1.5)};
    if (placement.IsFree(drawn)) break;
  }
  if (placement.IsFree(drawn)) at = drawn;  // else the origin
  if (!placement.IsFree(at))
    throw base::InputError("prop '" + config.prop + "' is too large for the courtyard's middle");
  placement.Take(at);
  AddObject(world, "prop", geometry::MeshShape{mesh},
            {base::FromYaw(random.Uniform(0.0, 2.0 * kPi)), {at.centre.x(), at.centre.y(), -lowest}}, looks.stone, 1.0);
}

/// Obstacles close to the straight lines between gates, tall enough to be in the way.
void AddBlockers(World& world, const Looks& looks, const CourtyardConfig& config, const CoursePlan& course,
                 Placement& placement, RandomStream& random) {
  for (std::size_t leg = 0; leg + 1 < course.gates.size(); ++leg) {
    const Vec2 a = course.gates[leg].p;
    const Vec2 b = course.gates[leg + 1].p;
    const Vec2 across = Vec2(a.y() - b.y(), b.x() - a.x()).normalized();
    const bool wanted = random.Uniform() < config.blocker_probability;
    const std::uint64_t kind = random.Index(3);
    const double radius = kind == 2 ? random.Uniform(0.14, 0.2) : random.Uniform(0.42, 0.58);
    for (int i = 0; wanted && i < 40; ++i) {
      const double share = random.Uniform(0.35, 0.65);
      const Footprint at{a + share * (b - a) + random.Uniform(-0.7, 0.7) * across, radius};
      if (!placement.IsFree(at)) continue;
      placement.Take(at);
      const std::string name = "blocker" + std::to_string(leg);
      if (kind == 0) AddCrates(world, looks, name, at, 3, random);
      if (kind == 1) AddConifer(world, looks, name, at, random);
      if (kind == 2) AddPole(world, looks, name, at, random);
      break;
    }
  }
}

/// Draws up to `count` free places; what finds none within 30 tries is left out.
template <typename AddOne>
void Scatter(int count, double radius_min, double radius_max, Placement& placement, RandomStream& random,
             const AddOne& add) {
  for (int k = 0; k < count; ++k) {
    const double radius = random.Uniform(radius_min, radius_max);
    for (int i = 0; i < 30; ++i) {
      const Footprint at{{random.Uniform(-kLength, kLength), random.Uniform(-kWidth, kWidth)}, radius};
      if (!placement.IsFree(at, true)) continue;
      placement.Take(at);
      add(k, at);
      break;
    }
  }
}

void AddBenches(World& world, const Looks& looks, const CourtyardConfig& config, Placement& placement,
                RandomStream& random) {
  constexpr double kRadius = 0.85;  // m
  for (int k = 0; k < config.benches; ++k) {
    const double yaw = 0.5 * kPi * static_cast<double>(random.Index(4));  // away from the wall behind it
    const Vec2 out(std::cos(yaw), std::sin(yaw));
    const Vec2 along(-out.y(), out.x());
    const bool long_wall = std::abs(out.y()) > 0.5;
    for (int i = 0; i < 30; ++i) {
      const double slide = random.Uniform(-1.0, 1.0) * ((long_wall ? kLength : kWidth) - kRadius);
      const Footprint at{slide * along - ((long_wall ? kWidth : kLength) - kRadius - 1e-6) * out, kRadius};
      if (!placement.IsFree(at, true)) continue;
      placement.Take(at);
      AddBench(world, looks, "bench" + std::to_string(k), at, yaw);
      break;
    }
  }
}

void AddFurniture(World& world, const Looks& looks, const CourtyardConfig& config, const CoursePlan& course,
                  std::uint64_t seed) {
  Placement placement(course);
  RandomStream random(seed, "world/obstacles");
  AddProp(world, looks, config, placement, random);
  AddBlockers(world, looks, config, course, placement, random);
  Scatter(config.trees, 0.6, 0.95, placement, random, [&](int k, const Footprint& at) {
    const std::string name = "tree" + std::to_string(k);
    random.Index(3) == 0 ? AddConifer(world, looks, name, at, random) : AddTree(world, looks, name, at, random);
  });
  Scatter(config.crates, 0.35, 0.65, placement, random, [&](int k, const Footprint& at) {
    AddCrates(world, looks, "crate" + std::to_string(k), at, 1 + static_cast<int>(random.Index(3)), random);
  });
  Scatter(config.poles, 0.13, 0.2, placement, random,
          [&](int k, const Footprint& at) { AddPole(world, looks, "pole" + std::to_string(k), at, random); });
  AddBenches(world, looks, config, placement, random);
}

Wind DrawWind(const CourtyardConfig& config, std::uint64_t seed) {
  if (config.wind) return DrawWind(*config.wind, seed);
  RandomStream random(seed, "world/wind");
  const double speed = random.Uniform(config.wind_speed_min, config.wind_speed_max);
  const double direction = random.Uniform(-kPi, kPi);
  return {{speed * std::cos(direction), speed * std::sin(direction), 0.0},
          speed * random.Uniform(config.gust_share_min, config.gust_share_max),
          config.gust_time};
}

Light DrawLight(const CourtyardConfig& config, std::uint64_t seed) {
  RandomStream random(seed, "world/light");
  const double elevation = random.Uniform(config.sun_elevation_min, config.sun_elevation_max);
  const double azimuth = random.Uniform(-kPi, kPi);
  Light light;
  light.to_sun_W = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                    std::sin(elevation)};
  light.sun = static_cast<float>(config.sunlight * random.Uniform(0.5, 0.75));
  light.ambient = static_cast<float>(config.skylight * random.Uniform(0.32, 0.42));
  light.sky_brightness = static_cast<float>(std::sqrt(config.skylight));  // displayed values are roots of light
  light.fog = config.fog;
  light.lamps = config.lamps;
  return light;
}

Transform DrawStart(const CourtyardConfig& config, const CoursePlan& course, std::uint64_t seed) {
  RandomStream random(seed, "world/start");
  const Vec2 p = course.pad + Vec2(random.Uniform(-0.15, 0.15), random.Uniform(-0.15, 0.15));
  const Vec2 to_gate = course.gates.front().p - p;
  const double yaw =
      std::atan2(to_gate.y(), to_gate.x()) + random.Uniform(-config.start_yaw_spread, config.start_yaw_spread);
  return {base::FromYaw(base::WrapAngle(yaw)), {p.x(), p.y(), kPadHeight}};
}

/// Which gates swing, as many as are wanted.
std::array<bool, 5> DrawSwinging(const CourtyardConfig& config, RandomStream& random) {
  std::array<bool, 5> swings{};
  for (int wanted = config.swinging_gates; wanted > 0; --wanted) {
    auto skip = random.Index(static_cast<std::uint64_t>(std::count(swings.begin(), swings.end(), false)));
    for (bool& swing : swings) {
      if (swing || skip-- > 0) continue;
      swing = true;
      break;
    }
  }
  return swings;
}

void AddGates(World& world, const Looks& looks, const CourtyardConfig& config, const CoursePlan& course,
              std::uint64_t seed) {
  RandomStream random(seed, "world/actors/gates");
  const std::array<bool, 5> swings = DrawSwinging(config, random);
  for (std::size_t i = 0; i < course.gates.size(); ++i) {
    const std::string name = "gate" + std::to_string(i);
    if (swings[i]) {
      AddSwingingGate(world, looks.gate[i], name, course.gates[i],
                      {config.gate_swing, config.gate_period, random.Uniform()});
    } else {
      AddGate(world, looks.gate[i], name, course.gates[i]);
    }
  }
}

void AddPeople(World& world, const CourtyardConfig& config, const CoursePlan& course, std::uint64_t seed) {
  CrowdConfig crowd{.count = config.people,
                    .speed = config.people_speed,
                    .reactive = config.reactive,
                    .low = {-kLength, -kWidth},
                    .high = {kLength, kWidth},
                    .free = {{course.pad, config.pad_radius + 0.8}, {course.target, 1.5}}};
  for (const GatePlan& gate : course.gates) crowd.free.push_back({gate.p, 0.5 * gate.opening + gate.frame + 0.3});
  AddCrowd(world, "person", crowd, seed);
}

}  // namespace

World MakeWorld(const CourtyardConfig& config, std::uint64_t seed) {
  const CoursePlan course = DrawCourse(config, seed);
  World world;
  world.name = "courtyard";
  const Looks looks = AddCourtyardMaterials(world, config.texture_size, seed);
  RandomStream masonry(seed, "world/walls");
  AddGround(world, looks, masonry);
  AddWalls(world, looks, config, masonry);
  AddPad(world, looks.pad, course.pad, config.pad_radius);
  AddGates(world, looks, config, course, seed);
  AddFurniture(world, looks, config, course, seed);
  world.wind = DrawWind(config, seed);
  world.light = DrawLight(config, seed);
  world.X_WB_start = DrawStart(config, course, seed);
  world.target = {course.target.x(), course.target.y(), course.target_height};
  world.bounds_low = {-kLength + 0.3, -kWidth + 0.3, 0.0};
  world.bounds_high = {kLength - 0.3, kWidth - 0.3, 3.5};
  AddPeople(world, config, course, seed);
  return world;
}

}  // namespace alula::worlds

#include "worlds/maps/planning_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "worlds/furniture.h"
#include "worlds/kit/surface.h"
#include "worlds/textures.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kPi = std::numbers::pi;
constexpr double kWall = 0.4;       // m, thickness of the outer walls
constexpr double kStartRoom = 3.0;  // m about start and target that stay free

const Vec2 kStart(-kMapCorner, -kMapCorner);
const Vec2 kTarget(kMapCorner, kMapCorner);

struct MapLooks {
  Surface ground, wall;
  std::array<Surface, 3> masonry;
  int pad = 0;
};

MapLooks AddLooks(World& world, int size, std::uint64_t seed) {
  MapLooks looks;
  looks.ground = AddSurface(world, "asphalt",
                            {.pattern = Pattern::kAsphalt,
                             .palette = {{0.22F, 0.22F, 0.23F}, {0.62F, 0.61F, 0.59F}},
                             .period = 6.25,
                             .size = size,
                             .variants = 4,
                             .contrast = 0.16},
                            seed);
  looks.wall = AddSurface(world, "concrete",
                          {.pattern = Pattern::kConcrete,
                           .palette = {{0.34F, 0.33F, 0.32F}, {0.80F, 0.79F, 0.76F}},
                           .period = 6.0,
                           .size = size,
                           .contrast = 0.18},
                          seed);
  looks.masonry = {AddSurface(world, "brick",
                              {.pattern = Pattern::kBrick,
                               .palette = {{0.30F, 0.14F, 0.11F}, {0.74F, 0.52F, 0.44F}},
                               .size = size,
                               .contrast = 0.2},
                              seed),
                   AddSurface(world, "plaster",
                              {.pattern = Pattern::kPlaster,
                               .palette = {{0.46F, 0.42F, 0.35F}, {0.88F, 0.85F, 0.76F}},
                               .size = size,
                               .contrast = 0.15},
                              seed),
                   AddSurface(world, "rubble",
                              {.pattern = Pattern::kRubble,
                               .palette = {{0.25F, 0.23F, 0.20F}, {0.76F, 0.73F, 0.67F}},
                               .size = size,
                               .contrast = 0.2},
                              seed)};
  looks.pad = AddMaterial(
      world, "pad", {.pattern = Pattern::kPad, .palette = {{0.06F, 0.08F, 0.10F}, {0.95F, 0.93F, 0.85F}}, .size = size},
      seed);
  return looks;
}

Transform Standing(const Vec2& p, double height, double yaw) {
  return {base::FromYaw(yaw), {p.x(), p.y(), 0.5 * height}};
}

void AddGroundAndWalls(World& world, const MapLooks& looks, double height, RandomStream& masonry) {
  constexpr double kSlab = 0.5;  // m thick
  AddTiledBox(world, "ground", {2.0 * kMapHalf, 2.0 * kMapHalf, kSlab},
              {base::Quat::Identity(), {0.0, 0.0, -0.5 * kSlab}}, looks.ground, SemanticClass::kGround, masonry);
  const double side = kMapHalf + 0.5 * kWall;
  constexpr std::array<const char*, 4> kNames{"wall/east", "wall/north", "wall/west", "wall/south"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const double yaw = 0.5 * kPi * static_cast<double>(i);
    const Transform X_WO = Standing(side * Vec2(std::cos(yaw), std::sin(yaw)), height, yaw);
    AddTiledBox(world, kNames[i], {kWall, 2.0 * side + kWall, height}, X_WO, looks.wall, SemanticClass::kWall, masonry);
  }
}

/// Round and rectangular things with `gap` between their circles.
void AddObstacles(World& world, const MapLooks& looks, const PlanningMapConfig& config, std::uint64_t seed,
                  RandomStream& masonry) {
  struct Disc {
    Vec2 p;
    double radius;
  };
  std::vector<Disc> taken;
  RandomStream random(seed, "world/map");
  const auto is_free = [&](const Disc& d) {
    const double ends = d.radius + kStartRoom;
    if ((d.p - kStart).norm() < ends || (d.p - kTarget).norm() < ends) return false;
    return std::all_of(taken.begin(), taken.end(), [&](const Disc& other) {
      return (d.p - other.p).norm() >= d.radius + other.radius + config.gap;
    });
  };
  for (int k = 0; k < config.obstacles; ++k) {
    const double radius = random.Uniform(config.radius_min, config.radius_max);
    const double reach = kMapHalf - radius - config.gap;
    for (int i = 0; i < 40; ++i) {
      const Disc disc{{random.Uniform(-reach, reach), random.Uniform(-reach, reach)}, radius};
      if (!is_free(disc)) continue;
      taken.push_back(disc);
      const std::string name = "obstacle" + std::to_string(k);
      const double yaw = random.Uniform(-kPi, kPi);
      const Surface& look = looks.masonry[random.Index(looks.masonry.size())];
      if (random.Index(3) == 0) {
        AddObject(world, name, geometry::Cylinder{radius, 0.5 * config.height}, Standing(disc.p, config.height, yaw),
                  look.variants[random.Index(look.variants.size())], look.period);
      } else {
        const double corner = random.Uniform(0.45, 1.12);  // rad: from long to square
        AddTiledBox(world, name, {2.0 * radius * std::cos(corner), 2.0 * radius * std::sin(corner), config.height},
                    Standing(disc.p, config.height, yaw), look, SemanticClass::kObstacle, masonry);
      }
      break;
    }
  }
}

/// Barriers across the diagonal, each from wall to wall, with passages of the corridor's width at drawn places. In the
/// axes of the diagonal: s along it from the start, t to its left. The outer walls cut off what lies beyond them.
void AddBarriers(World& world, const MapLooks& looks, const PlanningMapConfig& config, std::uint64_t seed,
                 RandomStream& masonry) {
  constexpr double kReach = 42.0;  // m: passages open within ±this of the diagonal, where the map is wide enough
  RandomStream random(seed, "world/map");
  const double length = (kTarget - kStart).norm();
  const double pitch = length / (config.barriers + 1);
  const double diagonal = 0.25 * kPi;
  for (int barrier = 0; barrier < config.barriers; ++barrier) {
    const double thickness = random.Uniform(config.corridor_min, config.corridor_max);
    const double room = 0.5 * (pitch - thickness) - 1.5;  // so that a way between two barriers stays open
    const double s = pitch * (barrier + 1) + random.Uniform(-1.0, 1.0) * std::max(room, 0.0) * 0.5 - 0.5 * length;
    // Where the wall of the map meets the barrier's middle line.
    const double half = std::numbers::sqrt2 * kMapHalf - std::abs(s);
    const double reach = std::min(kReach, half - 0.5 * thickness - 2.0 * config.corridor_width);
    std::vector<double> passages;
    for (int i = 0; i < config.passages; ++i) {
      const double low = -reach + 2.0 * reach * i / config.passages;
      const double high = low + 2.0 * reach / config.passages;
      passages.push_back(random.Uniform(low + config.corridor_width, high - config.corridor_width));
    }
    const Surface& look = looks.masonry[random.Index(looks.masonry.size())];
    // The ends reach into the outer walls, which hide them.
    double begin = -half - 0.5 * thickness;
    for (std::size_t i = 0; i <= passages.size(); ++i) {
      const double end = i < passages.size() ? passages[i] - 0.5 * config.corridor_width : half + 0.5 * thickness;
      const double t = 0.5 * (begin + end);
      const Vec2 p(s * std::cos(diagonal) - t * std::sin(diagonal), s * std::sin(diagonal) + t * std::cos(diagonal));
      AddTiledBox(world, "barrier" + std::to_string(barrier) + "/" + std::to_string(i),
                  {thickness, end - begin, config.height}, Standing(p, config.height, diagonal), look,
                  SemanticClass::kWall, masonry);
      if (i < passages.size()) begin = passages[i] + 0.5 * config.corridor_width;
    }
  }
}

}  // namespace

void Describe(base::Description& d, PlanningMapConfig& c) {
  d.Field("layout", c.layout, {.meaning = "what stands there", .choices = {"open", "corridors", "cluttered"}});
  d.Field("obstacles", c.obstacles, {.meaning = "open, cluttered: obstacles, at most", .min = 0, .max = 1000});
  d.Field("radius_min", c.radius_min,
          {.unit = "m", .meaning = "least radius of the circle that an obstacle fits in", .min = 0.2, .max = 10.0});
  d.Field("radius_max", c.radius_max, {.unit = "m", .meaning = "largest one", .min = 0.2, .max = 10.0});
  d.Field("gap", c.gap, {.unit = "m", .meaning = "least between two obstacles", .min = 1.2, .max = 20.0});
  d.Field("barriers", c.barriers, {.meaning = "corridors: walls across the way", .min = 1, .max = 8});
  d.Field("passages", c.passages, {.meaning = "corridors through each of them", .min = 1, .max = 4});
  d.Field("corridor_width", c.corridor_width,
          {.unit = "m", .meaning = "clear width of a corridor", .min = 1.2, .max = 6.0});
  d.Field("corridor_min", c.corridor_min,
          {.unit = "m", .meaning = "least length of a corridor", .min = 0.3, .max = 8.0});
  d.Field("corridor_max", c.corridor_max, {.unit = "m", .meaning = "largest one", .min = 0.3, .max = 8.0});
  d.Field("height", c.height, {.unit = "m", .meaning = "of walls and obstacles", .min = 3.0, .max = 20.0});
  DescribeTextureSize(d, c.texture_size);
  d.Field("weather", c.weather, {.meaning = "light and wind"});
  d.Check("radius_max",
          [&c] { return c.radius_max >= c.radius_min ? std::string() : std::string("must not be below radius_min"); });
  d.Check("corridor_max", [&c] {
    return c.corridor_max >= c.corridor_min ? std::string() : std::string("must not be below corridor_min");
  });
}

World MakeWorld(const PlanningMapConfig& config, std::uint64_t seed) {
  World world;
  world.name = "planning_map";
  const MapLooks looks = AddLooks(world, config.texture_size, seed);
  RandomStream masonry(seed, "world/masonry");
  AddGroundAndWalls(world, looks, config.height, masonry);
  AddPad(world, looks.pad, kStart, 1.2);
  if (config.layout == PlanningMapConfig::Layout::kCorridors) {
    AddBarriers(world, looks, config, seed, masonry);
  } else {
    AddObstacles(world, looks, config, seed, masonry);
  }
  world.light = DrawLight(config.weather, seed);
  world.wind = DrawWind(config.weather.wind, seed);
  world.X_WB_start = {base::FromYaw(0.25 * kPi), {kStart.x(), kStart.y(), kPadHeight}};
  world.target = {kTarget.x(), kTarget.y(), 1.5};
  world.bounds_low = {-kMapHalf, -kMapHalf, 0.0};
  world.bounds_high = {kMapHalf, kMapHalf, config.height - 1.0};
  return world;
}

}  // namespace alula::worlds

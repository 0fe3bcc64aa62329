#include "worlds/outdoor/landing_woods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "worlds/furniture.h"
#include "worlds/kit/mesh_parts.h"
#include "worlds/kit/street.h"
#include "worlds/outdoor/site.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Vec2;
using base::Vec3;

constexpr double kPi = std::numbers::pi;
constexpr double kHalf = 24.0;      // m, of the field
constexpr double kTargetUp = 18.0;  // m above the middle
constexpr double kTop = 30.0;       // m of bounds above the highest ground

void AddStart(World& world, Land& land, const Vec2& p, std::uint64_t seed) {
  AddPadOn(world, land, AddPadMaterial(world, seed), p, 1.0, 0.5 * kPi);
}

void PlantWood(World& world, const Land& land, Plot& plot, const Wood& wood, int count, double spacing,
               std::uint64_t seed, const std::function<bool(const Vec2&)>& allowed = {}) {
  RandomStream random(seed, "world/trees");
  for (int i = 0; i < count; ++i) {
    const auto p = plot.Place(0.5 * spacing, random, allowed);
    if (p) PlantFrom(world, wood, land, "tree" + std::to_string(i), *p, random);
  }
}

void EndWorld(World& world, const Land& land, const WeatherConfig& weather, std::uint64_t seed) {
  world.target = land.On(Vec2::Zero()) + Vec3(0, 0, kTargetUp);
  FinishWorld(world, land, weather, kTop, seed);
}

/// Ridges of a ploughed strip, west to east, one object each four; they follow the ground.
void AddFurrows(World& world, const Land& land, int soil, const Vec2& low, const Vec2& high, double height) {
  constexpr double kPitch = 0.75;  // m between ridges
  constexpr double kStep = 2.0;    // m along them
  const int ridges = static_cast<int>((high.y() - low.y()) / kPitch);
  std::shared_ptr<geometry::Mesh> mesh;
  for (int ridge = 0; ridge < ridges; ++ridge) {
    if (mesh == nullptr) mesh = std::make_shared<geometry::Mesh>();
    const double y = low.y() + (ridge + 0.5) * kPitch;
    for (double x = low.x(); x < high.x() - 1e-6; x += kStep) {
      const double next = std::min(x + kStep, high.x());
      const auto at = [&](double px, double off, double up) { return Vec3(land.On({px, y + off}) + Vec3(0, 0, up)); };
      const double half = 0.5 * kPitch;
      const Vec3 a = at(x, 0.0, height);
      const Vec3 b = at(next, 0.0, height);
      AddQuad(*mesh, {at(x, -half, -0.02), at(next, -half, -0.02), b, a}, 1.5);
      AddQuad(*mesh, {at(next, half, -0.02), at(x, half, -0.02), a, b}, 1.5);
    }
    if (ridge % 4 == 3 || ridge + 1 == ridges) {
      AddObject(world, "furrow" + std::to_string(ridge / 4), geometry::MeshShape{std::exchange(mesh, nullptr)}, {},
                soil, 1.0, SemanticClass::kGround);
    }
  }
}

}  // namespace

void Describe(base::Description& d, LandingForestConfig& c) {
  d.Field("trees", c.trees, {.meaning = "trees, at most", .min = 0, .max = 200});
  d.Field("tree_height_min", c.tree_height_min,
          {.unit = "m", .meaning = "least height of a tree", .min = 3.0, .max = 20.0});
  d.Field("tree_height_max", c.tree_height_max,
          {.unit = "m", .meaning = "largest height of a tree", .min = 3.0, .max = 20.0});
  d.Check("tree_height_max", [&c] {
    return c.tree_height_max >= c.tree_height_min ? std::string() : std::string("must not be below tree_height_min");
  });
  d.Field("clearing_min", c.clearing_min,
          {.unit = "m", .meaning = "least radius of the clearing", .min = 2.0, .max = 12.0});
  d.Field("clearing_max", c.clearing_max,
          {.unit = "m", .meaning = "largest radius of the clearing", .min = 2.0, .max = 12.0});
  d.Check("clearing_max", [&c] {
    return c.clearing_max >= c.clearing_min ? std::string() : std::string("must not be below clearing_min");
  });
  d.Field("unevenness", c.unevenness,
          {.unit = "m", .meaning = "standard deviation of the ground's bumps under the trees", .min = 0.0, .max = 0.5});
  d.Field("weather", c.weather, {.meaning = "hour, sun, clouds, fog and wind"});
}

World MakeWorld(const LandingForestConfig& config, std::uint64_t seed) {
  World world;
  world.name = "landing_forest";
  RandomStream random(seed, "world/land");
  Land land = MakeLand({.half = Vec2::Constant(kHalf),
                        .cell = 0.5,
                        .swell = {.height = 0.5, .wavelength = 50.0, .octaves = 2},
                        .relief = {.height = config.unevenness, .wavelength = 3.0, .octaves = 2}},
                       {}, random);
  const double radius = random.Uniform(config.clearing_min, config.clearing_max);
  const Vec2 clearing(random.Uniform(-5.0, 5.0), random.Uniform(-4.0, 6.0));
  Level(land.field, clearing, radius, 1.5, HeightAt(land.around, clearing));
  const Vec2 start(random.Uniform(-4.0, 4.0), -kHalf + 2.5);
  AddStart(world, land, start, seed);
  const Surface litter = AddLitterGround(world, seed);
  AddLand(world, land, litter, litter, random);

  Plot plot(Vec2::Constant(kHalf - 0.8));
  plot.Take(start, 2.0);
  plot.Take(clearing, radius + 0.6);
  const Wood wood = MakeWood(world, config.tree_height_min, config.tree_height_max, 3, 1, seed);
  PlantWood(world, land, plot, wood, config.trees, 2.6, seed);
  AddRubble(world, land, plot, {.boulders = 6, .logs = 8, .stumps = 8}, wood.looks.front().bark, seed);
  AddShrubs(world, land, plot, 40, 0.35, 0.75, seed);
  AddTufts(world, land, 260, 0.25, seed,
           [&](const Vec2& p) { return (p - start).norm() > 1.6 && (p - clearing).norm() > radius - 0.3; });
  AddTreeLine(world, land,
              {.nearest = 2.5,
               .woods = 0.8,
               .spacing = 8.0,
               .height_min = config.tree_height_min + 1.0,
               .height_max = config.tree_height_max + 2.0},
              seed);
  EndWorld(world, land, config.weather, seed);
  return world;
}

void Describe(base::Description& d, LandingSlopeConfig& c) {
  d.Field("slope", c.slope, {.unit = "rad", .meaning = "of the hillside", .min = 0.17, .max = 0.5});
  d.Field("boulders", c.boulders, {.meaning = "boulders, at most", .min = 0, .max = 100});
  d.Field("trees", c.trees, {.meaning = "trees around, at most", .min = 0, .max = 80});
  d.Field("sculpture_height", c.sculpture_height,
          {.unit = "m", .meaning = "of the standing figure, with its plinth", .min = 1.5, .max = 6.0});
  d.Field("weather", c.weather, {.meaning = "hour, sun, clouds, fog and wind"});
}

World MakeWorld(const LandingSlopeConfig& config, std::uint64_t seed) {
  World world;
  world.name = "landing_slope";
  RandomStream random(seed, "world/land");
  const double foot = random.Uniform(-8.0, -4.0);  // y where the hillside begins; it ends in a shoulder
  const double tangent = std::tan(config.slope);
  const auto hillside = [&](const Vec2& p) {
    constexpr double kBend = 3.0;  // m over which the ground turns into the slope
    const double y = std::clamp(p.y() - foot, 0.0, 42.0);
    const double ramp = y < kBend ? 0.5 * y * y / kBend : y - 0.5 * kBend;
    const double over = std::max(0.0, y - 34.0);
    return tangent * (ramp - 0.5 * over * over / 8.0);
  };
  Land land = MakeLand({.half = Vec2::Constant(kHalf),
                        .cell = 0.5,
                        .swell = {.height = 0.25, .wavelength = 50.0, .octaves = 2},
                        .relief = {.height = 0.03, .wavelength = 6.0, .octaves = 2}},
                       hillside, random);
  const Vec2 start(random.Uniform(-4.0, 4.0), -kHalf + 2.5);
  const Vec2 figure(random.Uniform(-3.0, 3.0), foot + random.Uniform(10.0, 14.0));
  Level(land.field, figure, 0.9, 1.2, HeightAt(land.field, figure));
  AddStart(world, land, start, seed);
  const Surface grass = AddGrassGround(world, seed);
  AddLand(world, land, grass, AddMeadow(world, seed), random);

  Plot plot(Vec2::Constant(kHalf - 0.8));
  plot.Take(start, 2.5);
  plot.Take(figure, 2.5);
  const int stone = AddMaterial(world, "sculpture",
                                {.pattern = Pattern::kPlaster,
                                 .palette = {{0.42F, 0.41F, 0.38F}, {0.82F, 0.80F, 0.75F}},
                                 .size = 256,
                                 .contrast = 0.14},
                                seed);
  AddSculpture(world, stone, "sculpture", {base::FromYaw(-0.5 * kPi), land.On(figure)}, config.sculpture_height);
  const Wood wood = MakeWood(world, 5.0, 8.5, 2, 1, seed);
  PlantWood(world, land, plot, wood, config.trees, 4.0, seed,
            [&](const Vec2& p) { return std::abs(p.x()) > 13.0 || p.y() > 17.0; });
  AddRubble(world, land, plot, {.boulders = config.boulders, .size_min = 0.3, .size_max = 0.9}, wood.looks.front().bark,
            seed, [&](const Vec2& p) { return p.y() > foot - 2.0; });
  AddShrubs(world, land, plot, 22, 0.35, 0.7, seed,
            [&](const Vec2& p) { return p.y() > foot || std::abs(p.x()) > 15.0; });
  AddTufts(world, land, 420, 0.22, seed, [&](const Vec2& p) { return (p - start).norm() > 1.6 && p.y() > foot - 1.0; });
  AddTreeLine(world, land, {.nearest = 4.0, .woods = 0.5}, seed);
  EndWorld(world, land, config.weather, seed);
  return world;
}

void Describe(base::Description& d, LandingFieldConfig& c) {
  d.Field("trees", c.trees, {.meaning = "trees, at most", .min = 0, .max = 60});
  d.Field("shrubs", c.shrubs, {.meaning = "shrubs, at most", .min = 0, .max = 150});
  d.Field("furrow_height", c.furrow_height,
          {.unit = "m", .meaning = "of the ploughed strip's ridges", .min = 0.08, .max = 0.4});
  d.Field("weather", c.weather, {.meaning = "hour, sun, clouds, fog and wind"});
}

World MakeWorld(const LandingFieldConfig& config, std::uint64_t seed) {
  World world;
  world.name = "landing_field";
  RandomStream random(seed, "world/land");
  Land land = MakeLand({.half = Vec2::Constant(kHalf),
                        .cell = 1.0,
                        .swell = {.height = 0.3, .wavelength = 60.0, .octaves = 2},
                        .relief = {.height = 0.025, .wavelength = 7.0, .octaves = 2},
                        .hills = 10.0},
                       {}, random);
  const Vec2 start(random.Uniform(-4.0, 4.0), -kHalf + 2.5);
  AddStart(world, land, start, seed);
  const Surface grass = AddGrassGround(world, seed);
  AddLand(world, land, grass, AddMeadow(world, seed), random);
  const int soil = AddMaterial(world, "soil",
                               {.pattern = Pattern::kSoil,
                                .palette = {{0.24F, 0.17F, 0.11F}, {0.70F, 0.56F, 0.42F}},
                                .size = 512,
                                .contrast = 0.16},
                               seed);
  const double strip = random.Uniform(13.0, 15.0);  // y where the ploughed strip begins
  AddFurrows(world, land, soil, {-kHalf + 1.0, strip}, {kHalf - 1.0, strip + 7.5}, config.furrow_height);

  Plot plot(Vec2::Constant(kHalf - 0.8));
  plot.Take(start, 2.5);
  const auto off_strip = [&](const Vec2& p) { return p.y() < strip - 1.0 || p.y() > strip + 8.5; };
  const double side = random.Uniform() < 0.5 ? -1.0 : 1.0;  // where the shrubs stand
  const Wood wood = MakeWood(world, 5.0, 8.0, 2, 1, seed);
  PlantWood(world, land, plot, wood, config.trees, 4.0, seed,
            [&](const Vec2& p) { return off_strip(p) && p.cwiseAbs().maxCoeff() > 10.0; });
  AddShrubs(world, land, plot, config.shrubs, 0.3, 0.65, seed,
            [&](const Vec2& p) { return off_strip(p) && side * p.x() > 7.0; });
  AddTufts(world, land, 420, 0.2, seed, [&](const Vec2& p) {
    return (p - start).norm() > 1.6 && off_strip(p) && (side * p.x() > 5.0 || p.cwiseAbs().maxCoeff() > 17.0);
  });
  std::vector<Vec3> line;
  for (double x = -kHalf + 1.0; x <= kHalf - 1.0; x += 2.3) line.push_back(land.On({x, strip - 1.2}));
  const int wood_grey = AddMaterial(world, "fence",
                                    {.pattern = Pattern::kWood,
                                     .palette = {{0.28F, 0.24F, 0.20F}, {0.62F, 0.56F, 0.48F}},
                                     .size = 128,
                                     .contrast = 0.18},
                                    seed);
  AddFence(world, wood_grey, "fence", line, 1.1);
  AddTreeLine(world, land, {.nearest = 14.0, .woods = 0.4, .height_min = 7.0, .height_max = 13.0}, seed);
  EndWorld(world, land, config.weather, seed);
  return world;
}

}  // namespace alula::worlds

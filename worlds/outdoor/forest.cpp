#include "worlds/outdoor/forest.h"

#include <algorithm>
#include <cmath>

#include "worlds/furniture.h"
#include "worlds/outdoor/site.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Vec2;
using base::Vec3;

constexpr double kHalf = 32.0;  // m, of the field

void PlantTrees(World& world, const ForestConfig& config, const Land& land, const Wood& wood, Plot& plot,
                std::uint64_t seed) {
  RandomStream random(seed, "world/trees");
  for (int i = 0; i < config.trees; ++i) {
    const auto p = plot.Place(0.5 * config.spacing, random);
    if (p) PlantFrom(world, wood, land, "tree" + std::to_string(i), *p, random);
  }
}

void TakeTrail(Plot& plot, const ForestConfig& config) {
  constexpr double kStep = 0.5;  // m
  for (std::size_t i = 1; i < config.trail.size(); ++i) {
    const Vec2 from = config.trail[i - 1].head<2>(), to = config.trail[i].head<2>();
    const int steps = static_cast<int>(std::ceil((to - from).norm() / kStep));
    for (int k = 0; k <= steps; ++k)
      plot.Take(from + (to - from) * (steps > 0 ? static_cast<double>(k) / steps : 0.0), 0.5 * config.trail_width);
  }
}

}  // namespace

void Describe(base::Description& d, ForestConfig& c) {
  d.Field("trees", c.trees, {.meaning = "trees in the 64 m x 64 m that are flown in, at most", .min = 0, .max = 220});
  d.Field("tree_height_min", c.tree_height_min,
          {.unit = "m", .meaning = "least height of a tree", .min = 3.0, .max = 20.0});
  d.Field("tree_height_max", c.tree_height_max,
          {.unit = "m", .meaning = "largest height of a tree", .min = 3.0, .max = 20.0});
  d.Check("tree_height_max", [&c] {
    return c.tree_height_max >= c.tree_height_min ? std::string() : std::string("must not be below tree_height_min");
  });
  d.Field("spacing", c.spacing, {.unit = "m", .meaning = "least distance between stems", .min = 1.5, .max = 12.0});
  d.Field("conifers", c.conifers, {.meaning = "share of the tree models that are conifers", .min = 0.0, .max = 1.0});
  d.Field("unevenness", c.unevenness,
          {.unit = "m", .meaning = "standard deviation of the ground's bumps", .min = 0.0, .max = 0.5});
  d.Field("boulders", c.boulders, {.meaning = "boulders, at most", .min = 0, .max = 60});
  d.Field("deadwood", c.deadwood, {.meaning = "logs and stumps, at most", .min = 0, .max = 60});
  d.Field("shrubs", c.shrubs, {.meaning = "shrubs, at most", .min = 0, .max = 120});
  d.Field("trail", c.trail,
          {.unit = "m", .meaning = "corners of a way on which nothing stands, whatever their height"});
  d.Field("trail_width", c.trail_width, {.unit = "m", .meaning = "of it, between stems", .min = 1.0, .max = 20.0});
  d.Field("weather", c.weather, {.meaning = "hour, sun, clouds, fog and wind"});
}

World MakeWorld(const ForestConfig& config, std::uint64_t seed) {
  constexpr int kModels = 4;
  World world;
  world.name = "forest";
  RandomStream random(seed, "world/land");
  Land land = MakeLand({.half = Vec2::Constant(kHalf),
                        .cell = 1.0,
                        .swell = {.height = 1.1, .wavelength = 45.0, .octaves = 2},
                        .relief = {.height = config.unevenness, .wavelength = 7.0, .octaves = 2}},
                       {}, random);
  const Vec2 start(-kHalf + 5.0, random.Uniform(-6.0, 6.0));
  const Vec2 goal(kHalf - 5.0, random.Uniform(-6.0, 6.0));
  AddPadOn(world, land, AddPadMaterial(world, seed), start, 1.2,
           std::atan2(goal.y() - start.y(), goal.x() - start.x()));
  const Surface litter = AddLitterGround(world, seed);
  AddLand(world, land, litter, litter, random);

  Plot plot(Vec2::Constant(kHalf - 1.0));
  plot.Take(start, 3.0);
  plot.Take(start + 3.5 * (goal - start).normalized(), 1.5);
  plot.Take(goal, 2.0);
  TakeTrail(plot, config);
  const int conifers = std::clamp(static_cast<int>(std::lround(config.conifers * kModels)), 0, kModels);
  const Wood wood = MakeWood(world, config.tree_height_min, config.tree_height_max, kModels - conifers, conifers, seed);
  PlantTrees(world, config, land, wood, plot, seed);
  AddRubble(world, land, plot,
            {.boulders = config.boulders, .logs = config.deadwood / 2, .stumps = (config.deadwood + 1) / 2},
            wood.looks.front().bark, seed);
  AddShrubs(world, land, plot, config.shrubs, 0.35, 0.8, seed);
  AddTufts(world, land, 300, 0.28, seed, [&](const Vec2& p) { return (p - start).norm() > 2.0; });
  AddTreeLine(world, land,
              {.nearest = 2.5,
               .woods = 0.8,
               .spacing = 8.5,
               .height_min = config.tree_height_min,
               .height_max = config.tree_height_max,
               .conifer_share = config.conifers},
              seed);
  world.target = land.On(goal) + Vec3(0, 0, 2.0);
  FinishWorld(world, land, config.weather, 20.0, seed);
  return world;
}

}  // namespace alula::worlds

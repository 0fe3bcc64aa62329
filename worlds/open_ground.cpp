#include "worlds/open_ground.h"

#include <cmath>
#include <numbers>

#include "worlds/furniture.h"
#include "worlds/textures.h"

namespace alula::worlds {
namespace {

constexpr double kPi = std::numbers::pi;

int AddMaterial(World& world, const char* name, Pattern pattern, const Palette& palette, int size, std::uint64_t seed) {
  world.materials.push_back({name, Eigen::Vector3f::Ones(), MakeTexture(pattern, palette, size, seed, name)});
  return static_cast<int>(world.materials.size()) - 1;
}

}  // namespace

void Describe(base::Description& d, OpenGroundConfig& c) {
  d.Field("size", c.size, {.unit = "m", .meaning = "side of the square of ground", .min = 10.0, .max = 1000.0});
  d.Field("pad_radius", c.pad_radius, {.unit = "m", .meaning = "radius of the landing pad", .min = 0.3, .max = 4.0});
  d.Field("target_height", c.target_height,
          {.unit = "m", .meaning = "height of the target above the pad", .min = 0.0, .max = 50.0});
  d.Field("start_yaw", c.start_yaw, {.unit = "rad", .meaning = "heading at the start", .min = -6.3, .max = 6.3});
  d.Field("blocks", c.blocks, {.meaning = "blocks on the ground", .min = 0, .max = 200});
  d.Field("block_distance_min", c.block_distance_min,
          {.unit = "m", .meaning = "smallest distance of a block from the pad", .min = 3.0, .max = 500.0});
  d.Check("block_distance_min", [&c] {
    return c.blocks == 0 || c.block_distance_min < 0.5 * c.size ? std::string()
                                                                : std::string("must be below half of size");
  });
  d.Field("wind_mean", c.wind_mean, {.unit = "m/s", .meaning = "mean velocity of the air, world axes"});
  d.Field("gust_sigma", c.gust_sigma,
          {.unit = "m/s", .meaning = "standard deviation of gusts per axis", .min = 0.0, .max = 20.0});
  d.Field("gust_time", c.gust_time, {.unit = "s", .meaning = "correlation time of gusts", .min = 0.05, .max = 60.0});
  DescribeTextureSize(d, c.texture_size);
}

World MakeWorld(const OpenGroundConfig& config, std::uint64_t seed) {
  World world;
  world.name = "open_ground";
  const int ground = AddMaterial(world, "ground", Pattern::kGravel, {{0.20F, 0.18F, 0.15F}, {0.88F, 0.84F, 0.76F}},
                                 config.texture_size, seed);
  const int pad = AddMaterial(world, "pad", Pattern::kPad, {{0.06F, 0.08F, 0.10F}, {0.95F, 0.93F, 0.85F}},
                              config.texture_size, seed);
  const int block = AddMaterial(world, "block", Pattern::kConcrete, {{0.14F, 0.14F, 0.15F}, {0.90F, 0.91F, 0.92F}},
                                config.texture_size, seed);
  const double half = 0.5 * config.size;
  AddObject(world, "ground", geometry::Box{{half, half, 0.25}}, {base::Quat::Identity(), {0.0, 0.0, -0.25}}, ground,
            7.0, SemanticClass::kGround);
  AddPad(world, pad, {0.0, 0.0}, config.pad_radius);
  base::RandomStream random(seed, "world/blocks");
  for (int i = 0; i < config.blocks; ++i) {
    const double angle = 2.0 * kPi * (i + random.Uniform()) / config.blocks;
    const double distance = random.Uniform(config.block_distance_min, std::max(config.block_distance_min, half - 1.0));
    const base::Vec3 h(random.Uniform(0.4, 1.5), random.Uniform(0.4, 1.5), random.Uniform(0.5, 2.0));
    AddObject(
        world, "block" + std::to_string(i), geometry::Box{h},
        {base::FromYaw(random.Uniform(-kPi, kPi)), {distance * std::cos(angle), distance * std::sin(angle), h.z()}},
        block, random.Uniform(3.0, 5.0));
  }
  world.wind = {config.wind_mean, config.gust_sigma, config.gust_time};
  world.light.to_sun_W = base::Vec3(0.4, -0.5, 0.8).normalized();
  world.X_WB_start = {base::FromYaw(config.start_yaw), {0.0, 0.0, kPadHeight}};
  world.target = {0.0, 0.0, kPadHeight + config.target_height};
  world.bounds_low = {-half, -half, 0.0};
  world.bounds_high = {half, half, std::max(20.0, config.target_height + 5.0)};
  return world;
}

}  // namespace alula::worlds

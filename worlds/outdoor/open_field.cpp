#include "worlds/outdoor/open_field.h"

#include <cmath>
#include <memory>
#include <numbers>

#include "worlds/actors/grass.h"
#include "worlds/kit/building.h"
#include "worlds/kit/street.h"
#include "worlds/outdoor/site.h"

namespace alula::worlds {

using base::RandomStream;
using base::Vec2;
using base::Vec3;

void Describe(base::Description& d, OpenFieldConfig& c) {
  d.Field("building_distance_min", c.building_distance_min,
          {.unit = "m", .meaning = "least distance of the building from the pad", .min = 12.0, .max = 30.0});
  d.Field("building_distance_max", c.building_distance_max,
          {.unit = "m", .meaning = "largest distance of the building from the pad", .min = 12.0, .max = 30.0});
  d.Check("building_distance_max", [&c] {
    return c.building_distance_max >= c.building_distance_min ? std::string()
                                                              : std::string("must not be below building_distance_min");
  });
  d.Field("unevenness", c.unevenness,
          {.unit = "m", .meaning = "standard deviation of the ground's bumps", .min = 0.0, .max = 0.3});
  d.Field("contrast", c.contrast,
          {.meaning = "standard deviation of the grass's tones over their range", .min = 0.02, .max = 0.27});
  d.Field("tufts", c.tufts, {.meaning = "tufts of longer grass", .min = 0, .max = 4000});
  d.Field("waving_tufts", c.waving_tufts,
          {.meaning = "tufts near the pad and at the target that the wash of the vehicle bends", .min = 0, .max = 800});
  d.Field("weather", c.weather, {.meaning = "hour, sun, clouds, fog and wind"});
}

namespace {

/// Long grass where a vehicle flies low, off the pad: on the way that it takes, and about the target.
void AddWavingGrass(World& world, const Land& land, int tufts, std::uint64_t seed) {
  constexpr double kHalf = 2.5;     // m
  constexpr double kFromPad = 5.5;  // m, of the patch's middle
  const auto ground = std::make_shared<const HeightField>(land.field);
  const Vec2 target = world.target.head<2>();
  const auto patch = [&](const char* name, const Vec2& middle) {
    const GrassConfig grass{.low = middle - Vec2::Constant(kHalf),
                            .high = middle + Vec2::Constant(kHalf),
                            .tufts = tufts / 2,
                            .ground = ground};
    AddGrass(world, name, grass, seed);
  };
  if (tufts < 2) return;
  patch("grass/pad", kFromPad * target.normalized());
  patch("grass/target", target);
}

}  // namespace

World MakeWorld(const OpenFieldConfig& config, std::uint64_t seed) {
  constexpr double kPi = std::numbers::pi;
  World world;
  world.name = "open_field";
  RandomStream random(seed, "world/land");
  Land land = MakeLand({.half = Vec2::Constant(40.0),
                        .cell = 1.0,
                        .swell = {.height = 0.5, .wavelength = 70.0, .octaves = 2},
                        .relief = {.height = config.unevenness, .wavelength = 9.0, .octaves = 2},
                        .reach = 104.0,
                        .hills = 11.0},
                       {}, random);
  const double bearing = random.Uniform(-kPi, kPi);
  const double distance = random.Uniform(config.building_distance_min, config.building_distance_max);
  const Vec2 place = distance * Vec2(std::cos(bearing), std::sin(bearing));
  AddPadOn(world, land, AddPadMaterial(world, seed), Vec2::Zero(), 1.2, bearing);
  Level(land.field, place, 6.5, 4.0, HeightAt(land.field, place));
  const Surface grass = AddGrassGround(world, seed, config.contrast);
  AddLand(world, land, grass, AddMeadow(world, seed), random);

  const BuildingLooks looks =
      AddBuildingLooks(world, Pattern::kBrick, {{0.30F, 0.16F, 0.12F}, {0.72F, 0.52F, 0.42F}}, "barn", seed);
  AddHouse(world, looks, "barn", {base::FromYaw(random.Uniform(-kPi, kPi)), land.On(place)}, {}, random);
  AddTufts(world, land, config.tufts, 0.22, seed,
           [&](const Vec2& p) { return p.norm() > 1.6 && (p - place).norm() > 6.0; });
  AddTreeLine(world, land,
              {.nearest = 42.0, .woods = 0.3, .height_min = 8.0, .height_max = 15.0, .conifer_share = 0.15}, seed);
  const Vec2 yard = place * (1.0 - 6.6 / distance);
  const int metal = AddPlainMaterial(world, "metal", {0.38F, 0.40F, 0.41F});
  AddStreetLamp(world, metal, "yard_lamp", {base::FromYaw(bearing + kPi), land.On(yard)}, {.height = 4.0},
                IsDark(config.weather));
  world.target = land.On(place * (1.0 - 9.0 / distance)) + Vec3(0, 0, 1.5);
  AddWavingGrass(world, land, config.waving_tufts, seed);
  FinishWorld(world, land, config.weather, 20.0, seed);
  return world;
}

}  // namespace alula::worlds

#include "worlds/outdoor/landing_town.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "worlds/furniture.h"
#include "worlds/kit/building.h"
#include "worlds/kit/mesh_parts.h"
#include "worlds/kit/street.h"
#include "worlds/outdoor/site.h"

namespace alula::worlds {
namespace {

using base::Quat;
using base::RandomStream;
using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kPi = std::numbers::pi;
constexpr double kHalf = 24.0;
constexpr double kTargetUp = 18.0;
constexpr double kTop = 30.0;

/// A flat paved place to the horizon's hills.
Land AddPavedPlace(World& world, const Vec2& start, std::uint64_t seed) {
  RandomStream random(seed, "world/land");
  Land land = MakeLand(
      {.half = Vec2::Constant(kHalf), .cell = 4.0, .swell = {.height = 0.0}, .relief = {.height = 0.0}, .hills = 9.0},
      {}, random);
  AddPadOn(world, land, AddPadMaterial(world, seed), start, 1.0, 0.5 * kPi);
  const Surface paving = AddPavedGround(world, seed);
  AddLand(world, land, paving, AddMeadow(world, seed), random);
  return land;
}

/// Rows of buildings around the place, beyond the bounds.
void AddTown(World& world, const Land& land, int storeys_min, int storeys_max, std::uint64_t seed) {
  RandomStream random(seed, "world/town");
  const std::array<std::pair<Pattern, Palette>, 3> walls{{
      {Pattern::kPlaster, {{0.50F, 0.46F, 0.38F}, {0.92F, 0.87F, 0.76F}}},
      {Pattern::kBrick, {{0.36F, 0.20F, 0.15F}, {0.80F, 0.58F, 0.48F}}},
      {Pattern::kConcrete, {{0.42F, 0.42F, 0.42F}, {0.86F, 0.86F, 0.85F}}},
  }};
  std::vector<BuildingLooks> looks;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    looks.push_back(AddBuildingLooks(world, walls[i].first, walls[i].second, "town" + std::to_string(i), seed));
  }
  int number = 0;
  for (int side = 0; side < 4; ++side) {
    const Quat q = base::FromYaw(0.5 * kPi * side);
    double x = -30.0;
    while (x < 30.0) {
      BlockConfig block;
      block.length = random.Uniform(15.0, 22.0);
      block.width = random.Uniform(9.0, 12.0);
      block.storeys =
          storeys_min + static_cast<int>(random.Index(static_cast<std::uint64_t>(storeys_max - storeys_min + 1)));
      const double back = random.Uniform(9.0, 12.0);  // from the place's border
      const Vec3 at = q * Vec3(x + 0.5 * block.length, kHalf + back + 0.5 * block.width, 0.0);
      x += block.length + random.Uniform(2.5, 6.0);
      AddBlock(world, looks[random.Index(looks.size())], "block" + std::to_string(number++), {q, land.On(at.head<2>())},
               block, random);
    }
  }
}

void AddLamps(World& world, const Land& land, bool lit, const std::vector<Vec2>& places) {
  const int metal = AddPlainMaterial(world, "metal", {0.30F, 0.32F, 0.33F});
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double inward = std::atan2(-places[i].y(), -places[i].x());
    AddStreetLamp(world, metal, "street_lamp" + std::to_string(i), {base::FromYaw(inward), land.On(places[i])}, {},
                  lit);
  }
}

void EndWorld(World& world, const Land& land, const WeatherConfig& weather, std::uint64_t seed) {
  world.target = land.On(Vec2::Zero()) + Vec3(0, 0, kTargetUp);
  FinishWorld(world, land, weather, kTop, seed);
}

/// A raised bed: kerb of stone, soil, and what grows there.
struct Bed {
  RingSector ground;
  double kerb = 0.3;     // m, its width
  double height = 0.32;  // m, of the kerb; the soil lies 6 cm lower
};

class BedPlanter {
 public:
  BedPlanter(World& world, std::uint64_t seed) : world_(world), seed_(seed), random_(seed, "world/beds") {
    stone_ = AddMaterial(world, "kerb",
                         {.pattern = Pattern::kConcrete,
                          .palette = {{0.45F, 0.44F, 0.42F}, {0.84F, 0.82F, 0.78F}},
                          .size = 256,
                          .contrast = 0.14},
                         seed);
    soil_ = AddMaterial(world, "soil",
                        {.pattern = Pattern::kSoil,
                         .palette = {{0.20F, 0.14F, 0.10F}, {0.60F, 0.48F, 0.36F}},
                         .size = 512,
                         .contrast = 0.16},
                        seed);
    const std::array<Palette, 3> blossoms{{{{0.70F, 0.10F, 0.14F}, {0.98F, 0.50F, 0.42F}},
                                           {{0.80F, 0.60F, 0.08F}, {1.00F, 0.92F, 0.45F}},
                                           {{0.45F, 0.20F, 0.60F}, {0.85F, 0.70F, 0.95F}}}};
    for (std::size_t i = 0; i < blossoms.size(); ++i) {
      plants_.push_back(AddFoliageMaterial(world, "flowers" + std::to_string(i),
                                           {.kind = Foliage::kFlowers,
                                            .leaves = {{0.15F, 0.21F, 0.08F}, {0.55F, 0.66F, 0.30F}},
                                            .blossom = blossoms[i],
                                            .size = 128},
                                           seed));
    }
    plants_.push_back(AddFoliageMaterial(
        world, "weeds", {.kind = Foliage::kTuft, .leaves = {{0.15F, 0.20F, 0.08F}, {0.62F, 0.68F, 0.38F}}, .size = 128},
        seed));
  }

  void Add(const std::string& name, const Bed& bed, const Transform& X, double plants_per_m2) {
    AddStone(name, bed, X);
    const RingSector& g = bed.ground;
    const double area = 0.5 * (g.a1 - g.a0) * (g.r1 * g.r1 - g.r0 * g.r0);
    std::vector<std::shared_ptr<geometry::Mesh>> meshes(plants_.size());
    for (auto& mesh : meshes) mesh = std::make_shared<geometry::Mesh>();
    const double soil = bed.height - 0.06;
    for (int i = 0; i < static_cast<int>(area * plants_per_m2); ++i) {
      const double r = std::sqrt(random_.Uniform(g.r0 * g.r0, g.r1 * g.r1));
      const double angle = random_.Uniform(g.a0, g.a1);
      // Kinds in patches.
      const double patch = std::sin(1.1 * r + 2.0) + std::sin(5.0 * angle + 0.7 * r) + random_.Uniform(-0.6, 0.6);
      const std::size_t kind = patch > 1.1 ? 0 : patch > 0.1 ? 1 : patch > -0.9 ? 3 : 2;
      const double tall = random_.Uniform(0.28, 0.55);
      const Vec3 foot = X * Vec3(r * std::cos(angle), r * std::sin(angle), soil - 0.02);
      AddCrossedCards(*meshes[kind], foot, random_.Uniform(0.4, 0.6), tall, random_.Uniform(0.0, kPi));
    }
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      AddCards(world_, name + "/plants" + std::to_string(k), meshes[k], plants_[k], SemanticClass::kTree);
    }
  }

  /// A place on a bed, on its soil.
  Vec3 PlaceOn(const Bed& bed, const Transform& X) {
    const RingSector& g = bed.ground;
    const double r = std::sqrt(random_.Uniform(std::pow(g.r0 + 0.6 * (g.r0 > 0), 2), std::pow(g.r1 - 0.6, 2)));
    const double margin = 0.7 / std::max(r, 1.0);
    const double angle = random_.Uniform(g.a0 + margin, g.a1 - margin);
    return X * Vec3(r * std::cos(angle), r * std::sin(angle), bed.height - 0.06);
  }
  RandomStream& random() { return random_; }

 private:
  void AddStone(const std::string& name, const Bed& bed, const Transform& X) {
    const RingSector& g = bed.ground;
    auto soil = std::make_shared<geometry::Mesh>();
    RingSector fill = g;
    fill.z0 = -0.2;
    fill.z1 = bed.height - 0.06;
    AddRingSector(*soil, fill, Transform{}, 2.2);
    AddObject(world_, name + "/soil", geometry::MeshShape{std::move(soil)}, X, soil_, 1.0, SemanticClass::kGround);
    auto kerb = std::make_shared<geometry::Mesh>();
    const auto ring = [&](double r0, double r1, double a0, double a1) {
      AddRingSector(*kerb, {r0, r1, a0, a1, -0.2, bed.height}, Transform{}, 1.5);
    };
    ring(g.r1, g.r1 + bed.kerb, g.a0, g.a1);
    if (g.r0 > 0.0) ring(g.r0 - bed.kerb, g.r0, g.a0, g.a1);
    if (g.a1 - g.a0 < 2.0 * kPi - 1e-6) {  // the ends
      for (const auto& [angle, side] : std::array<std::pair<double, double>, 2>{{{g.a0, -1.0}, {g.a1, 1.0}}}) {
        const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
        const Vec3 across = side * Vec3(-out.y(), out.x(), 0.0);
        const Vec3 middle = 0.5 * (g.r0 + g.r1) * out + 0.5 * bed.kerb * across + Vec3(0, 0, 0.5 * (bed.height - 0.2));
        AddBoxPart(*kerb, {g.r1 - g.r0 + 2.0 * bed.kerb, bed.kerb, bed.height + 0.2}, {base::FromYaw(angle), middle},
                   1.5);
      }
    }
    AddObject(world_, name + "/kerb", geometry::MeshShape{std::move(kerb)}, X, stone_, 1.0);
  }

  World& world_;
  std::uint64_t seed_;
  RandomStream random_;
  int stone_ = 0, soil_ = 0;
  std::vector<int> plants_;
};

}  // namespace

void Describe(base::Description& d, LandingSquareConfig& c) {
  d.Field("ring", c.ring,
          {.unit = "m", .meaning = "of the circle on which the obstacles stand", .min = 5.0, .max = 14.0});
  d.Field("storeys_min", c.storeys_min, {.meaning = "least storeys of a building", .min = 1, .max = 12});
  d.Field("storeys_max", c.storeys_max, {.meaning = "most storeys of a building", .min = 1, .max = 12});
  d.Check("storeys_max", [&c] {
    return c.storeys_max >= c.storeys_min ? std::string() : std::string("must not be below storeys_min");
  });
  d.Field("weather", c.weather, {.meaning = "hour, sun, clouds, fog and wind"});
}

World MakeWorld(const LandingSquareConfig& config, std::uint64_t seed) {
  World world;
  world.name = "landing_square";
  RandomStream random(seed, "world/square");
  const Vec2 start(random.Uniform(-4.0, 4.0), -kHalf + 2.5);
  const Land land = AddPavedPlace(world, start, seed);
  AddTown(world, land, config.storeys_min, config.storeys_max, seed);

  const int stone = AddMaterial(world, "stone",
                                {.pattern = Pattern::kPlaster,
                                 .palette = {{0.44F, 0.42F, 0.38F}, {0.86F, 0.83F, 0.76F}},
                                 .size = 256,
                                 .contrast = 0.14},
                                seed);
  const int carving = AddMaterial(world, "carving",
                                  {.pattern = Pattern::kRubble,
                                   .palette = {{0.36F, 0.33F, 0.28F}, {0.82F, 0.76F, 0.66F}},
                                   .size = 256,
                                   .contrast = 0.15},
                                  seed);
  const double turn = random.Uniform(0.0, 2.0 * kPi);
  for (int i = 0; i < 5; ++i) {
    const double angle = turn + 2.0 * kPi * i / 5.0;
    const Vec2 p = config.ring * Vec2(std::cos(angle), std::sin(angle));
    const Transform X{base::FromYaw(angle + 0.5 * kPi + random.Uniform(-0.15, 0.15)), land.On(p)};
    if (i % 2 == 0) {
      AddCarvedWall(world, stone, carving, "wall" + std::to_string(i / 2), X, random.Uniform(3.6, 4.6),
                    random.Uniform(2.0, 2.6), random);
    } else {
      AddStoneBench(world, stone, "bench" + std::to_string(i / 2), X, random.Uniform(3.6, 4.8));
    }
  }
  // Trees stand in the corners, in round beds.
  BedPlanter planter(world, seed);
  const Wood wood = MakeWood(world, 5.5, 7.5, 2, 0, seed);
  int number = 0;
  for (const double x : {-18.5, 18.5}) {
    for (const double y : {-18.5, 18.5}) {
      const Transform X{Quat::Identity(), land.On({x, y})};
      planter.Add("bed" + std::to_string(number), {.ground = {0.0, 1.2}, .kerb = 0.25, .height = 0.4}, X, 8.0);
      PlantTree(world, wood.models[random.Index(wood.models.size())], wood.looks.front(),
                "tree" + std::to_string(number++), {X.p + Vec3(0, 0, 0.34), random.Uniform(-kPi, kPi)});
    }
  }
  AddLamps(world, land, IsDark(config.weather),
           {{-16.0, -10.0},
            {-16.0, 10.0},
            {16.0, -10.0},
            {16.0, 10.0},
            {-6.0, 17.0},
            {6.0, 17.0},
            {9.0, -19.0},
            {-9.0, -19.0}});
  AddTreeLine(world, land, {.nearest = 36.0, .woods = 0.35, .height_min = 8.0, .height_max = 14.0}, seed);
  EndWorld(world, land, config.weather, seed);
  return world;
}

void Describe(base::Description& d, LandingFlowerbedsConfig& c) {
  d.Field("cars", c.cars, {.meaning = "cars parked before the round bed", .min = 0, .max = 5});
  d.Field("trees", c.trees, {.meaning = "trees on the beds", .min = 0, .max = 40});
  d.Field("plants_per_m2", c.plants_per_m2,
          {.meaning = "flowers and weeds on a square metre of bed", .min = 0.5, .max = 12.0});
  d.Field("weather", c.weather, {.meaning = "hour, sun, clouds, fog and wind"});
}

World MakeWorld(const LandingFlowerbedsConfig& config, std::uint64_t seed) {
  World world;
  world.name = "landing_flowerbeds";
  RandomStream random(seed, "world/square");
  const Vec2 start(random.Uniform(-4.0, 4.0), -kHalf + 2.5);
  const Land land = AddPavedPlace(world, start, seed);
  AddTown(world, land, 2, 4, seed);

  const Vec2 heart(random.Uniform(-2.0, 2.0), 5.0 + random.Uniform(-0.5, 0.5));
  const Transform X{Quat::Identity(), land.On(heart)};
  const double round = random.Uniform(3.6, 4.4);
  std::vector<Bed> beds{{.ground = {0.0, round}, .kerb = 0.35, .height = 0.45}};
  const double inner = round + random.Uniform(3.8, 4.6);
  const double gap = 0.16;  // rad, of the ways between the half-round beds
  beds.push_back({.ground = {inner, inner + 4.2, 0.02, 0.5 * kPi - gap}});
  beds.push_back({.ground = {inner, inner + 4.2, 0.5 * kPi + gap, kPi - 0.02}});
  BedPlanter planter(world, seed);
  for (std::size_t i = 0; i < beds.size(); ++i) {
    planter.Add("bed" + std::to_string(i), beds[i], X, config.plants_per_m2);
  }
  const Wood wood = MakeWood(world, 5.0, 8.0, 2, 1, seed);
  const PlantLooks shrub_looks = AddShrubLooks(world, "shrub", seed);
  const std::array<ShrubModel, 2> shrubs{MakeShrubModel(0.5, 0.8, random), MakeShrubModel(0.75, 1.2, random)};
  std::vector<Vec3> taken;
  const auto plant = [&](int count, double apart, const auto& put) {
    for (int i = 0, tries = 0; i < count && tries < 40 * count; ++tries) {
      const std::size_t bed = tries % 4 == 0 ? 0 : 1 + static_cast<std::size_t>(tries % 2);
      const Vec3 p = planter.PlaceOn(beds[bed], X);
      if (std::any_of(taken.begin(), taken.end(), [&](const Vec3& q) { return (p - q).norm() < apart; })) continue;
      taken.push_back(p);
      put(p, i++);
    }
  };
  plant(config.trees, 2.2, [&](const Vec3& p, int i) {
    const std::size_t pick = random.Index(wood.models.size());
    PlantTree(world, wood.models[pick], wood.looks[pick], "tree" + std::to_string(i), {p, random.Uniform(-kPi, kPi)});
  });
  plant(26, 1.1, [&](const Vec3& p, int i) {
    PlantShrub(world, shrubs[random.Index(2)], shrub_looks, "shrub" + std::to_string(i),
               {p, random.Uniform(-kPi, kPi)});
  });
  const std::array<Eigen::Vector3f, 5> paints{{{0.78F, 0.78F, 0.80F},
                                               {0.60F, 0.10F, 0.10F},
                                               {0.14F, 0.22F, 0.42F},
                                               {0.90F, 0.90F, 0.88F},
                                               {0.22F, 0.24F, 0.25F}}};
  for (int i = 0; i < config.cars; ++i) {
    const std::string name = "car" + std::to_string(i);
    const double x = heart.x() + 2.9 * (i - 0.5 * (config.cars - 1)) + random.Uniform(-0.15, 0.15);
    const double y = heart.y() - round - random.Uniform(3.6, 4.2);
    AddCar(world, AddCarLooks(world, name, paints[(static_cast<std::size_t>(i) + random.Index(2)) % paints.size()]),
           name,
           {base::FromYaw((random.Uniform() < 0.7 ? 0.5 : -0.5) * kPi + random.Uniform(-0.05, 0.05)), land.On({x, y})});
  }
  AddLamps(world, land, IsDark(config.weather),
           {{-19.0, -8.0}, {19.0, -8.0}, {-19.0, 14.0}, {19.0, 14.0}, {0.0, 21.0}, {-10.0, -21.0}, {10.0, -21.0}});
  AddTreeLine(world, land, {.nearest = 36.0, .woods = 0.35, .height_min = 8.0, .height_max = 14.0}, seed);
  EndWorld(world, land, config.weather, seed);
  return world;
}

}  // namespace alula::worlds

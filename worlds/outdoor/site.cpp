#include "worlds/outdoor/site.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include "worlds/furniture.h"
#include "worlds/kit/mesh_parts.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Vec2;
using base::Vec3;

constexpr double kPi = std::numbers::pi;

}  // namespace

bool Plot::IsFree(const Vec2& p, double radius) const {
  return std::all_of(taken_.begin(), taken_.end(),
                     [&](const Disc& disc) { return (disc.p - p).norm() >= disc.radius + radius; });
}

std::optional<Vec2> Plot::Place(double radius, RandomStream& random, const std::function<bool(const Vec2&)>& allowed,
                                int tries) {
  for (int i = 0; i < tries; ++i) {
    const Vec2 p(random.Uniform(-half_.x(), half_.x()), random.Uniform(-half_.y(), half_.y()));
    if (!IsFree(p, radius) || (allowed && !allowed(p))) continue;
    Take(p, radius);
    return p;
  }
  return std::nullopt;
}

Surface AddLitterGround(World& world, std::uint64_t seed) {
  return AddSurface(world, "litter",
                    {.pattern = Pattern::kLitter,
                     .palette = {{0.20F, 0.15F, 0.10F}, {0.80F, 0.66F, 0.48F}},
                     .size = 512,
                     .contrast = 0.18,
                     .infrared = 1.3F},
                    seed);
}

Surface AddGrassGround(World& world, std::uint64_t seed, double contrast) {
  return AddSurface(world, "grass",
                    {.pattern = Pattern::kGrass,
                     .palette = {{0.18F, 0.24F, 0.09F}, {0.72F, 0.77F, 0.42F}},
                     .size = 512,
                     .contrast = contrast,
                     .infrared = 1.8F},
                    seed);
}

Surface AddMeadow(World& world, std::uint64_t seed) {
  return AddSurface(world, "meadow",
                    {.pattern = Pattern::kGrass,
                     .palette = {{0.18F, 0.24F, 0.09F}, {0.72F, 0.77F, 0.42F}},
                     .period = 8.0,
                     .size = 256,
                     .variants = 4,
                     .contrast = 0.07,
                     .infrared = 1.8F},
                    seed);
}

Surface AddPavedGround(World& world, std::uint64_t seed) {
  return AddSurface(world, "paving",
                    {.pattern = Pattern::kTiles,
                     .palette = {{0.30F, 0.29F, 0.27F}, {0.78F, 0.75F, 0.70F}},
                     .size = 512,
                     .contrast = 0.13},
                    seed);
}

int AddPadMaterial(World& world, std::uint64_t seed) {
  return AddMaterial(world, "pad",
                     {.pattern = Pattern::kPad, .palette = {{0.06F, 0.08F, 0.10F}, {0.95F, 0.93F, 0.85F}}, .size = 256},
                     seed);
}

Wood MakeWood(World& world, double height_min, double height_max, int broadleaf, int conifer, std::uint64_t seed) {
  RandomStream random(seed, "world/wood");
  Wood wood;
  const auto add = [&](TreeKind kind, int count, const char* name) {
    if (count == 0) return;
    const PlantLooks looks = AddTreeLooks(world, kind, name, seed);
    for (int i = 0; i < count; ++i) {
      const double height = height_min + (height_max - height_min) * (i + random.Uniform()) / count;
      wood.models.push_back(MakeTreeModel(kind, height, random));
      wood.looks.push_back(looks);
    }
  };
  add(TreeKind::kBroadleaf, broadleaf, "broadleaf");
  add(TreeKind::kConifer, conifer, "conifer");
  return wood;
}

double PlantFrom(World& world, const Wood& wood, const Land& land, const std::string& name, const Vec2& p,
                 RandomStream& random) {
  const std::size_t pick = random.Index(wood.models.size());
  const Stand at{land.On(p), random.Uniform(-kPi, kPi), std::abs(0.03 * random.Gaussian())};
  PlantTree(world, wood.models[pick], wood.looks[pick], name, at);
  return wood.models[pick].trunk_radius;
}

void AddRubble(World& world, const Land& land, Plot& plot, const RubbleConfig& config, int bark, std::uint64_t seed,
               const std::function<bool(const Vec2&)>& allowed) {
  RandomStream random(seed, "world/rubble");
  if (config.boulders > 0) {
    const int stone = AddMaterial(world, "stone",
                                  {.pattern = Pattern::kSoil,
                                   .palette = {{0.24F, 0.23F, 0.21F}, {0.66F, 0.64F, 0.60F}},
                                   .size = 256,
                                   .contrast = 0.17},
                                  seed);
    for (int i = 0; i < config.boulders; ++i) {
      const double size = random.Uniform(config.size_min, config.size_max);
      const auto mesh =
          MakeBoulder({size, size * random.Uniform(0.7, 1.0), size * random.Uniform(0.55, 0.8)}, 0.06, 1.6, random);
      const auto p = plot.Place(1.3 * size, random, allowed);
      if (!p) continue;
      AddObject(world, "boulder" + std::to_string(i), geometry::MeshShape{mesh},
                {base::FromYaw(random.Uniform(-kPi, kPi)), land.On(*p) + Vec3(0, 0, 0.15 * size)}, stone, 1.0);
    }
  }
  for (int i = 0; i < config.logs; ++i) {
    const double half = random.Uniform(0.8, 2.2);
    const double radius = random.Uniform(0.10, 0.18);
    const auto p = plot.Place(0.5 * half, random, allowed);
    if (!p) continue;
    const double yaw = random.Uniform(-kPi, kPi);
    const Vec2 along(std::cos(yaw), std::sin(yaw));
    const Vec3 a = land.On(*p - half * along);
    const Vec3 b = land.On(*p + half * along);
    const double middle = std::max(0.5 * (a.z() + b.z()), land.Height(*p) - 0.3 * radius);
    AddObject(world, "log" + std::to_string(i), geometry::Cylinder{radius, half},
              {base::Quat::FromTwoVectors(Vec3::UnitZ(), Vec3(b - a)), {p->x(), p->y(), middle + 0.7 * radius}}, bark,
              0.7);
  }
  for (int i = 0; i < config.stumps; ++i) {
    const double radius = random.Uniform(0.12, 0.25);
    const auto p = plot.Place(2.0 * radius, random, allowed);
    if (!p) continue;
    const double height = random.Uniform(0.2, 0.5);
    const Vec3 foot = land.On(*p);
    AddObject(world, "stump" + std::to_string(i) + "/root", geometry::Cone{1.8 * radius, 0.5 * (0.3 + height)},
              {base::Quat::Identity(), foot + Vec3(0, 0, 0.5 * height - 0.15)}, bark, 0.7, SemanticClass::kTree);
    AddObject(world, "stump" + std::to_string(i) + "/stem", geometry::Cylinder{radius, 0.5 * (height + 0.3)},
              {base::Quat::Identity(), foot + Vec3(0, 0, 0.5 * (height - 0.3))}, bark, 0.7, SemanticClass::kTree);
  }
}

void AddShrubs(World& world, const Land& land, Plot& plot, int count, double reach_min, double reach_max,
               std::uint64_t seed, const std::function<bool(const Vec2&)>& allowed) {
  if (count == 0) return;
  RandomStream random(seed, "world/shrubs");
  const PlantLooks looks = AddShrubLooks(world, "shrub", seed);
  std::vector<ShrubModel> models;
  for (int i = 0; i < 4; ++i) {
    const double reach = reach_min + (reach_max - reach_min) * (i + random.Uniform()) / 4.0;
    models.push_back(MakeShrubModel(reach, reach * random.Uniform(1.2, 1.8), random));
  }
  for (int i = 0; i < count; ++i) {
    const ShrubModel& model = models[random.Index(models.size())];
    const auto p = plot.Place(0.8 * model.reach, random, allowed);
    if (!p) continue;
    PlantShrub(world, model, looks, "shrub" + std::to_string(i), {land.On(*p), random.Uniform(-kPi, kPi)});
  }
}

void AddTufts(World& world, const Land& land, int count, double height, std::uint64_t seed,
              const std::function<bool(const Vec2&)>& allowed) {
  if (count == 0) return;
  constexpr double kSquare = 12.0;
  RandomStream random(seed, "world/tufts");
  const int material = AddFoliageMaterial(
      world, "tuft", {.kind = Foliage::kTuft, .leaves = {{0.16F, 0.21F, 0.08F}, {0.70F, 0.76F, 0.42F}}, .size = 128},
      seed);
  std::map<std::array<int, 2>, std::shared_ptr<geometry::Mesh>> squares;
  for (int i = 0; i < count; ++i) {
    const Vec2 p(random.Uniform(-1.0, 1.0) * land.half.x(), random.Uniform(-1.0, 1.0) * land.half.y());
    const double tall = height * random.Uniform(0.5, 1.2);
    const double yaw = random.Uniform(0.0, kPi);
    if (allowed && !allowed(p)) continue;
    auto& mesh =
        squares[{static_cast<int>(std::floor(p.x() / kSquare)), static_cast<int>(std::floor(p.y() / kSquare))}];
    if (mesh == nullptr) mesh = std::make_shared<geometry::Mesh>();
    AddCrossedCards(*mesh, land.On(p) - Vec3(0, 0, 0.03), 1.1 * tall, tall, yaw);
  }
  for (const auto& [square, mesh] : squares) {
    AddCards(world, "tufts/" + std::to_string(square[0]) + "_" + std::to_string(square[1]), mesh, material,
             SemanticClass::kGround);
  }
}

void FinishWorld(World& world, const Land& land, const WeatherConfig& weather, double top, std::uint64_t seed) {
  std::vector<Lamp> lamps = std::move(world.light.lamps);
  world.light = DrawLight(weather, seed);
  world.light.lamps = std::move(lamps);
  world.wind = DrawWind(weather.wind, seed);
  const auto [low, high] = std::minmax_element(land.field.z.begin(), land.field.z.end());
  const double ceiling = std::max(static_cast<double>(*high), world.X_WB_start.p.z()) + top;
  world.bounds_low = {-land.half.x(), -land.half.y(), std::min(static_cast<double>(*low), 0.0) - 0.5};
  world.bounds_high = {land.half.x(), land.half.y(), ceiling};
}

}  // namespace alula::worlds

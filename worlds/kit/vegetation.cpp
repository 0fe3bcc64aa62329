#include "worlds/kit/vegetation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "worlds/furniture.h"
#include "worlds/kit/mesh_parts.h"
#include "worlds/kit/surface.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Transform;
using base::Vec3;
using geometry::Mesh;

constexpr double kPi = std::numbers::pi;
constexpr double kRooted = 0.3;  // m below the foot, for slopes

Vec3 Level(double angle) { return {std::cos(angle), std::sin(angle), 0.0}; }

/// A square card about `middle`, turned at random, lit as the surface of a ball about `heart` is there.
void AddSprayCard(Mesh& mesh, const Vec3& middle, double half, const Vec3& heart, RandomStream& random) {
  const base::Quat turn = base::Exp(Vec3(1.2 * random.GaussianVec3()));
  const Vec3 right = turn * Vec3(half, 0.0, 0.0);
  const Vec3 up = turn * Vec3(0.0, half, 0.0);
  const auto out = [&](const Vec3& p) { return Vec3((p - heart).normalized() + Vec3(0.0, 0.0, 0.25)).normalized(); };
  AddCard(mesh, middle, right, up,
          {out(middle - right - up), out(middle + right - up), out(middle + right + up), out(middle - right + up)});
}

/// A bumpy body of half axes `size` about `middle`.
std::shared_ptr<const Mesh> CrownHeart(const Vec3& middle, const Vec3& size, RandomStream& random) {
  constexpr int kColumns = 9;
  constexpr int kRows = 5;
  std::vector<double> bumps;
  for (int i = 0; i < (kRows + 1) * kColumns; ++i) bumps.push_back(1.0 + 0.2 * random.Uniform(-1.0, 1.0));
  auto mesh = std::make_shared<Mesh>();
  for (int row = 0; row <= kRows; ++row) {
    for (int column = 0; column <= kColumns; ++column) {
      const double latitude = kPi * (static_cast<double>(row) / kRows - 0.5);
      const double longitude = 2.0 * kPi * (column % kColumns) / kColumns;
      const bool pole = row == 0 || row == kRows;
      const Vec3 d = pole ? Vec3(0.0, 0.0, row == 0 ? -1.0 : 1.0)
                          : Vec3(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                                 std::sin(latitude));
      const double bump = pole ? 1.0 : bumps[static_cast<std::size_t>(row * kColumns + column % kColumns)];
      const Vec3 p = middle + bump * d.cwiseProduct(size);
      mesh->vertices.push_back(
          {p.cast<float>(), d.cwiseQuotient(size).normalized().cast<float>(),
           base::Vec2(2.0 * kPi * size.x() * column / kColumns / 1.6, kPi * size.z() * row / kRows / 1.6)
               .cast<float>()});
    }
  }
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const std::uint32_t a = row * (kColumns + 1) + column;
      const std::uint32_t b = a + kColumns + 1;
      if (row > 0) mesh->triangles.push_back({a, a + 1, b + 1});
      if (row + 1 < kRows) mesh->triangles.push_back({a, b + 1, b});
    }
  }
  return mesh;
}

TreeModel Broadleaf(double height, RandomStream& random) {
  TreeModel model;
  model.height = height;
  model.trunk_radius = height * random.Uniform(0.016, 0.021);
  model.bare = height * random.Uniform(0.30, 0.38);
  model.reach = height * random.Uniform(0.30, 0.36);
  auto boughs = std::make_shared<Mesh>();
  auto crown = std::make_shared<Mesh>();
  const Vec3 heart(0.0, 0.0, 0.62 * height);
  constexpr int kBoughs = 6;
  const double half = std::clamp(0.12 * height, 0.5, 1.25);
  const Vec3 core(0.27 * model.reach, 0.27 * model.reach, 0.12 * height);
  model.heart = CrownHeart(heart, core, random);
  const auto clump = [&](const Vec3& middle, double spread, int cards) {
    for (int i = 0; i < cards; ++i) {
      const Vec3 off = spread * random.GaussianVec3().cwiseProduct(Vec3(1.0, 1.0, 0.7));
      AddSprayCard(*crown, middle + off, half, heart, random);
    }
  };
  for (int i = 0; i < kBoughs; ++i) {
    const double share = (i + random.Uniform(0.2, 0.8)) / kBoughs;
    const double from = model.bare + (0.78 * height - model.bare) * share;
    const double angle = 2.4 * i + random.Uniform(-0.4, 0.4);  // the golden angle, about
    // Crowns are widest a third of the way up.
    const double widest = std::sqrt(std::max(0.0, 1.0 - std::pow((share - 0.3) / 0.75, 2)));
    const double out = model.reach * widest * random.Uniform(0.70, 0.92);
    const double rise = (0.20 + 0.55 * share) * out + 0.05 * height;
    const Vec3 root(0.0, 0.0, from);
    const Vec3 knee = root + 0.45 * out * Level(angle) + Vec3(0.0, 0.0, 0.35 * rise);
    const Vec3 tip = root + out * Level(angle + random.Uniform(-0.25, 0.25)) + Vec3(0.0, 0.0, rise);
    const double thick = model.trunk_radius * (0.5 - 0.28 * share);
    const std::array<TubePoint, 3> bough{{{root, thick}, {knee, 0.7 * thick}, {tip, 0.22 * thick}}};
    AddTube(*boughs, bough, 3, 0.6);
    clump(tip, 0.3 * half, 1);
    clump(root + 0.85 * out * Level(angle + 0.5) + Vec3(0.0, 0.0, rise), 0.3 * half, 1);
  }
  clump({0.0, 0.0, 0.86 * height}, 0.5 * half, 3);
  for (int i = 0; i < 4; ++i) {  // about the heart, from below too
    const Vec3 out(Level(1.571 * i + random.Uniform(-0.3, 0.3)) + Vec3(0.0, 0.0, random.Uniform(-0.9, 0.3)));
    clump(heart + 0.95 * out.normalized().cwiseProduct(core), 0.1 * half, 1);
  }
  model.boughs = std::move(boughs);
  model.crown = std::move(crown);
  return model;
}

TreeModel Conifer(double height, RandomStream& random) {
  TreeModel model;
  model.height = height;
  model.trunk_radius = height * random.Uniform(0.013, 0.016);
  model.bare = height * random.Uniform(0.12, 0.18);
  model.reach = height * random.Uniform(0.19, 0.23);
  auto boughs = std::make_shared<Mesh>();
  auto crown = std::make_shared<Mesh>();
  // A skirt of boughs upon another, the outer ends as cards.
  constexpr int kWhorls = 7;
  std::vector<base::Vec2> profile{{0.0, model.bare}};
  const double rise = (height - model.bare) / (kWhorls + 0.6);
  for (int w = 0; w < kWhorls; ++w) {
    const double share = static_cast<double>(w) / kWhorls;
    const double z = model.bare + rise * w;
    const double length = model.reach * (1.0 - 0.88 * share) * random.Uniform(0.92, 1.08);
    profile.emplace_back(0.62 * length, z + 0.1 * rise);
    profile.emplace_back(0.30 * length, z + 0.95 * rise);
    const int branches = w < 3 ? 7 : w < 5 ? 6 : 4;
    for (int i = 0; i < branches; ++i) {
      const double angle = 2.0 * kPi * (i + random.Uniform(-0.15, 0.15)) / branches + 0.6 * w;
      const double droop = random.Uniform(0.2, 0.45) - 0.35 * share;
      const Vec3 along = Vec3(Level(angle) - droop * Vec3::UnitZ()).normalized();
      const Vec3 across = Level(angle + 0.5 * kPi);
      const double roll = random.Uniform(-0.5, 0.5);
      const Vec3 side = (std::cos(roll) * across + std::sin(roll) * along.cross(across)).normalized();
      const Vec3 root(0.0, 0.0, z + 0.45 * rise);
      const Vec3 normal = Vec3(0.8 * Vec3::UnitZ() + 0.7 * Level(angle)).normalized();
      AddCard(*crown, root + 0.55 * length * along, 0.5 * length * along, 0.34 * length * side,
              {normal, normal, normal, normal});
    }
  }
  profile.emplace_back(0.0, 0.99 * height);
  auto heart = std::make_shared<Mesh>();
  AddLathe(*heart, profile, 9, Transform{}, 1.6);
  model.heart = std::move(heart);
  for (int i = 0; i < 4; ++i) {  // dead boughs below the crown
    const double angle = 2.4 * i + random.Uniform(-0.4, 0.4);
    const Vec3 root(0.0, 0.0, model.bare * random.Uniform(0.55, 0.95));
    const std::array<TubePoint, 2> bough{
        {{root, 0.2 * model.trunk_radius},
         {root + 0.5 * model.reach * Vec3(Level(angle) - 0.2 * Vec3::UnitZ()), 0.005}}};
    AddTube(*boughs, bough, 3, 0.6);
  }
  model.boughs = std::move(boughs);
  model.crown = std::move(crown);
  return model;
}

Eigen::Vector3f Varied(const Eigen::Vector3f& colour, float share) { return (colour * share).cwiseMin(1.0F); }

}  // namespace

int AddFoliageMaterial(World& world, const std::string& name, const FoliageConfig& config, std::uint64_t seed) {
  world.materials.push_back({name, Eigen::Vector3f::Ones(), MakeFoliageTexture(config, seed, name), 1.9F});
  return static_cast<int>(world.materials.size()) - 1;
}

PlantLooks AddTreeLooks(World& world, TreeKind kind, const std::string& name, std::uint64_t seed) {
  RandomStream random(seed, "world/plants/" + name);
  const auto light = static_cast<float>(random.Uniform(0.88, 1.12));
  const bool conifer = kind == TreeKind::kConifer;
  const Palette bark = conifer ? Palette{{0.22F, 0.15F, 0.11F}, {0.68F, 0.53F, 0.42F}}
                               : Palette{{0.20F, 0.18F, 0.15F}, {0.74F, 0.68F, 0.60F}};
  FoliageConfig foliage;
  foliage.kind = conifer ? Foliage::kNeedles : Foliage::kSpray;
  foliage.leaves = conifer ? Palette{{0.10F, 0.15F, 0.08F}, {0.46F, 0.58F, 0.36F}}
                           : Palette{{0.15F, 0.21F, 0.07F}, {0.66F, 0.76F, 0.34F}};
  foliage.size = 512;
  foliage.leaves.light = Varied(foliage.leaves.light, light);
  foliage.wood = bark;
  PlantLooks looks;
  looks.bark =
      AddMaterial(world, name + "/bark",
                  {.pattern = Pattern::kBark, .palette = bark, .size = 256, .contrast = 0.2, .infrared = 1.2F}, seed);
  looks.leaves = AddFoliageMaterial(world, name + "/leaves", foliage, seed);
  looks.dense = AddMaterial(world, name + "/dense",
                            {.pattern = Pattern::kFoliage,
                             .palette = {foliage.leaves.dark, foliage.leaves.light},
                             .size = 256,
                             .contrast = 0.25,
                             .infrared = 1.9F},
                            seed);
  return looks;
}

PlantLooks AddShrubLooks(World& world, const std::string& name, std::uint64_t seed) {
  PlantLooks looks;
  const Palette bark{{0.14F, 0.11F, 0.08F}, {0.42F, 0.36F, 0.30F}};
  looks.bark = AddPlainMaterial(world, name + "/stems", {0.30F, 0.25F, 0.20F});
  looks.leaves = AddFoliageMaterial(world, name + "/leaves",
                                    {.leaves = {{0.15F, 0.20F, 0.08F}, {0.60F, 0.70F, 0.32F}}, .wood = bark}, seed);
  return looks;
}

TreeModel MakeTreeModel(TreeKind kind, double height, RandomStream& random) {
  return kind == TreeKind::kBroadleaf ? Broadleaf(height, random) : Conifer(height, random);
}

void AddCards(World& world, const std::string& name, std::shared_ptr<const Mesh> mesh, int material,
              SemanticClass semantic) {
  if (mesh->triangles.empty()) return;
  world.objects.push_back({name, geometry::MeshShape{std::move(mesh)}, Transform{}, material, 1.0, false, semantic});
}

void PlantTree(World& world, const TreeModel& model, const PlantLooks& looks, const std::string& name,
               const Stand& at) {
  const Transform X_WT{base::FromYawPitchRoll(at.yaw, at.lean, 0.0), at.foot};
  const auto add = [&](const char* part, geometry::Shape shape, double z, int material, double scale) {
    const std::size_t index =
        AddObject(world, name + "/" + part, std::move(shape), X_WT * Transform{base::Quat::Identity(), {0.0, 0.0, z}},
                  material, scale, SemanticClass::kTree);
    return index;
  };
  const double r = model.trunk_radius;
  const double stem = model.bare + 0.12 * model.height;  // full width so far, then it tapers to a tip
  const double flare = 7.0 * r + kRooted;
  add("root", geometry::Cone{1.9 * r, 0.5 * flare}, 0.5 * flare - kRooted, looks.bark, 0.7);
  add("stem", geometry::Cylinder{r, 0.5 * (stem + kRooted)}, 0.5 * (stem - kRooted), looks.bark, 0.7);
  const double taper = 0.96 * model.height - stem;
  add("taper", geometry::Cone{r, 0.5 * taper}, stem + 0.5 * taper, looks.bark, 0.7);
  add("boughs", geometry::MeshShape{model.boughs}, 0.0, looks.bark, 1.0);
  add("heart", geometry::MeshShape{model.heart}, 0.0, looks.dense, 1.0);
  world.objects[add("crown", geometry::MeshShape{model.crown}, 0.0, looks.leaves, 1.0)].collides = false;
}

ShrubModel MakeShrubModel(double reach, double height, RandomStream& random) {
  ShrubModel model{reach, height, nullptr, nullptr};
  auto stems = std::make_shared<Mesh>();
  auto leaves = std::make_shared<Mesh>();
  const Vec3 heart(0.0, 0.0, 0.25 * height);
  const double half = std::clamp(0.5 * std::min(reach, height), 0.14, 0.55);
  constexpr int kStems = 6;
  for (int i = 0; i < kStems; ++i) {
    const double angle = 2.0 * kPi * (i + random.Uniform(-0.3, 0.3)) / kStems;
    const double out = (reach - half) * random.Uniform(0.35, 1.0);
    const Vec3 tip =
        out * Level(angle) + Vec3(0.0, 0.0, (height - half) * std::sqrt(std::max(0.1, 1.0 - std::pow(out / reach, 2))));
    const Vec3 foot = 0.12 * reach * Level(angle) - Vec3(0.0, 0.0, 0.15);
    const std::array<TubePoint, 2> stem{{{foot, 0.012 + 0.008 * height}, {tip, 0.005}}};
    AddTube(*stems, stem, 3, 0.5);
    for (const double share : {1.0, 0.55}) {
      AddSprayCard(*leaves, (share * tip + 0.12 * half * random.GaussianVec3()).cwiseMax(Vec3(-1e9, -1e9, 0.5 * half)),
                   half, heart, random);
    }
  }
  AddSprayCard(*leaves, {0.0, 0.0, height - 0.8 * half}, half, heart, random);
  model.stems = std::move(stems);
  model.leaves = std::move(leaves);
  return model;
}

void PlantShrub(World& world, const ShrubModel& model, const PlantLooks& looks, const std::string& name,
                const Stand& at) {
  const Transform X_WS{base::FromYaw(at.yaw), at.foot};
  AddObject(world, name + "/stems", geometry::MeshShape{model.stems}, X_WS, looks.bark, 1.0, SemanticClass::kTree);
  const std::size_t leaves = AddObject(world, name + "/leaves", geometry::MeshShape{model.leaves}, X_WS, looks.leaves,
                                       1.0, SemanticClass::kTree);
  world.objects[leaves].collides = false;
}

void AddCrossedCards(Mesh& mesh, const Vec3& foot, double width, double height, double yaw) {
  for (const double turn : {0.0, 0.5 * kPi}) {
    const Vec3 right = 0.5 * width * Level(yaw + turn);
    const Vec3 up(0.0, 0.0, 0.5 * height);
    const Vec3 out = 0.35 * Level(yaw + turn);
    const Vec3 left_normal = (Vec3::UnitZ() - out).normalized();
    const Vec3 right_normal = (Vec3::UnitZ() + out).normalized();
    AddCard(mesh, foot + up, right, up, {left_normal, right_normal, right_normal, left_normal});
  }
}

}  // namespace alula::worlds

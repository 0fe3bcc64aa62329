#include "worlds/kit/land.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "worlds/furniture.h"
#include "worlds/kit/foliage_texture.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Vec2;
using base::Vec3;
using geometry::Mesh;

constexpr double kPi = std::numbers::pi;

double Smooth(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

HeightField Lattice(const Vec2& half, double cell) {
  HeightField field;
  field.cell = cell;
  field.low = -half;
  field.columns = static_cast<int>(std::lround(2.0 * half.x() / cell)) + 1;
  field.rows = static_cast<int>(std::lround(2.0 * half.y() / cell)) + 1;
  field.z.assign(static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows), 0.0F);
  return field;
}

/// How far beyond the rectangle p lies, m; 0 within.
double Beyond(const Vec2& p, const Vec2& half) { return (p.cwiseAbs() - half).cwiseMax(0.0).norm(); }

/// Catmull–Rom weights of four points at t in [0, 1] between the middle two.
std::array<double, 4> CubicWeights(double t) {
  return {0.5 * t * (t * (2.0 - t) - 1.0), 0.5 * (t * t * (3.0 * t - 5.0) + 2.0), 0.5 * t * (t * (4.0 - 3.0 * t) + 1.0),
          0.5 * t * t * (t - 1.0)};
}

/// The lattice's heights without its creases.
double SmoothHeightAt(const HeightField& field, const Vec2& p) {
  const Vec2 q = (p - field.low) / field.cell;
  const int i = std::clamp(static_cast<int>(std::floor(q.x())), 1, field.columns - 3);
  const int j = std::clamp(static_cast<int>(std::floor(q.y())), 1, field.rows - 3);
  const auto wx = CubicWeights(q.x() - i);
  const auto wy = CubicWeights(q.y() - j);
  double z = 0.0;
  for (int b = 0; b < 4; ++b) {
    for (int a = 0; a < 4; ++a)
      z += wx[static_cast<std::size_t>(a)] * wy[static_cast<std::size_t>(b)] * field.At(i + a - 1, j + b - 1);
  }
  return z;
}

template <typename Function>
void ForEachPoint(HeightField& field, const Function& change) {
  for (int j = 0; j < field.rows; ++j) {
    for (int i = 0; i < field.columns; ++i) change(field.At(i, j), field.Point(i, j));
  }
}

/// The land's mesh in blocks of cells, one object a block and variant.
class LandMesh {
 public:
  LandMesh(const Land& land, const Surface& surface, RandomStream& random)
      : land_(land), surface_(surface), random_(random) {}

  void Build(World& world) {
    const HeightField& around = land_.around;
    for (int j = 0; j + 1 < around.rows; ++j) {
      for (int i = 0; i + 1 < around.columns; ++i) {
        const Vec2 low = around.Point(i, j);
        const Vec2 middle = low + Vec2::Constant(0.5 * around.cell);
        if (land_.InField(middle)) continue;
        const std::size_t variant = random_.Index(surface_.variants.size());
        const std::array<int, 3> block{i / kBlock, j / kBlock, static_cast<int>(variant)};
        std::shared_ptr<Mesh>& mesh = blocks_[block];
        if (mesh == nullptr) mesh = std::make_shared<Mesh>();
        AddCell(*mesh, i, j, middle);
      }
    }
    for (const auto& [block, mesh] : blocks_) {
      world.objects.push_back(
          {"land/" + std::to_string(block[0]) + "_" + std::to_string(block[1]) + "_" + std::to_string(block[2]),
           geometry::MeshShape{mesh}, base::Transform{}, surface_.variants[static_cast<std::size_t>(block[2])], 1.0,
           true, SemanticClass::kGround});
    }
  }

 private:
  static constexpr int kBlock = 5;  // cells a side

  /// A fan about the corner that is farthest from the field over the cell's other border points, the field's own among
  /// them where they meet.
  void AddCell(Mesh& mesh, int i, int j, const Vec2& middle) {
    const std::array<std::array<int, 2>, 4> corners{{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
    std::size_t hub = 0;
    double farthest = -1.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec2 p = land_.around.Point(corners[k][0], corners[k][1]);
      const double away = Beyond(p, land_.half) + 1e-3 * p.norm();
      if (away > farthest) {
        farthest = away;
        hub = k;
      }
    }
    std::vector<std::uint32_t> ring;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& from = corners[(hub + k) % 4];
      const auto& to = corners[(hub + k + 1) % 4];
      ring.push_back(AddVertex(mesh, land_.around.Point(from[0], from[1]), middle));
      AddFieldPoints(mesh, from, to, middle, ring);
    }
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) mesh.triangles.push_back({ring[0], ring[k], ring[k + 1]});
  }

  /// The field's points strictly between two corners of a cell that both lie on its border line.
  void AddFieldPoints(Mesh& mesh, const std::array<int, 2>& from, const std::array<int, 2>& to, const Vec2& middle,
                      std::vector<std::uint32_t>& ring) {
    const Vec2 a = land_.around.Point(from[0], from[1]);
    const Vec2 b = land_.around.Point(to[0], to[1]);
    constexpr double kTouch = 1e-6;
    const bool on_border = Beyond(a, land_.half) < kTouch && Beyond(b, land_.half) < kTouch;
    if (!on_border) return;
    const int steps = static_cast<int>(std::lround((b - a).norm() / land_.field.cell));
    for (int n = 1; n < steps; ++n) ring.push_back(AddVertex(mesh, a + (b - a) * n / steps, middle));
  }

  std::uint32_t AddVertex(Mesh& mesh, const Vec2& p, const Vec2& middle) {
    const Vec2 uv = (p - middle) / surface_.period + Vec2::Constant(0.5 * (kLandCell / surface_.period - 1.0));
    const float z = static_cast<float>(land_.Height(p));
    const Vec2 q = (p - land_.around.low) / land_.around.cell;
    mesh.vertices.push_back({Eigen::Vector3f(static_cast<float>(p.x()), static_cast<float>(p.y()), z),
                             NormalNear(q).cast<float>(), uv.cast<float>()});
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  }

  /// By differences over a cell to each side.
  Vec3 NormalNear(const Vec2& q) const {
    const auto z = [&](double x, double y) {
      return HeightAt(land_.around, land_.around.low + land_.around.cell * Vec2(x, y));
    };
    const double dx = (z(q.x() + 1.0, q.y()) - z(q.x() - 1.0, q.y())) / (2.0 * land_.around.cell);
    const double dy = (z(q.x(), q.y() + 1.0) - z(q.x(), q.y() - 1.0)) / (2.0 * land_.around.cell);
    return Vec3(-dx, -dy, 1.0).normalized();
  }

  const Land& land_;
  const Surface& surface_;
  RandomStream& random_;
  std::map<std::array<int, 3>, std::shared_ptr<Mesh>> blocks_;
};

/// Where woods stand: smooth noise over the land.
class Woods {
 public:
  explicit Woods(RandomStream& random) {
    for (auto& wave : waves_) {
      const double angle = random.Uniform(0.0, 2.0 * kPi);
      wave = {2.0 * kPi / random.Uniform(35.0, 90.0) * Vec2(std::cos(angle), std::sin(angle)),
              random.Uniform(0.0, 2.0 * kPi)};
    }
  }
  /// In [0, 1], even about.
  double At(const Vec2& p) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += std::sin(wave.k.dot(p) + wave.phase);
    return std::clamp(0.5 + 0.5 * std::erf(sum / std::sqrt(static_cast<double>(waves_.size()))), 0.0, 1.0);
  }

 private:
  struct Wave {
    Vec2 k;
    double phase = 0.0;
  };
  std::array<Wave, 6> waves_;
};

}  // namespace

Land MakeLand(const LandConfig& config, const std::function<double(const Vec2&)>& shape, RandomStream& random) {
  Land land;
  land.half = config.half;
  const double reach = kLandCell * std::round(config.reach / kLandCell);
  land.around = Lattice(config.half + Vec2::Constant(reach), kLandCell);
  AddHills(land.around, config.swell, random);
  HeightField hills = land.around;
  std::fill(hills.z.begin(), hills.z.end(), 0.0F);
  AddHills(hills, {.height = 0.28 * config.hills, .wavelength = 55.0, .octaves = 2}, random);
  ForEachPoint(land.around, [&](float& z, const Vec2& p) {
    const double rise = Smooth(0.12 * reach, 0.85 * reach, Beyond(p, config.half));
    const double crest = std::max(0.35 * config.hills, config.hills + HeightAt(hills, p));
    z += static_cast<float>(rise * crest);
    if (shape) z += static_cast<float>(shape(p));
  });
  land.field = Lattice(config.half, config.cell);
  AddHills(land.field, config.relief, random);
  ForEachPoint(land.field, [&](float& z, const Vec2& p) {
    const double inside = (config.half - p.cwiseAbs()).minCoeff();
    const double within = Smooth(0.0, 5.0, inside);  // at the border it is the land's own straight edges
    const double base = HeightAt(land.around, p);
    z = static_cast<float>(base + within * (SmoothHeightAt(land.around, p) - base + static_cast<double>(z)));
  });
  return land;
}

void AddLand(World& world, const Land& land, const Surface& field, const Surface& around, RandomStream& random) {
  AddTerrain(world, "ground", land.field, field, random);
  LandMesh(land, around, random).Build(world);
}

void AddTreeLine(World& world, const Land& land, const TreeLineConfig& config, std::uint64_t seed) {
  RandomStream random(seed, "world/treeline");
  const Palette broad{{0.12F, 0.17F, 0.08F}, {0.56F, 0.66F, 0.33F}};
  const Palette needles{{0.09F, 0.13F, 0.08F}, {0.42F, 0.52F, 0.34F}};
  const std::array<int, 2> looks{
      AddFoliageMaterial(world, "treeline/broadleaf", {.kind = Foliage::kTree, .leaves = broad, .size = 128}, seed),
      AddFoliageMaterial(world, "treeline/conifer", {.kind = Foliage::kFir, .leaves = needles, .size = 128}, seed)};
  const Woods woods(random);
  constexpr int kSectors = 16;
  constexpr double kRim = 0.12;  // of the woods' share
  std::array<std::array<std::shared_ptr<Mesh>, kSectors>, 2> meshes;
  for (auto& kind : meshes) {
    for (auto& mesh : kind) mesh = std::make_shared<Mesh>();
  }
  const Vec2 far = -land.around.low;
  for (double y = -far.y(); y < far.y(); y += config.spacing) {
    for (double x = -far.x(); x < far.x(); x += config.spacing) {
      const Vec2 p(x + config.spacing * random.Uniform(), y + config.spacing * random.Uniform());
      const bool conifer = random.Uniform() < config.conifer_share;
      const double height = random.Uniform(config.height_min, config.height_max);
      const double yaw = random.Uniform(0.0, kPi);
      const double beyond = Beyond(p, land.half);
      // Woods thin out towards their rim, and stand densest on the crest, which hides the land's end.
      const double share = woods.At(p) + 0.5 * Smooth(0.55, 0.95, beyond / (far - land.half).minCoeff());
      const bool out = (p.cwiseAbs() - far).maxCoeff() > -1.0;
      // Within a wood one tree in two would be seen of no one: those before it stand close.
      const bool within = share > 1.0 - config.woods + kRim && random.Uniform() < 0.5;
      if (beyond < config.nearest || out || share < 1.0 - config.woods || within) continue;
      const int sector = static_cast<int>((std::atan2(p.y(), p.x()) / (2.0 * kPi) + 0.5) * kSectors) % kSectors;
      AddCrossedCards(*meshes[conifer ? 1 : 0][static_cast<std::size_t>(sector)], land.On(p) - Vec3(0.0, 0.0, 0.3),
                      (conifer ? 0.62 : 0.85) * height, height, yaw);
    }
  }
  for (std::size_t kind = 0; kind < 2; ++kind) {
    for (std::size_t sector = 0; sector < kSectors; ++sector) {
      AddCards(world, "treeline/" + std::to_string(kind) + "_" + std::to_string(sector), meshes[kind][sector],
               looks[kind], SemanticClass::kTree);
    }
  }
}

void AddPadOn(World& world, Land& land, int material, const Vec2& p, double radius, double yaw) {
  const double z = HeightAt(land.field, p);
  Level(land.field, p, radius + 0.8, 2.5, z);
  AddPad(world, material, p, radius);
  world.objects.back().X_WO.p.z() += z;
  world.X_WB_start = {base::FromYaw(yaw), {p.x(), p.y(), z + kPadHeight}};
}

}  // namespace alula::worlds

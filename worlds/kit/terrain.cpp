#include "worlds/kit/terrain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/error.h"

namespace alula::worlds {
namespace {

using base::Vec2;
using base::Vec3;

double Fade(double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); }
double Mix(double a, double b, double t) { return a + t * (b - a); }

/// Gradient noise over a lattice of unit vectors (Perlin 1985, fade of Perlin 2002); deviation about 0.25.
class GradientNoise {
 public:
  explicit GradientNoise(base::RandomStream& random) {
    for (Vec2& g : gradients_) {
      const double angle = random.Uniform(0.0, 2.0 * std::numbers::pi);
      g = {std::cos(angle), std::sin(angle)};
    }
    offset_ = {random.Uniform(0.0, kSide), random.Uniform(0.0, kSide)};
  }

  double At(const Vec2& p) const {
    const Vec2 q = p + offset_;
    const int i = static_cast<int>(std::floor(q.x()));
    const int j = static_cast<int>(std::floor(q.y()));
    const double x = q.x() - i;
    const double y = q.y() - j;
    const auto corner = [&](int a, int b) { return Gradient(i + a, j + b).dot(Vec2(x - a, y - b)); };
    const double u = Fade(x);
    return Mix(Mix(corner(0, 0), corner(1, 0), u), Mix(corner(0, 1), corner(1, 1), u), Fade(y));
  }

 private:
  static constexpr int kSide = 64;  // cells until it repeats
  const Vec2& Gradient(int i, int j) const {
    return gradients_[static_cast<std::size_t>((j & (kSide - 1)) * kSide + (i & (kSide - 1)))];
  }
  std::array<Vec2, kSide * kSide> gradients_;
  Vec2 offset_;
};

/// Cell that holds p, and where in it, both in [0, 1].
struct Place {
  int i, j;
  double x, y;
};
Place PlaceOf(const HeightField& field, const Vec2& p) {
  const Vec2 q = (p - field.low) / field.cell;
  const int i = std::clamp(static_cast<int>(std::floor(q.x())), 0, field.columns - 2);
  const int j = std::clamp(static_cast<int>(std::floor(q.y())), 0, field.rows - 2);
  return {i, j, std::clamp(q.x() - i, 0.0, 1.0), std::clamp(q.y() - j, 0.0, 1.0)};
}

/// Slopes of the triangle at a place, per cell.
Vec2 SlopeAt(const HeightField& field, const Place& at) {
  const double z00 = field.At(at.i, at.j);
  const double z10 = field.At(at.i + 1, at.j);
  const double z01 = field.At(at.i, at.j + 1);
  const double z11 = field.At(at.i + 1, at.j + 1);
  return at.x >= at.y ? Vec2(z10 - z00, z11 - z10) : Vec2(z11 - z01, z01 - z00);
}

/// Normal at a point of the lattice by central differences: what the renderer interpolates.
Vec3 PointNormal(const HeightField& field, int i, int j) {
  const int i0 = std::max(i - 1, 0);
  const int i1 = std::min(i + 1, field.columns - 1);
  const int j0 = std::max(j - 1, 0);
  const int j1 = std::min(j + 1, field.rows - 1);
  const double dx = (field.At(i1, j) - field.At(i0, j)) / ((i1 - i0) * field.cell);
  const double dy = (field.At(i, j1) - field.At(i, j0)) / ((j1 - j0) * field.cell);
  return Vec3(-dx, -dy, 1.0).normalized();
}

/// Points [i0, i1] × [j0, j1] as a mesh whose texture is 0 in the tile's middle and ±½ at the sides of a whole tile.
std::shared_ptr<const geometry::Mesh> TileMesh(const HeightField& field, int i0, int i1, int j0, int j1, int per_tile) {
  auto mesh = std::make_shared<geometry::Mesh>();
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      const Vec2 p = field.Point(i, j);
      const Eigen::Vector2f uv(static_cast<float>(i - i0) / static_cast<float>(per_tile) - 0.5F,
                               static_cast<float>(j - j0) / static_cast<float>(per_tile) - 0.5F);
      mesh->vertices.push_back({Eigen::Vector3f(static_cast<float>(p.x()), static_cast<float>(p.y()), field.At(i, j)),
                                PointNormal(field, i, j).cast<float>(), uv});
    }
  }
  const auto width = static_cast<std::uint32_t>(i1 - i0 + 1);
  for (std::uint32_t j = 0; j + 1 < static_cast<std::uint32_t>(j1 - j0 + 1); ++j) {
    for (std::uint32_t i = 0; i + 1 < width; ++i) {
      const std::uint32_t a = j * width + i;
      mesh->triangles.push_back({a, a + 1, a + width + 1});
      mesh->triangles.push_back({a, a + width + 1, a + width});
    }
  }
  return mesh;
}

}  // namespace

HeightField FlatField(double side, double cell) {
  HeightField field;
  const int cells = std::max(1, static_cast<int>(std::lround(side / cell)));
  field.cell = cell;
  field.low = Vec2::Constant(-0.5 * cells * cell);
  field.columns = field.rows = cells + 1;
  field.z.assign(static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows), 0.0F);
  return field;
}

void AddHills(HeightField& field, const HillsConfig& config, base::RandomStream& random) {
  constexpr double kDeviation = 0.25;  // of gradient noise
  double squares = 0.0;
  for (int octave = 0; octave < config.octaves; ++octave) squares += std::pow(config.persistence, 2 * octave);
  double height = config.height / (kDeviation * std::sqrt(squares));
  double wavelength = config.wavelength;
  for (int octave = 0; octave < config.octaves; ++octave) {
    const auto noise = std::make_unique<GradientNoise>(random);
    for (int j = 0; j < field.rows; ++j) {
      for (int i = 0; i < field.columns; ++i) {
        field.At(i, j) += static_cast<float>(height * noise->At(field.Point(i, j) / wavelength));
      }
    }
    height *= config.persistence;
    wavelength *= 0.5;
  }
}

void Level(HeightField& field, const Vec2& p, double radius, double rim, double z) {
  for (int j = 0; j < field.rows; ++j) {
    for (int i = 0; i < field.columns; ++i) {
      const double away = std::clamp(((field.Point(i, j) - p).norm() - radius) / rim, 0.0, 1.0);
      float& height = field.At(i, j);
      height = static_cast<float>(Mix(z, height, Fade(away)));
    }
  }
}

double HeightAt(const HeightField& field, const Vec2& p) {
  const Place at = PlaceOf(field, p);
  const Vec2 slope = SlopeAt(field, at);
  return field.At(at.i, at.j) + slope.dot(Vec2(at.x, at.y));
}

Vec3 NormalAt(const HeightField& field, const Vec2& p) {
  const Vec2 slope = SlopeAt(field, PlaceOf(field, p)) / field.cell;
  return Vec3(-slope.x(), -slope.y(), 1.0).normalized();
}

void AddTerrain(World& world, const std::string& name, const HeightField& field, const Surface& surface,
                base::RandomStream& random) {
  const int per_tile = static_cast<int>(std::lround(surface.period / field.cell));
  if (per_tile < 1 || std::abs(per_tile * field.cell - surface.period) > 1e-9) {
    throw base::FaultError("world_setup", "the period of " + name + " is no multiple of its field's cell");
  }
  for (int j = 0; j + 1 < field.rows; j += per_tile) {
    for (int i = 0; i + 1 < field.columns; i += per_tile) {
      const int material = surface.variants[random.Index(surface.variants.size())];
      const auto mesh = TileMesh(field, i, std::min(i + per_tile, field.columns - 1), j,
                                 std::min(j + per_tile, field.rows - 1), per_tile);
      world.objects.push_back({name + "/" + std::to_string(i / per_tile) + "_" + std::to_string(j / per_tile),
                               geometry::MeshShape{mesh}, base::Transform{}, material, 1.0, true,
                               SemanticClass::kGround});
    }
  }
}

}  // namespace alula::worlds

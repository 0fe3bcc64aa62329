#include "worlds/actors/body_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "base/random.h"

namespace alula::worlds {
namespace {

using base::Vec3;
using geometry::Mesh;

constexpr int kCorners = 10;

void AddQuad(Mesh& mesh, const std::array<Vec3, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  const Vec3 u = (corners[1] - corners[0]).normalized();
  const Vec3 v = normal.cross(u);
  for (const Vec3& p : corners) {
    mesh.vertices.push_back({p.cast<float>(), normal.cast<float>(), Eigen::Vector2d(u.dot(p), v.dot(p)).cast<float>()});
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

std::uint8_t Byte(float value) { return static_cast<std::uint8_t>(std::clamp(255.0F * value + 0.5F, 0.0F, 255.0F)); }

}  // namespace

geometry::MeshShape TurnedBody(const std::vector<Ring>& rings, double x, double y, double period) {
  auto mesh = std::make_shared<Mesh>();
  double widest = 0.0;
  for (const Ring& ring : rings) widest = std::max(widest, ring.radius);
  const double around = std::numbers::pi * widest * (x + y) / period;  // texture periods
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const Ring& before = rings[r == 0 ? 0 : r - 1];
    const Ring& after = rings[std::min(r + 1, rings.size() - 1)];
    const double rise = after.z - before.z;
    const double widen = after.radius - before.radius;
    for (int i = 0; i <= kCorners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kCorners;
      const double c = std::cos(angle);
      const double s = std::sin(angle);
      const Vec3 p(x * rings[r].radius * c, y * rings[r].radius * s, rings[r].z);
      // Normal of the ellipse's rim, tilted as the profile runs.
      Vec3 normal(rise * c / x, rise * s / y, -widen);
      if (rings[r].radius == 0.0) normal = Vec3(0.0, 0.0, r == 0 ? -1.0 : 1.0);
      mesh->vertices.push_back({p.cast<float>(), normal.normalized().cast<float>(),
                                Eigen::Vector2d(around * i / kCorners, rings[r].z / period).cast<float>()});
    }
  }
  const std::uint32_t row = kCorners + 1;
  for (std::uint32_t r = 0; r + 1 < rings.size(); ++r) {
    for (std::uint32_t i = 0; i < kCorners; ++i) {
      const std::uint32_t a = r * row + i;
      if (rings[r].radius > 0.0) mesh->triangles.push_back({a, a + 1, a + row + 1});
      if (rings[r + 1].radius > 0.0) mesh->triangles.push_back({a, a + row + 1, a + row});
    }
  }
  return {mesh};
}

geometry::MeshShape Limb(double length, double radius_above, double radius_below, double period) {
  return TurnedBody({{-length - radius_below, 0.0},
                     {-length - 0.6 * radius_below, 0.75 * radius_below},
                     {-length, radius_below},
                     {0.0, radius_above},
                     {0.6 * radius_above, 0.75 * radius_above},
                     {radius_above, 0.0}},
                    1.0, 1.0, period);
}

geometry::MeshShape Ellipsoid(const Vec3& radii, double period) {
  constexpr int kRings = 6;
  std::vector<Ring> rings;
  for (int i = 0; i <= kRings; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / kRings - 0.5);
    const bool pole = i == 0 || i == kRings;
    rings.push_back({radii.z() * std::sin(angle), pole ? 0.0 : std::cos(angle)});
  }
  return TurnedBody(rings, radii.x(), radii.y(), period);
}

geometry::MeshShape Frustum(const base::Vec2& below, const base::Vec2& above, double half_height, double back) {
  auto mesh = std::make_shared<Mesh>();
  const auto corner = [&](bool top, double sx, double sy) {
    const base::Vec2& half = top ? above : below;
    return Vec3(sx * half.x() - (top ? back : 0.0), sy * half.y(), top ? half_height : -half_height);
  };
  AddQuad(*mesh, {corner(true, -1, -1), corner(true, 1, -1), corner(true, 1, 1), corner(true, -1, 1)});
  AddQuad(*mesh, {corner(false, -1, 1), corner(false, 1, 1), corner(false, 1, -1), corner(false, -1, -1)});
  AddQuad(*mesh, {corner(false, 1, -1), corner(false, 1, 1), corner(true, 1, 1), corner(true, 1, -1)});
  AddQuad(*mesh, {corner(false, -1, 1), corner(false, -1, -1), corner(true, -1, -1), corner(true, -1, 1)});
  AddQuad(*mesh, {corner(false, 1, 1), corner(false, -1, 1), corner(true, -1, 1), corner(true, 1, 1)});
  AddQuad(*mesh, {corner(false, -1, -1), corner(false, 1, -1), corner(true, 1, -1), corner(true, -1, -1)});
  return {mesh};
}

std::shared_ptr<const geometry::Texture> MakeCloth(Cloth cloth, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                                   int size, std::uint64_t seed, std::string_view name) {
  base::RandomStream random(seed, "world/texture/" + std::string(name));
  auto texture = std::make_shared<geometry::Texture>();
  texture->width = texture->height = size;
  const int stripe = size >> (2 + static_cast<int>(random.Index(2)));
  for (int v = 0; v < size; ++v) {
    for (int u = 0; u < size; ++u) {
      const bool across = v / stripe % 2 == 0;
      const bool along = u / stripe % 2 == 0;
      float share = 0.0F;  // of b
      if (cloth == Cloth::kStripes) share = across ? 1.0F : 0.0F;
      if (cloth == Cloth::kChecks) share = 0.5F * static_cast<float>(across) + 0.5F * static_cast<float>(along);
      if (cloth == Cloth::kSpeckled) share = random.Uniform() < 0.25 ? 1.0F : 0.0F;
      const auto weave = static_cast<float>(1.0 + random.Uniform(-0.12, 0.12));
      const Eigen::Vector3f colour = weave * ((1.0F - share) * a + share * b);
      for (int c = 0; c < 3; ++c) texture->rgb.push_back(Byte(colour[c]));
    }
  }
  return texture;
}

}  // namespace alula::worlds

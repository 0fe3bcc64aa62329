#include "worlds/check_start.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "base/error.h"

namespace alula::worlds {
namespace {

using base::Vec2;
using base::Vec3;

/// Height of the object's highest surface below `z` (0.5 mm above it counts) on the upright line through p.
std::optional<double> SurfaceBelow(const Object& object, const Vec2& p, double z) {
  const geometry::Mesh mesh = geometry::Tessellate(object.shape);
  std::optional<double> best;
  const auto at = [&](std::uint32_t i) { return Vec3(object.X_WO * Vec3(mesh.vertices[i].position.cast<double>())); };
  for (const auto& t : mesh.triangles) {
    const Vec3 a = at(t[0]);
    const Vec2 ab = (at(t[1]) - a).head<2>();
    const Vec2 ac = (at(t[2]) - a).head<2>();
    const double area = ab.x() * ac.y() - ab.y() * ac.x();
    if (std::abs(area) < 1e-12) continue;
    const Vec2 d = p - a.head<2>();
    const double v = (d.x() * ac.y() - d.y() * ac.x()) / area;
    const double w = (ab.x() * d.y() - ab.y() * d.x()) / area;
    constexpr double kRim = -1e-9;  // so that a point on the border between two triangles lies on one of them
    if (v < kRim || w < kRim || v + w > 1.0 - kRim) continue;
    const double height = a.z() + v * (at(t[1]) - a).z() + w * (at(t[2]) - a).z();
    if (height <= z + 5e-4 && (!best || height > *best)) best = height;
  }
  return best;
}

}  // namespace

void CheckStart(const World& world) {
  constexpr double kGap = 0.05;  // m
  const Vec3& start = world.X_WB_start.p;
  std::optional<double> surface;  // the highest below the start
  bool ground = false;            // and something that is not the pad
  for (const Object& object : world.objects) {
    if (!object.collides) continue;
    const std::optional<double> height = SurfaceBelow(object, start.head<2>(), start.z());
    if (!height) continue;
    if (!surface || *height > *surface) surface = height;
    ground = ground || object.name != world.pad_object;
  }
  if (ground && start.z() - *surface <= kGap) return;
  char text[160];
  if (ground) {
    std::snprintf(text, sizeof text,
                  "the start at (%.2f, %.2f, %.2f) m hangs %.2f m above the ground; move it down or the ground up",
                  start.x(), start.y(), start.z(), start.z() - *surface);
  } else {
    std::snprintf(text, sizeof text,
                  "there is no ground under the start at (%.2f, %.2f, %.2f) m; move it, or make the ground larger",
                  start.x(), start.y(), start.z());
  }
  throw base::InputError("world: " + std::string(text));
}

}  // namespace alula::worlds

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "geometry/shape.h"

namespace alula::geometry {
namespace {

using base::Vec2;
using base::Vec3;

constexpr double kPi = std::numbers::pi;

/// Collects vertices in double precision and rounds once, so that shared corners are equal to the bit.
struct Builder {
  Mesh mesh;
  double texture_scale;

  std::uint32_t Add(const Vec3& position, const Vec3& normal, const Vec2& metres) {
    mesh.vertices.push_back({position.cast<float>(), normal.cast<float>(), (metres / texture_scale).cast<float>()});
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  }
  void Triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { mesh.triangles.push_back({a, b, c}); }
};

/// One corner of a profile that is turned about z: radius and height, and the outward normal there.
struct ProfilePoint {
  double radius;
  double z;
  Vec2 normal;    // (radial, z)
  double length;  // along the profile from its start, m: the texture's v
};

Vec2 Direction(int i, int segments) {
  const double angle = 2.0 * kPi * (i % segments) / segments;  // the seam's two columns are equal to the bit
  return {std::cos(angle), std::sin(angle)};
}

/// Turns a profile that runs from bottom to top about z. `girth`: radius by which the texture is unrolled.
void Lathe(Builder& builder, const std::vector<ProfilePoint>& profile, int segments, double girth) {
  const auto first = static_cast<std::uint32_t>(builder.mesh.vertices.size());
  const auto columns = static_cast<std::uint32_t>(segments + 1);
  for (const ProfilePoint& p : profile) {
    for (int i = 0; i <= segments; ++i) {
      const Vec2 d = Direction(i, segments);
      builder.Add({p.radius * d.x(), p.radius * d.y(), p.z}, {p.normal.x() * d.x(), p.normal.x() * d.y(), p.normal.y()},
                  {2.0 * kPi * girth * i / segments, p.length});
    }
  }
  for (std::uint32_t row = 0; row + 1 < profile.size(); ++row) {
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      const std::uint32_t a = first + row * columns + i;
      const std::uint32_t b = a + 1;
      const std::uint32_t c = a + columns;
      if (profile[row].radius > 0.0) builder.Triangle(a, b, c + 1);
      if (profile[row + 1].radius > 0.0) builder.Triangle(a, c + 1, c);
    }
  }
}

/// A flat disc at height z that looks up or down.
void Cap(Builder& builder, double radius, double z, bool up, int segments) {
  const Vec3 normal(0.0, 0.0, up ? 1.0 : -1.0);
  const std::uint32_t centre = builder.Add({0.0, 0.0, z}, normal, Vec2::Zero());
  for (int i = 0; i <= segments; ++i) {
    const Vec2 d = radius * Direction(i, segments);
    builder.Add({d.x(), d.y(), z}, normal, {up ? d.x() : -d.x(), d.y()});
  }
  for (int i = 1; i <= segments; ++i) {
    const std::uint32_t a = centre + static_cast<std::uint32_t>(i);
    up ? builder.Triangle(centre, a, a + 1) : builder.Triangle(centre, a + 1, a);
  }
}

/// A quarter circle about (0, z) from `from` to `to` (rad, elevation), appended to a profile.
void AppendArc(std::vector<ProfilePoint>& profile, double radius, double z, double from, double to, int steps) {
  const double start = profile.empty() ? 0.0 : profile.back().length;
  for (int i = 0; i <= steps; ++i) {
    const double elevation = from + (to - from) * i / steps;
    const bool pole = (i == 0 && from <= -0.5 * kPi) || (i == steps && to >= 0.5 * kPi);
    const Vec2 normal(pole ? 0.0 : std::cos(elevation), std::sin(elevation));
    profile.push_back(
        {pole ? 0.0 : radius * normal.x(), z + radius * normal.y(), normal, start + radius * (elevation - from)});
  }
}

void Append(Builder& builder, const Box& box, int) {
  const Vec3& h = box.half_extents;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      // (u, v, n) is right-handed, so that u → v turns counter-clockwise seen from outside. v is up on upright faces.
      Vec3 n = Vec3::Zero();
      n[axis] = side;
      const Vec3 v = axis == 2 ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitZ());
      const Vec3 u = v.cross(n);
      // Each face shows another part of the texture, so that turning a box changes its looks.
      const Vec2 offset = Vec2(0.37, 0.23) * ((2 * axis + (side > 0 ? 1 : 0)) * builder.texture_scale);
      std::uint32_t corner[4];
      const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
      for (int i = 0; i < 4; ++i) {
        const Vec3 p = (n + signs[i][0] * u + signs[i][1] * v).cwiseProduct(h);
        corner[i] = builder.Add(p, n, Vec2(p.dot(u), p.dot(v)) + offset);
      }
      builder.Triangle(corner[0], corner[1], corner[2]);
      builder.Triangle(corner[0], corner[2], corner[3]);
    }
  }
}

void Append(Builder& builder, const Sphere& sphere, int segments) {
  std::vector<ProfilePoint> profile;
  AppendArc(profile, sphere.radius, 0.0, -0.5 * kPi, 0.5 * kPi, std::max(2, segments / 2));
  Lathe(builder, profile, segments, sphere.radius);
}

void Append(Builder& builder, const Cylinder& c, int segments) {
  const double h = c.half_height;
  Lathe(builder, {{c.radius, -h, {1.0, 0.0}, 0.0}, {c.radius, h, {1.0, 0.0}, 2.0 * h}}, segments, c.radius);
  Cap(builder, c.radius, -h, false, segments);
  Cap(builder, c.radius, h, true, segments);
}

void Append(Builder& builder, const Capsule& c, int segments) {
  const int steps = std::max(1, segments / 4);
  std::vector<ProfilePoint> profile;
  AppendArc(profile, c.radius, -c.half_height, -0.5 * kPi, 0.0, steps);
  const double straight = profile.back().length + 2.0 * c.half_height;
  if (c.half_height <= 0.0) profile.pop_back();  // a sphere: no straight part
  const std::size_t lower = profile.size();
  AppendArc(profile, c.radius, c.half_height, 0.0, 0.5 * kPi, steps);
  for (std::size_t i = lower; i < profile.size(); ++i) {
    profile[i].length = straight + c.radius * 0.5 * kPi * static_cast<double>(i - lower) / steps;
  }
  Lathe(builder, profile, segments, c.radius);
}

void Append(Builder& builder, const Cone& c, int segments) {
  const double slant = std::hypot(c.radius, 2.0 * c.half_height);
  const Vec2 normal(2.0 * c.half_height / slant, c.radius / slant);
  Lathe(builder, {{c.radius, -c.half_height, normal, 0.0}, {0.0, c.half_height, normal, slant}}, segments, c.radius);
  Cap(builder, c.radius, -c.half_height, false, segments);
}

}  // namespace

Mesh Tessellate(const Shape& shape, double texture_scale, int segments) {
  if (texture_scale <= 0.0 || segments < 3) {
    throw base::FaultError("tessellation", "a texture scale must be positive and a circle has at least 3 segments");
  }
  if (const auto* mesh = std::get_if<MeshShape>(&shape)) return *mesh->mesh;  // has coordinates of its own
  Builder builder{{}, texture_scale};
  std::visit(
      [&](const auto& solid) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(solid)>, MeshShape>) Append(builder, solid, segments);
      },
      shape);
  return std::move(builder.mesh);
}

}  // namespace alula::geometry

#include "worlds/kit/mesh_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace alula::worlds {
namespace {

using base::Vec2;
using base::Vec3;
using geometry::Mesh;

constexpr double kPi = std::numbers::pi;

std::uint32_t AddVertex(Mesh& mesh, const Vec3& p, const Vec3& n, const Vec2& uv) {
  mesh.vertices.push_back({p.cast<float>(), n.cast<float>(), uv.cast<float>()});
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

/// Any unit vector square to `along`, as upright as can be.
Vec3 UprightAcross(const Vec3& along) {
  const Vec3 up = std::abs(along.z()) < 0.98 ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitX());
  return (up - up.dot(along) * along).normalized();
}

void Side(Mesh& mesh, const std::array<Vec3, 4>& corners, const std::array<Vec3, 4>& normals, bool front) {
  // A little inside, for the texture repeats: what touches one side must not show at the other.
  static constexpr double kUv[4][2] = {{0.01, 0.01}, {0.99, 0.01}, {0.99, 0.99}, {0.01, 0.99}};
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::size_t i = 0; i < 4; ++i) AddVertex(mesh, corners[i], normals[i], {kUv[i][0], kUv[i][1]});
  const std::uint32_t left = front ? 1 : 3;
  mesh.triangles.push_back({first, first + left, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 4 - left});
}

}  // namespace

void AddQuad(Mesh& mesh, const std::array<Vec3, 4>& c, double texture_scale) {
  const Vec3 normal = (c[1] - c[0]).cross(c[3] - c[0]).normalized();
  const double width = (c[1] - c[0]).norm() / texture_scale;
  const double height = (c[3] - c[0]).norm() / texture_scale;
  const std::uint32_t first = AddVertex(mesh, c[0], normal, {0.0, 0.0});
  AddVertex(mesh, c[1], normal, {width, 0.0});
  AddVertex(mesh, c[2], normal, {width, height});
  AddVertex(mesh, c[3], normal, {0.0, height});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

void AddBoxPart(Mesh& mesh, const Vec3& size, const base::Transform& X, double texture_scale) {
  const Vec3 half = 0.5 * size;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 n = Vec3::Zero();
      n[axis] = side;
      const Vec3 up = axis == 2 ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitZ());
      const Vec3 right = up.cross(n);
      const auto corner = [&](double x, double y) { return X * Vec3((n + x * right + y * up).cwiseProduct(half)); };
      AddQuad(mesh, {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}, texture_scale);
    }
  }
}

void AddBeam(Mesh& mesh, const Vec3& a, const Vec3& b, double width, double depth, double texture_scale) {
  const Vec3 x = (b - a).normalized();
  const Vec3 z = UprightAcross(x);
  base::Mat3 R;
  R << x, z.cross(x), z;
  AddBoxPart(mesh, {(b - a).norm(), width, depth}, {base::Quat(R), 0.5 * (a + b)}, texture_scale);
}

void AddCard(Mesh& mesh, const Vec3& middle, const Vec3& right, const Vec3& up, const std::array<Vec3, 4>& normals) {
  const std::array<Vec3, 4> corners{middle - right - up, middle + right - up, middle + right + up, middle - right + up};
  Side(mesh, corners, normals, true);
  Side(mesh, corners, normals, false);
}

void AddSheet(Mesh& mesh, const Vec3& middle, const Vec3& right, const Vec3& up) {
  const std::array<Vec3, 4> corners{middle - right - up, middle + right - up, middle + right + up, middle - right + up};
  const Vec3 n = right.cross(up).normalized();
  Side(mesh, corners, {n, n, n, n}, true);
  Side(mesh, corners, {-n, -n, -n, -n}, false);
}

void AddTube(Mesh& mesh, std::span<const TubePoint> line, int sides, double texture_scale) {
  const auto columns = static_cast<std::uint32_t>(sides + 1);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  Vec3 across = UprightAcross((line[1].p - line[0].p).normalized());
  double length = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec3 before = i > 0 ? (line[i].p - line[i - 1].p).normalized() : Vec3(Vec3::Zero());
    const Vec3 after = i + 1 < line.size() ? (line[i + 1].p - line[i].p).normalized() : Vec3(Vec3::Zero());
    const Vec3 along = (before + after).normalized();
    across = (across - across.dot(along) * along).normalized();  // carried along without twist
    const Vec3 other = along.cross(across);
    if (i > 0) length += (line[i].p - line[i - 1].p).norm();
    for (int k = 0; k <= sides; ++k) {
      const double angle = 2.0 * kPi * (k % sides) / sides;
      const Vec3 n = std::cos(angle) * across + std::sin(angle) * other;
      const double girth = 2.0 * kPi * line[0].radius * k / sides;
      AddVertex(mesh, line[i].p + line[i].radius * n, n, Vec2(girth, length) / texture_scale);
    }
  }
  for (std::uint32_t row = 0; row + 1 < line.size(); ++row) {
    for (std::uint32_t k = 0; k + 1 < columns; ++k) {
      const std::uint32_t a = first + row * columns + k;
      mesh.triangles.push_back({a, a + 1, a + 1 + columns});
      mesh.triangles.push_back({a, a + 1 + columns, a + columns});
    }
  }
  for (const bool end : {false, true}) {
    const std::uint32_t ring = first + (end ? static_cast<std::uint32_t>(line.size() - 1) * columns : 0);
    for (std::uint32_t k = 1; k + 2 < columns; ++k) {
      end ? mesh.triangles.push_back({ring, ring + k, ring + k + 1})
          : mesh.triangles.push_back({ring, ring + k + 1, ring + k});
    }
  }
}

void AddLathe(Mesh& mesh, std::span<const Vec2> profile, int segments, const base::Transform& X, double texture_scale) {
  const auto columns = static_cast<std::uint32_t>(segments + 1);
  double widest = 0.0;
  for (const Vec2& p : profile) widest = std::max(widest, p.x());
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {  // a band each: edges of the profile stay sharp
    const Vec2 along = profile[i + 1] - profile[i];
    const Vec2 n = Vec2(along.y(), -along.x()).normalized();  // outwards for a profile that runs upwards
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t end = i; end < i + 2; ++end) {
      const Vec2& p = profile[end];
      const double at = length + (end > i ? along.norm() : 0.0);
      for (int k = 0; k <= segments; ++k) {
        const double angle = 2.0 * kPi * (k % segments) / segments;
        const double x = std::cos(angle);
        const double y = std::sin(angle);
        AddVertex(mesh, X * Vec3(p.x() * x, p.x() * y, p.y()), X.q * Vec3(n.x() * x, n.x() * y, n.y()),
                  Vec2(2.0 * kPi * widest * k / segments, at) / texture_scale);
      }
    }
    for (std::uint32_t k = 0; k + 1 < columns; ++k) {
      const std::uint32_t a = first + k;
      if (profile[i].x() > 0.0) mesh.triangles.push_back({a, a + 1, a + 1 + columns});
      if (profile[i + 1].x() > 0.0) mesh.triangles.push_back({a, a + 1 + columns, a + columns});
    }
    length += along.norm();
  }
}

void AddPrism(Mesh& mesh, std::span<const Vec2> outline, double length, const base::Transform& X,
              double texture_scale) {
  const double half = 0.5 * length;
  const std::size_t count = outline.size();
  const auto at = [&](std::size_t i, double y) { return X * Vec3(outline[i % count].x(), y, outline[i % count].y()); };
  for (std::size_t i = 0; i < count; ++i) {
    AddQuad(mesh, {at(i, -half), at(i, half), at(i + 1, half), at(i + 1, -half)}, texture_scale);
  }
  for (const double side : {-1.0, 1.0}) {
    const Vec3 n = X.q * Vec3(0.0, side, 0.0);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t i = 0; i < count; ++i) AddVertex(mesh, at(i, side * half), n, outline[i] / texture_scale);
    for (std::uint32_t i = 1; i + 1 < count; ++i) {
      side < 0.0 ? mesh.triangles.push_back({first, first + i, first + i + 1})
                 : mesh.triangles.push_back({first, first + i + 1, first + i});
    }
  }
}

void AddRingSector(Mesh& mesh, const RingSector& s, const base::Transform& X, double texture_scale) {
  const double turn = s.a1 - s.a0;
  const int steps = std::max(1, static_cast<int>(std::ceil(turn / (2.0 * kPi) * 48.0)));
  const bool whole = turn > 2.0 * kPi - 1e-6;
  const auto at = [&](double r, int i, double z) {
    const double angle = whole && i == steps ? s.a0 : s.a0 + turn * i / steps;
    return X * Vec3(r * std::cos(angle), r * std::sin(angle), z);
  };
  // By plan coordinates on top, by arc length on the walls.
  const auto face = [&](const std::array<Vec3, 4>& c, const std::array<Vec2, 4>& metres) {
    const Vec3 n = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t k = 0; k < 4; ++k) AddVertex(mesh, c[k], n, metres[k] / texture_scale);
    mesh.triangles.push_back({first, first + 1, first + 2});
    if ((c[3] - c[0]).norm() > 1e-9) mesh.triangles.push_back({first, first + 2, first + 3});
  };
  const base::Transform X_back = X.Inverse();
  const auto plan = [&](const Vec3& p) { return Vec2((X_back * p).head<2>()); };
  for (int i = 0; i < steps; ++i) {
    const auto top =
        std::array<Vec3, 4>{at(s.r0, i, s.z1), at(s.r1, i, s.z1), at(s.r1, i + 1, s.z1), at(s.r0, i + 1, s.z1)};
    face(top, {plan(top[0]), plan(top[1]), plan(top[2]), plan(top[3])});
    const double arc = turn / steps;
    const auto wall = [&](double r, int from, int to) {
      const double a = r * arc * from;
      const double b = r * arc * to;
      face({at(r, from, s.z0), at(r, to, s.z0), at(r, to, s.z1), at(r, from, s.z1)},
           {Vec2(a, s.z0), Vec2(b, s.z0), Vec2(b, s.z1), Vec2(a, s.z1)});
    };
    wall(s.r1, i, i + 1);
    if (s.r0 > 0.0) wall(s.r0, i + 1, i);
  }
  if (whole) return;
  for (const bool end : {false, true}) {
    const int i = end ? steps : 0;
    const std::array<Vec3, 4> out{at(s.r0, i, s.z0), at(s.r1, i, s.z0), at(s.r1, i, s.z1), at(s.r0, i, s.z1)};
    end ? AddQuad(mesh, {out[1], out[0], out[3], out[2]}, texture_scale) : AddQuad(mesh, out, texture_scale);
  }
}

std::shared_ptr<const Mesh> MakeBoulder(const Vec3& size, double rough, double texture_scale,
                                        base::RandomStream& random) {
  constexpr int kColumns = 12;
  constexpr int kRows = 7;
  // A few planes cut faces off the ball, as stone breaks; noise over them.
  struct Cut {
    Vec3 n;
    double d;
  };
  std::vector<Cut> cuts;
  for (int i = 0; i < 9; ++i) cuts.push_back({random.GaussianVec3().normalized(), random.Uniform(0.72, 0.95)});
  std::array<std::array<double, kColumns>, kRows + 1> bump{};
  for (auto& row : bump) {
    for (double& b : row) b = rough * random.Gaussian();
  }
  auto mesh = std::make_shared<Mesh>();
  const auto place = [&](int row, int column) {
    const double latitude = kPi * (static_cast<double>(row) / kRows - 0.5);
    const double longitude = 2.0 * kPi * (column % kColumns) / kColumns;
    const bool pole = row == 0 || row == kRows;
    const Vec3 d = pole ? Vec3(0.0, 0.0, row == 0 ? -1.0 : 1.0)
                        : Vec3(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                               std::sin(latitude));
    double r = 1.0 + (pole ? 0.0 : bump[static_cast<std::size_t>(row)][static_cast<std::size_t>(column % kColumns)]);
    for (const Cut& cut : cuts) {
      const double along = d.dot(cut.n);
      if (along > 1e-6) r = std::min(r, cut.d / along);
    }
    return Vec3((r * d).cwiseProduct(size));
  };
  const double girth = 2.0 * kPi * size.head<2>().mean();
  const auto uv = [&](int row, int column) -> Vec2 {
    return Vec2(girth * column / kColumns, kPi * size.mean() * row / kRows) / texture_scale;
  };
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {  // flat faces: stone has edges
      const std::array<std::array<int, 2>, 4> c{
          {{row, column}, {row, column + 1}, {row + 1, column + 1}, {row + 1, column}}};
      for (const auto& t : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
        const auto corner = [&](std::size_t k) { return place(c[t[k]][0], c[t[k]][1]); };
        const Vec3 n = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        if (n.norm() < 1e-12) continue;
        std::array<std::uint32_t, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
          triangle[k] = AddVertex(*mesh, corner(k), n.normalized(), uv(c[t[k]][0], c[t[k]][1]));
        }
        mesh->triangles.push_back(triangle);
      }
    }
  }
  return mesh;
}

}  // namespace alula::worlds

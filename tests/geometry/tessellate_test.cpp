#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "geometry/shape.h"

namespace alula::geometry {
namespace {

using base::Vec3;
constexpr double kPi = std::numbers::pi;

using Point = std::tuple<float, float, float>;
Point Key(const Eigen::Vector3f& p) { return {p.x() + 0.0F, p.y() + 0.0F, p.z() + 0.0F}; }  // −0 becomes 0

/// Every edge is walked once in each direction (corners compared by position, to the bit).
bool IsClosed(const Mesh& mesh) {
  std::map<std::pair<Point, Point>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Point a = Key(mesh.vertices[t[static_cast<std::size_t>(i)]].position);
      const Point b = Key(mesh.vertices[t[static_cast<std::size_t>((i + 1) % 3)]].position);
      if (a == b) return false;
      a < b ? ++edges[{a, b}] : --edges[{b, a}];
    }
  }
  for (const auto& [edge, balance] : edges) {
    if (balance != 0) return false;
  }
  return true;
}

/// Divergence theorem: V = 1/3 ∮ x·n dA.
double Volume(const Mesh& mesh) {
  double volume = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]].position.cast<double>();
    const Vec3 b = mesh.vertices[t[1]].position.cast<double>();
    const Vec3 c = mesh.vertices[t[2]].position.cast<double>();
    volume += a.dot(b.cross(c)) / 6.0;
  }
  return volume;
}

/// Normals have unit length and look to the side from which the triangle is counter-clockwise.
void ExpectNormalsOutward(const Mesh& mesh, double cosine_min) {
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]].position.cast<double>();
    const Vec3 n = (mesh.vertices[t[1]].position.cast<double>() - a)
                       .cross(mesh.vertices[t[2]].position.cast<double>() - a)
                       .normalized();
    for (const std::uint32_t i : t) {
      EXPECT_NEAR(mesh.vertices[i].normal.norm(), 1.0, 1e-6);
      EXPECT_GT(n.dot(mesh.vertices[i].normal.cast<double>()), cosine_min);
    }
  }
}

struct Case {
  const char* name;
  Shape shape;
  double volume;  // of the tessellation with n segments, closed form
};

constexpr int kSegments = 20;
double Polygon(double r) { return 0.5 * kSegments * r * r * std::sin(2.0 * kPi / kSegments); }  // area

/// Stack of frusta of regular polygons between the rings of a round shape: exact for its tessellation.
double Frusta(const std::vector<std::pair<double, double>>& rings) {
  double volume = 0.0;
  for (std::size_t i = 1; i < rings.size(); ++i) {
    const auto [r0, z0] = rings[i - 1];
    const auto [r1, z1] = rings[i];
    volume += (z1 - z0) / 3.0 * (Polygon(r0) + Polygon(r1) + std::sqrt(Polygon(r0) * Polygon(r1)));
  }
  return volume;
}

std::vector<std::pair<double, double>> Arc(double radius, double z, double from, double to, int steps) {
  std::vector<std::pair<double, double>> rings;
  for (int i = 0; i <= steps; ++i) {
    const double e = from + (to - from) * i / steps;
    rings.emplace_back(std::abs(radius * std::cos(e)), z + radius * std::sin(e));
  }
  return rings;
}

std::vector<Case> Cases() {
  auto capsule = Arc(0.3, -0.5, -0.5 * kPi, 0.0, kSegments / 4);
  const auto upper = Arc(0.3, 0.5, 0.0, 0.5 * kPi, kSegments / 4);
  capsule.insert(capsule.end(), upper.begin(), upper.end());
  return {{"box", Box{{0.3, 0.5, 0.7}}, 8 * 0.3 * 0.5 * 0.7},
          {"sphere", Sphere{0.8}, Frusta(Arc(0.8, 0.0, -0.5 * kPi, 0.5 * kPi, kSegments / 2))},
          {"cylinder", Cylinder{0.4, 0.9}, 1.8 * Polygon(0.4)},
          {"capsule", Capsule{0.3, 0.5}, Frusta(capsule)},
          {"cone", Cone{0.6, 0.5}, Polygon(0.6) / 3.0}};
}

TEST(Tessellate, IsClosedAndLooksOutward) {
  for (const Case& c : Cases()) {
    SCOPED_TRACE(c.name);
    const Mesh mesh = Tessellate(c.shape, 1.0, kSegments);
    EXPECT_TRUE(IsClosed(mesh));
    EXPECT_NEAR(Volume(mesh), c.volume, 1e-6 * c.volume);  // positions are rounded to float
    ExpectNormalsOutward(mesh, std::cos(2.0 * kPi / kSegments));
  }
}

TEST(Tessellate, ConvergesToTheSolid) {
  for (const Case& c : Cases()) {
    SCOPED_TRACE(c.name);
    const double exact = Properties(c.shape).volume;
    // The relative error of an inscribed n-gon's area is (2π/n)²/6; a sphere's rings add (2π/n)²/4.
    EXPECT_NEAR(Volume(Tessellate(c.shape, 1.0, 240)), exact,
                std::pow(2.0 * kPi / 240, 2) * (1.0 / 6.0 + 0.26) * exact + 1e-6);
  }
}

TEST(Tessellate, BoxTextureIsInMetresOverScale) {
  const Mesh mesh = Tessellate(Box{{1.0, 2.0, 3.0}}, 0.5);
  ASSERT_EQ(mesh.vertices.size(), 24U);
  ASSERT_EQ(mesh.triangles.size(), 12U);
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& a = mesh.vertices[t[i]];
      const auto& b = mesh.vertices[t[(i + 1) % 3]];
      EXPECT_NEAR((a.uv - b.uv).norm(), (a.position - b.position).norm() / 0.5F, 1e-5);
    }
    // Not mirrored: counter-clockwise in the texture too.
    const Eigen::Vector2f u = mesh.vertices[t[1]].uv - mesh.vertices[t[0]].uv;
    const Eigen::Vector2f v = mesh.vertices[t[2]].uv - mesh.vertices[t[0]].uv;
    EXPECT_GT(u.x() * v.y() - u.y() * v.x(), 0.0F);
  }
}

TEST(Tessellate, CylinderSideIsUnrolled) {
  const Mesh mesh = Tessellate(Cylinder{0.5, 1.0}, 2.0, 16);
  float u_max = 0.0F;
  float v_max = 0.0F;
  for (int i = 0; i < 2 * 17; ++i) {
    u_max = std::max(u_max, mesh.vertices[static_cast<std::size_t>(i)].uv.x());
    v_max = std::max(v_max, mesh.vertices[static_cast<std::size_t>(i)].uv.y());
  }
  EXPECT_NEAR(u_max, 2.0 * kPi * 0.5 / 2.0, 1e-6);
  EXPECT_NEAR(v_max, 1.0, 1e-6);
}

TEST(Tessellate, MeshKeepsItsOwnTriangles) {
  const auto mesh = std::make_shared<const Mesh>(Tessellate(Sphere{1.0}, 1.0, 8));
  const Mesh copy = Tessellate(MeshShape{mesh}, 3.0, 100);
  EXPECT_EQ(copy.triangles, mesh->triangles);
  EXPECT_EQ(copy.vertices.front().uv, mesh->vertices.front().uv);
}

}  // namespace
}  // namespace alula::geometry

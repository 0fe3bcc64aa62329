// Levels of detail: how far they lie from the full level, measured by sampling, and when they are chosen.
#include "render/internal/detail_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/internal/scene_geometry.h"
#include "tests/render/test_scene.h"

namespace alula::render::internal {
namespace {

using Triangle = std::array<base::Vec3, 3>;

std::vector<Triangle> TrianglesOf(const geometry::Mesh& mesh) {
  std::vector<Triangle> triangles;
  for (const auto& t : mesh.triangles) {
    Triangle corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = mesh.vertices[t[i]].position.cast<double>();
    triangles.push_back(corners);
  }
  return triangles;
}

double ToSegment(const base::Vec3& p, const base::Vec3& a, const base::Vec3& b) {
  const base::Vec3 ab = b - a;
  const double share = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - share * ab).norm();
}

double ToTriangle(const base::Vec3& p, const Triangle& t) {
  const base::Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const base::Vec3& a = t[i];
    const base::Vec3& b = t[(i + 1) % 3];
    inside = inside && normal.cross(b - a).dot(p - a) >= 0.0;
    nearest = std::min(nearest, ToSegment(p, a, b));
  }
  return inside ? std::abs(normal.dot(p - t[0])) / normal.norm() : nearest;
}

/// The longest way from points of one surface to the other.
double Deviation(const geometry::Mesh& from, const geometry::Mesh& to, base::RandomStream& random) {
  const std::vector<Triangle> target = TrianglesOf(to);
  double longest = 0.0;
  for (const Triangle& t : TrianglesOf(from)) {
    for (int sample = 0; sample < 6; ++sample) {
      double v = sample == 0 ? 0.0 : random.Uniform(0, 1);
      double w = sample == 0 ? 0.0 : random.Uniform(0, 1);
      if (v + w > 1.0) {
        v = 1.0 - v;
        w = 1.0 - w;
      }
      const base::Vec3 p = t[0] + v * (t[1] - t[0]) + w * (t[2] - t[0]);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Triangle& other : target) nearest = std::min(nearest, ToTriangle(p, other));
      longest = std::max(longest, nearest);
    }
  }
  return longest;
}

/// A bumpy sheet with a crease and a seam in its texture.
geometry::Mesh Sheet() {
  geometry::Mesh mesh;
  constexpr std::uint32_t kSide = 24;
  for (std::uint32_t y = 0; y <= kSide; ++y) {
    for (std::uint32_t x = 0; x <= kSide; ++x) {
      const float u = static_cast<float>(x) / kSide;
      const float v = static_cast<float>(y) / kSide;
      mesh.vertices.push_back({{u, v, 0.05F * std::sin(9.0F * u) * std::cos(7.0F * v)},
                               Eigen::Vector3f::UnitZ(),
                               {u < 0.5F ? u : u + 3.0F, v}});
    }
  }
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t a = y * (kSide + 1) + x;
      mesh.triangles.push_back({a, a + 1, a + kSide + 2});
      mesh.triangles.push_back({a, a + kSide + 2, a + kSide + 1});
    }
  }
  return mesh;
}

void ExpectWithinError(const geometry::Shape& shape, std::size_t levels) {
  const std::vector<DetailLevel> all = DetailLevels(shape, 1.0);
  ASSERT_EQ(all.size(), levels) << shape.index();
  EXPECT_EQ(all[0].error, 0.0);
  EXPECT_EQ(all[0].mesh.triangles, geometry::Tessellate(shape).triangles);
  base::RandomStream random(1, "levels");
  for (std::size_t i = 1; i < all.size(); ++i) {
    const double longest =
        std::max(Deviation(all[i].mesh, all[0].mesh, random), Deviation(all[0].mesh, all[i].mesh, random));
    EXPECT_LE(longest, all[i].error + 1e-6) << shape.index() << " level " << i;  // 1e-6 m: single precision
    EXPECT_GT(all[i].error, all[i - 1].error);
    EXPECT_LT(all[i].mesh.triangles.size(), 0.7 * static_cast<double>(all[i - 1].mesh.triangles.size()));
  }
}

TEST(DetailLevels, LieNoFartherFromTheFullLevelThanTheySay) {
  ExpectWithinError(geometry::Box{}, 1);
  ExpectWithinError(geometry::Sphere{0.7}, 3);
  ExpectWithinError(geometry::Cylinder{0.3, 0.8}, 3);
  ExpectWithinError(geometry::Capsule{0.2, 0.6}, 3);
  ExpectWithinError(geometry::Cone{0.5, 0.4}, 3);
  ExpectWithinError(geometry::MeshShape{std::make_shared<const geometry::Mesh>(Sheet())},
                    2);  // finer cells would save nothing
}

TEST(DetailLevels, ClustersKeepSeamsApart) {
  const DetailLevel level = Clustered(Sheet(), 0.1);
  for (const auto& t : level.mesh.triangles) {
    // No triangle of the sheet stretches the texture but those across the seam; none new may.
    const geometry::Mesh::Vertex& a = level.mesh.vertices[t[0]];
    for (const std::uint32_t corner : {t[1], t[2]}) {
      const geometry::Mesh::Vertex& b = level.mesh.vertices[corner];
      const bool across =
          (a.position.x() < 0.55F) != (b.position.x() < 0.55F) || std::abs(a.position.x() - 0.5F) < 0.1F;
      if (across) continue;
      EXPECT_LT(std::abs(a.uv.x() - b.uv.x()), 0.3F);
    }
  }
}

TEST(DetailLevels, AreChosenByWhatTheEyeCanTell) {
  worlds::World world;
  world.materials = {test::Plain(0.5F)};
  world.objects.push_back({"ball", geometry::Sphere{0.5}, {}, 0, 1.0, true});
  const SceneGeometry scene = BuildScene(world, {});
  const Batch& ball = scene.statics.front();
  ASSERT_EQ(ball.level_count, 3);
  constexpr double kFocal = 400.0;
  std::uint32_t before = std::numeric_limits<std::uint32_t>::max();
  for (double x = 0.1; x < 100.0; x += 0.1) {
    const Level& level = LevelFor(ball, Eigen::Vector3d(x, 0, 0).cast<float>(), kFocal);
    EXPECT_LE(static_cast<double>(level.error) * kFocal, kPixelError * std::max(x - 0.5, 0.0) + 1e-9);
    EXPECT_LE(level.index_count, before);
    before = level.index_count;
  }
  EXPECT_EQ(before, ball.levels[2].index_count);
  const Eigen::Vector3f far(1000, 0, 0);
  EXPECT_EQ(&LevelFor(ball, far, std::numeric_limits<double>::infinity()), &ball.levels[0]);
}

/// A picture drawn with levels of detail beside one at full detail.
TEST(DetailLevels, ChangeThePictureLittle) {
  const worlds::World world = test::Clutter(6, 150);
  GlRenderer levels(test::MakeContext("osmesa"), world, {}, {.levels = true});
  GlRenderer full(test::MakeContext("osmesa"), world, {}, {.levels = false});
  double difference = 0.0;
  double pixels = 0.0;
  std::size_t unlike = 0;
  for (const base::Vec3& eye : {base::Vec3(-9, -9, 2.5), base::Vec3(9, -8, 1.5), base::Vec3(0, 9, 2)}) {
    const View view = test::LookAt(eye, {0, 0, 1});
    Picture a;
    Picture b;
    levels.Grey(view, a);
    full.Grey(view, b);
    for (std::size_t i = 0; i < a.bytes.size(); ++i) {
      difference += std::abs(a.bytes[i] - b.bytes[i]);
      unlike += a.bytes[i] != b.bytes[i] ? 1 : 0;
      pixels += 1.0;
    }
  }
  EXPECT_GT(unlike, 1000U);             // levels are used at these distances
  EXPECT_LT(difference / pixels, 1.0);  // grey levels, silhouettes included: as much as two makers may differ
}

}  // namespace
}  // namespace alula::render::internal

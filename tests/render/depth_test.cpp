#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "render/internal/projection.h"
#include "tests/render/each_maker.h"
#include "tests/render/test_scene.h"
#include "worlds/kit/mesh_parts.h"

namespace alula::render {
namespace {

using DepthPass = test::EachMaker;
using test::LookAt;

/// Triangles of the world, cast against one by one: the brute-force twin of the depth pass.
struct TriangleSoup {
  std::vector<std::array<base::Vec3, 3>> triangles;

  /// At the levels of detail that the view shows (detail_levels_test.cpp measures those against the full ones).
  TriangleSoup(const internal::SceneGeometry& scene, const View& view) {
    for (const internal::Batch& batch : scene.statics) {
      const internal::Level& level =
          internal::LevelFor(batch, view.X_WC.p.cast<float>(), std::max(view.intrinsics.fx, view.intrinsics.fy));
      for (std::size_t index = level.first_index; index < level.first_index + level.index_count; index += 3) {
        std::array<base::Vec3, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) {
          corners[i] = scene.vertices[scene.indices[index + i]].position.cast<double>();
        }
        triangles.push_back(corners);
      }
    }
  }

  /// Smallest s ≥ near with origin + s·direction on a front face (Möller and Trumbore 1997); 0 where there is none.
  double Cast(const base::Vec3& origin, const base::Vec3& direction) const {
    double nearest = 0.0;
    for (const auto& [a, b, c] : triangles) {
      const base::Vec3 ab = b - a;
      const base::Vec3 ac = c - a;
      const base::Vec3 normal = ab.cross(ac);
      const double along = -direction.dot(normal);
      if (along <= 0.0) continue;  // seen from behind
      const double s = (origin - a).dot(normal) / along;
      if (s < internal::kNear || (nearest > 0.0 && s >= nearest)) continue;
      const base::Vec3 e = (origin - a).cross(direction);
      const double v = ac.dot(e) / along;
      const double w = -ab.dot(e) / along;
      if (v >= 0.0 && w >= 0.0 && v + w <= 1.0) nearest = s;
    }
    return nearest;
  }
};

double Tolerance(double depth) { return std::max(1e-3, 1e-3 * depth); }

float At(const DepthPicture& picture, int u, int v) {
  return picture.metres[static_cast<std::size_t>(v * picture.width + u)];
}

TEST_P(DepthPass, PlaneInClosedForm) {
  worlds::World world;
  world.materials = {test::Plain(0.5F)};
  test::AddBox(world, {base::Quat::Identity(), {0, 0, -0.5}}, {300, 300, 0.5}, 0);
  const auto renderer = Make(world);
  const View view = LookAt({0.3, -0.2, 1.5}, {4, 1, 0.4}, 0.2);
  DepthPicture depth;
  renderer->Depth(view, depth);
  double worst = 0.0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const base::Vec3 ray = internal::RayDirection(view, u, v);
      const double expected = ray.z() < 0.0 ? -view.X_WC.p.z() / ray.z() : 1e9;
      if (expected > internal::kFar * 1.001) {
        EXPECT_EQ(At(depth, u, v), 0.0F);
      } else if (expected < internal::kFar * 0.999) {
        EXPECT_NEAR(At(depth, u, v), expected, Tolerance(expected));
        if (expected < 10.0) worst = std::max(worst, std::abs(At(depth, u, v) - expected));
      }
    }
  }
  EXPECT_LT(worst, 2e-4);  // single precision of 1/w at 10 m is 1e-5 m; the rest is vertex rounding
}

TEST_P(DepthPass, SphereInClosedFormToItsTessellation) {
  worlds::World world;
  world.materials = {test::Plain(0.5F)};
  constexpr double kRadius = 0.8;
  const base::Vec3 centre(3.0, 0.2, 1.0);
  world.objects.push_back({"sphere", geometry::Sphere{kRadius}, {base::Quat::Identity(), centre}, 0, 1.0, true});
  const auto renderer = Make(world);
  const View view = LookAt({0, 0, 1.2}, {3, 0, 1});
  DepthPicture depth;
  renderer->Depth(view, depth);
  int compared = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const base::Vec3 d = internal::RayDirection(view, u, v);
      const base::Vec3 o = view.X_WC.p - centre;
      const double half_b = o.dot(d);
      const double inside = half_b * half_b - d.squaredNorm() * (o.squaredNorm() - 0.8 * kRadius * kRadius);
      if (inside <= 0.0) continue;  // the rim, where the facets' error is not along the ray
      const double root = std::sqrt(half_b * half_b - d.squaredNorm() * (o.squaredNorm() - kRadius * kRadius));
      // Facets lie inside the sphere by at most r (1 − cos²(π/24)) of 24 segments either way.
      const double sagitta = kRadius * (1.0 - std::pow(std::cos(M_PI / 24.0), 2));
      EXPECT_GE(At(depth, u, v), (-half_b - root) / d.squaredNorm() - 1e-3);
      EXPECT_LE(At(depth, u, v), (-half_b - root) / d.squaredNorm() + 4.0 * sagitta);
      ++compared;
    }
  }
  EXPECT_GT(compared, 5000);
}

// Shapes of every kind at random poses, from random poses, against ray casts. Pixels on an outline (where rays 0.02 px
// apart see different things) are left out.
TEST_P(DepthPass, AgreesWithRayCastsOnRandomPoses) {
  const worlds::World world = test::Clutter(11);
  const internal::SceneGeometry scene = internal::BuildScene(world, {});
  const auto renderer = Make(world);
  base::RandomStream random(5, "depth");
  int compared = 0;
  int left_out = 0;
  for (int pose = 0; pose < 8; ++pose) {
    const View view = LookAt(test::RandomPose(random, {-5, -5, 0.5}, {5, 5, 2.5}).p,
                             test::RandomPose(random, {-9, -9, 0.0}, {9, 9, 3.0}).p, random.Uniform(-0.5, 0.5));
    const TriangleSoup soup(scene, view);
    DepthPicture depth;
    renderer->Depth(view, depth);
    for (int ray = 0; ray < 150; ++ray) {
      const int u = static_cast<int>(random.Index(640));
      const int v = static_cast<int>(random.Index(480));
      const auto cast = [&](double du, double dv) {
        return soup.Cast(view.X_WC.p, internal::RayDirection(view, u + du, v + dv));
      };
      const double expected = cast(0, 0);
      const bool outline = std::abs(cast(0.02, 0) - expected) > Tolerance(expected) ||
                           std::abs(cast(-0.02, 0) - expected) > Tolerance(expected) ||
                           std::abs(cast(0, 0.02) - expected) > Tolerance(expected) ||
                           std::abs(cast(0, -0.02) - expected) > Tolerance(expected);
      if (outline) {
        ++left_out;
        continue;
      }
      EXPECT_NEAR(At(depth, u, v), expected, Tolerance(expected)) << "pose " << pose << " pixel " << u << " " << v;
      ++compared;
    }
  }
  EXPECT_LT(left_out, 40);
  EXPECT_GT(compared, 1000);
}

// A wire of 2 cm across the picture, 5 to 60 m away: two columns of three show it at least, none with more than three
// pixels. Drawn as thick as it is, it would show in one of seven at 60 m.
TEST_P(DepthPass, WiresAreLinesNotDots) {
  worlds::World world;
  world.materials = {test::Plain(0.1F)};
  auto mesh = std::make_shared<geometry::Mesh>();
  const std::array<worlds::TubePoint, 2> line{{{{0, -40, 0}, 0.01}, {{0, 40, 3}, 0.01}}};
  worlds::AddTube(*mesh, line, 6, 0.5);
  world.objects.push_back({"wire", geometry::MeshShape{mesh}, {}, 0, 1.0, true});
  world.objects.back().wire_radius = 0.01;
  const auto renderer = Make(world);
  for (const double distance : {5.0, 12.0, 25.0, 60.0}) {
    DepthPicture depth;
    renderer->Depth(LookAt({-distance, 0, 1.5}, {0, 0, 1.5}), depth);
    int shown = 0;
    int thick = 0;
    for (int u = 100; u < 540; ++u) {
      int pixels = 0;
      for (int v = 0; v < 480; ++v) pixels += depth.metres[static_cast<std::size_t>(v * 640 + u)] > 0.0F ? 1 : 0;
      shown += pixels > 0 ? 1 : 0;
      thick += pixels > 3 ? 1 : 0;
    }
    EXPECT_GE(shown, 293) << distance;
    EXPECT_EQ(thick, 0) << distance;
  }
}

INSTANTIATE_TEST_SUITE_P(Makers, DepthPass, test::kEachMaker);

}  // namespace
}  // namespace alula::render

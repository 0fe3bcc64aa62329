#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/random.h"
#include "geometry/shape.h"

namespace alula::geometry {
namespace {

using base::Mat3;
using base::Vec3;

/// The mesh integral over a fine tessellation is the brute-force twin of each closed form. 256 segments leave a
/// relative error of about 4e-4.
TEST(Properties, ClosedFormsAgreeWithTheMeshIntegral) {
  const std::vector<Shape> shapes{Box{{0.3, 0.5, 0.7}}, Sphere{0.8},       Cylinder{0.4, 0.9},
                                  Capsule{0.3, 0.5},    Capsule{0.5, 0.1}, Cone{0.6, 0.5}};
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(shape.index());
    const SolidProperties exact = Properties(shape);
    const SolidProperties summed = Properties(MeshShape{std::make_shared<const Mesh>(Tessellate(shape, 1.0, 256))});
    EXPECT_NEAR(summed.volume, exact.volume, 5e-4 * exact.volume);
    EXPECT_LT((summed.centre - exact.centre).norm(), 1e-4);
    EXPECT_LT((summed.unit_inertia - exact.unit_inertia).norm(), 1e-3 * exact.unit_inertia.norm());
  }
}

TEST(Properties, MeshOfABoxIsExact) {
  const Shape box = Box{{0.25, 0.5, 1.0}};  // exact in float
  const SolidProperties exact = Properties(box);
  const SolidProperties summed = Properties(MeshShape{std::make_shared<const Mesh>(Tessellate(box))});
  EXPECT_NEAR(summed.volume, exact.volume, 1e-14);
  EXPECT_LT((summed.unit_inertia - exact.unit_inertia).norm(), 1e-14);
}

TEST(Properties, CapsuleWithoutStraightPartIsASphere) {
  const SolidProperties capsule = Properties(Capsule{0.7, 0.0});
  const SolidProperties sphere = Properties(Sphere{0.7});
  EXPECT_NEAR(capsule.volume, sphere.volume, 1e-15);
  EXPECT_LT((capsule.unit_inertia - sphere.unit_inertia).norm(), 1e-15);
}

TEST(Properties, MeshTurnedInsideOutIsNoSolid) {
  Mesh mesh = Tessellate(Box{});
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_THROW(Properties(MeshShape{std::make_shared<const Mesh>(mesh)}), base::InputError);
}

/// Brute force: point masses at random places inside the solid, turned and moved.
TEST(InertiaAbout, AgreesWithPointMasses) {
  base::RandomStream random(1, "points");
  const Box box{{0.2, 0.3, 0.4}};
  const base::Transform X_BS{base::Exp({0.3, -0.7, 1.1}), {0.5, -0.2, 0.8}};
  const double mass = 1.7;
  constexpr int kPoints = 200'000;
  Mat3 sum = Mat3::Zero();
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 p = X_BS * Vec3(random.Uniform(-0.2, 0.2), random.Uniform(-0.3, 0.3), random.Uniform(-0.4, 0.4));
    sum += mass / kPoints * (p.squaredNorm() * Mat3::Identity() - p * p.transpose());
  }
  const Mat3 exact = InertiaAbout(Properties(box), mass, X_BS);
  EXPECT_LT((sum - exact).norm(), 5.0 / std::sqrt(kPoints) * exact.norm());  // 5σ of the sampling
}

TEST(InertiaAbout, CentreOfMassOfAConeIsMovedByTheParallelAxis) {
  const Cone cone{0.5, 1.0};
  const SolidProperties solid = Properties(cone);
  // About the tip: 3/5 m h² + 3/20 m r² across, 3/10 m r² along (h: full height).
  const Mat3 about_tip = InertiaAbout(solid, 2.0, {base::Quat::Identity(), {0.0, 0.0, -1.0}});
  EXPECT_NEAR(about_tip(0, 0), 2.0 * (0.6 * 4.0 + 0.15 * 0.25), 1e-12);
  EXPECT_NEAR(about_tip(2, 2), 2.0 * 0.3 * 0.25, 1e-12);
}

}  // namespace
}  // namespace alula::geometry

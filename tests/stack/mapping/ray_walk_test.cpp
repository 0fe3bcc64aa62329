#include "stack/mapping/internal/ray_walk.h"

#include <gtest/gtest.h>

#include <set>

#include "base/random.h"

namespace alula::stack::mapping {
namespace {

/// Whether a segment passes through the inside of a box (slabs).
bool Meets(const base::Vec3& low, const base::Vec3& high, const base::Vec3& from, const base::Vec3& to, double slack) {
  double enter = 0.0;
  double leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = to[axis] - from[axis];
    const double a = (low[axis] - slack - from[axis]) / d;
    const double b = (high[axis] + slack - from[axis]) / d;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

TEST(RayWalk, VisitsExactlyTheCellsThatTheSegmentMeets) {
  GridShape shape;
  shape.low_O = {-1.0, 0.5, -0.3};
  shape.cell = 0.1;
  shape.size = {15, 12, 10};
  base::RandomStream random(3, "test/rays");
  for (int ray = 0; ray < 200; ++ray) {
    const base::Vec3 span = shape.high_O() - shape.low_O;
    const auto somewhere = [&]() -> base::Vec3 {
      return shape.low_O + base::Vec3(span.x() * random.Uniform(-0.3, 1.3), span.y() * random.Uniform(-0.3, 1.3),
                                      span.z() * random.Uniform(-0.3, 1.3));
    };
    base::Vec3 from = somewhere();
    base::Vec3 to = somewhere();
    std::set<std::size_t> visited;
    if (internal::ClipToGrid(shape, from, to)) {
      internal::WalkRay(shape, from, to, [&](std::size_t cell) { EXPECT_TRUE(visited.insert(cell).second); });
    } else {
      EXPECT_FALSE(Meets(shape.low_O, shape.high_O(), from, to, -1e-6));
      continue;
    }
    for (int i = 0; i < shape.size[0]; ++i) {
      for (int j = 0; j < shape.size[1]; ++j) {
        for (int k = 0; k < shape.size[2]; ++k) {
          const base::Vec3 low = shape.low_O + shape.cell * base::Vec3(i, j, k);
          const base::Vec3 high = low + base::Vec3::Constant(shape.cell);
          const bool was = visited.count(shape.Index(i, j, k)) > 0;
          // Within a rounding of an edge either answer is right.
          if (Meets(low, high, from, to, -1e-7)) {
            EXPECT_TRUE(was);
          }
          if (!Meets(low, high, from, to, 1e-7)) {
            EXPECT_FALSE(was);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace alula::stack::mapping

#include "stack/mapping/occupancy_map.h"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <cmath>
#include <sstream>

#include "base/error.h"
#include "stack/mapping/map_file.h"
#include "tests/stack/mapping/synthetic_scene.h"

namespace alula::stack::mapping {
namespace {

/// A camera at `p_O` that looks along O's x axis turned by `yaw`.
base::Transform LookAlong(const base::Vec3& p_O, double yaw) {
  return {base::FromYaw(yaw) * base::ForwardCameraRotation(), p_O};
}

/// Ground, a wall at x = 7 m, and a gate with thin bars 3 m ahead of the origin.
test::Scene CourtyardCorner(double bar_width) {
  test::Scene scene;
  scene.AddBox({5, 0, -0.5}, {8, 8, 0.5});
  scene.AddBox({7.2, 0, 2}, {0.2, 8, 2});
  scene.AddGate({base::Quat::Identity(), {3.0, 0.0, 1.4}}, 1.4, bar_width, 0.12);
  return scene;
}

OccupancyMap Map() { return OccupancyMap({}, {-2, -6, -0.5}, {9, 6, 4}); }

TEST(OccupancyMap, ThinBarsSeenFromThreeMetresAreOccupiedAndTheOpeningIsFree) {
  for (const double bar : {0.12, 0.2}) {
    const test::Scene scene = CourtyardCorner(bar);
    OccupancyMap map = Map();
    base::RandomStream random(11, "test/map");
    for (int n = 0; n < 6; ++n) {
      const base::Transform X_OC = LookAlong({0.1 * n, 0.1 * std::sin(n), 1.4}, 0.05 * std::cos(2 * n));
      map.Insert(test::Corrupt(scene.Depth(test::HalfSizeShape(), X_OC), 0.2, 0.05, 0.1, random), X_OC);
    }
    int free = 0;
    int cells = 0;
    for (double y = -0.55; y < 0.56; y += 0.1) {
      for (double z = 0.85; z < 1.96; z += 0.1) {
        ++cells;
        free += map.State({3.0, y, z}) == CellState::kFree ? 1 : 0;
        EXPECT_NE(map.State({3.0, y, z}), CellState::kOccupied) << y << " " << z;
      }
    }
    EXPECT_EQ(free, cells);
    const double reach = 0.7 + 0.5 * bar;
    for (double along = -0.65; along < 0.66; along += 0.1) {
      for (const double side : {-1.0, 1.0}) {
        EXPECT_LT(map.Clearance({2.95, side * reach, 1.4 + along}), 0.15) << bar << " upright " << along;
        EXPECT_LT(map.Clearance({2.95, along, 1.4 + side * reach}), 0.15) << bar << " level " << along;
      }
    }
    EXPECT_GT(map.Clearance({3.0, 0, 1.4}), 0.45);
    EXPECT_EQ(map.State({3.0, 0, 3.9}), CellState::kUnknown) << "before a plain sky nothing is carved";
    EXPECT_EQ(map.State({8.5, 0, 1.4}), CellState::kUnknown) << "behind the wall";
  }
}

TEST(OccupancyMap, NearViewsOverruleFarOnes) {
  test::Scene wrong;  // a wall where there is none, seen from 4.5 m, many times
  wrong.AddBox({4.7, 0, 1}, {0.2, 8, 4});
  test::Scene right;
  right.AddBox({7.2, 0, 1}, {0.2, 8, 4});
  OccupancyMap map = Map();
  const base::Transform far = LookAlong({0, 0, 1}, 0);
  for (int n = 0; n < 20; ++n) map.Insert(wrong.Depth(test::HalfSizeShape(), far), far);
  EXPECT_EQ(map.State({4.55, 0, 1}), CellState::kOccupied);
  const base::Transform near = LookAlong({2.5, 0, 1}, 0);
  for (int n = 0; n < 3; ++n) map.Insert(right.Depth(test::HalfSizeShape(), near), near);
  EXPECT_EQ(map.State({4.55, 0, 1}), CellState::kFree);
}

TEST(OccupancyMap, FarButValidDepthClearsToTheLimitAndUnknownClearsNothing) {
  OccupancyMap map = Map();
  DepthMap depth = test::HalfSizeShape();
  depth.z.assign(static_cast<std::size_t>(depth.width) * depth.height, 0.0F);
  for (int v = 0; v < depth.height; ++v) {
    for (int u = depth.width / 2; u < depth.width; ++u) {
      depth.z[static_cast<std::size_t>(v) * depth.width + u] = std::numeric_limits<float>::infinity();
    }
  }
  map.Insert(depth, LookAlong({0, 0, 1}, 0));
  for (double x = 1.0; x < 4.9; x += 0.1) {
    EXPECT_EQ(map.State({x, -0.3, 1}), CellState::kFree) << x;  // right half of the picture
    EXPECT_EQ(map.State({x, 0.3, 1}), CellState::kUnknown) << x;
  }
  EXPECT_EQ(map.State({5.2, -0.3, 1}), CellState::kUnknown);
}

TEST(OccupancyMap, DistancesAreThoseOfItsCells) {
  const test::Scene scene = CourtyardCorner(0.15);
  OccupancyMap map = Map();
  base::RandomStream random(5, "test/map");
  for (int n = 0; n < 4; ++n) {
    const base::Transform X_OC = LookAlong({0.3 * n, 0, 1.2}, 0.3 * (n - 2));
    map.Insert(test::Corrupt(scene.Depth(test::HalfSizeShape(), X_OC), 0.2, 0.05, 0.1, random), X_OC);
  }
  map.DeclareFree({0, 0, 0}, 0.6, 2.0);
  const auto snapshot = map.Snapshot();
  const GridShape& shape = snapshot->shape;
  for (int n = 0; n < 300; ++n) {
    const int i = static_cast<int>(random.Index(shape.size[0]));
    const int j = static_cast<int>(random.Index(shape.size[1]));
    const int k = static_cast<int>(random.Index(shape.size[2]));
    double to_occupied = 1.5;
    double to_not_free = 1.5;
    for (int a = std::max(0, i - 16); a < std::min(shape.size[0], i + 17); ++a) {
      for (int b = std::max(0, j - 16); b < std::min(shape.size[1], j + 17); ++b) {
        for (int c = std::max(0, k - 16); c < std::min(shape.size[2], k + 17); ++c) {
          const base::Vec3 gap =
              (base::Vec3(std::abs(a - i), std::abs(b - j), std::abs(c - k)) - base::Vec3::Constant(0.5)).cwiseMax(0.0);
          const CellState state = snapshot->StateOf(shape.Index(a, b, c));
          if (state != CellState::kFree) to_not_free = std::min(to_not_free, 0.1 * gap.norm());
          if (state == CellState::kOccupied) to_occupied = std::min(to_occupied, 0.1 * gap.norm());
        }
      }
    }
    const base::Vec3 p_O = shape.Centre(i, j, k);
    EXPECT_NEAR(map.Clearance(p_O), to_occupied, snapshot->step() + 1e-6);
    EXPECT_NEAR(map.KnownFreeClearance(p_O), to_not_free, snapshot->step() + 1e-6);
  }
}

TEST(OccupancyMap, DeclaredColumnIsFreeUntilSomethingIsSeenInIt) {
  OccupancyMap map = Map();
  map.DeclareFree({0, 0, 0}, 0.5, 1.5);
  EXPECT_EQ(map.State({0.3, 0.3, 1.2}), CellState::kFree);
  EXPECT_EQ(map.State({0.3, 0.3, 1.7}), CellState::kUnknown);
  EXPECT_EQ(map.State({0.45, 0.45, 1.2}), CellState::kUnknown);
  test::Scene scene;
  scene.AddBox({0.2, 0, 1}, {0.2, 1, 1});
  const base::Transform X_OC = LookAlong({-1, 0, 1}, 0);
  for (int n = 0; n < 2; ++n) map.Insert(scene.Depth(test::HalfSizeShape(), X_OC), X_OC);
  EXPECT_EQ(map.State({0.01, 0, 1}), CellState::kOccupied);
}

DepthMap AllPlain() {
  DepthMap depth = test::HalfSizeShape();
  depth.z.assign(static_cast<std::size_t>(depth.width) * depth.height, DepthMap::kPlain);
  return depth;
}

TEST(OccupancyMap, NearLooksThatFindNothingToMatchTakeBackWhatOnlyFarOnesShowed) {
  test::Scene sheet;
  sheet.AddBox({5, 0, 1.4}, {0.05, 0.5, 0.5});
  const base::Transform far = LookAlong({0.5, 0, 1.4}, 0);
  const base::Transform near = LookAlong({3.2, 0, 1.4}, 0);
  const base::Vec3 in_sheet(4.96, 0, 1.4);
  OccupancyMap invented = Map();
  for (int n = 0; n < 4; ++n) invented.Insert(sheet.Depth(test::HalfSizeShape(), far), far);
  ASSERT_EQ(invented.State(in_sheet), CellState::kOccupied);
  invented.Insert(AllPlain(), far);
  EXPECT_EQ(invented.State(in_sheet), CellState::kOccupied) << "a far look says nothing";
  for (int n = 0; n < 20; ++n) invented.Insert(AllPlain(), near);
  EXPECT_EQ(invented.State(in_sheet), CellState::kUnknown) << "and not free";
  EXPECT_DOUBLE_EQ(invented.LogOdds(in_sheet), 0.0);

  OccupancyMap real = Map();
  for (int n = 0; n < 4; ++n) real.Insert(sheet.Depth(test::HalfSizeShape(), near), near);
  for (int n = 0; n < 200; ++n) real.Insert(AllPlain(), near);
  EXPECT_EQ(real.State(in_sheet), CellState::kOccupied) << "it was seen from near";
}

TEST(OccupancyMap, SnapshotsStayAsTheyWereAndMapsAreEqualToTheBit) {
  const test::Scene scene = CourtyardCorner(0.15);
  const base::Transform X_OC = LookAlong({0, 0, 1.2}, 0);
  const DepthMap depth = scene.Depth(test::HalfSizeShape(), X_OC);
  OccupancyMap one = Map();
  OccupancyMap two = Map();
  const auto before = one.Snapshot();
  one.Insert(depth, X_OC);
  two.Insert(depth, X_OC);
  EXPECT_EQ(before->State({7.0, 0, 1.2}), CellState::kUnknown);
  EXPECT_EQ(one.Snapshot()->to_occupied, two.Snapshot()->to_occupied);
  EXPECT_EQ(one.Snapshot()->to_not_free, two.Snapshot()->to_not_free);
  EXPECT_EQ(one.Snapshot(), one.Snapshot());
  EXPECT_GT(one.revision(), before->revision);
}

TEST(OccupancyMap, WritesAnOctreeThatReadsBackTheSame) {
  const test::Scene scene = CourtyardCorner(0.15);
  OccupancyMap map = Map();
  const base::Transform X_OC = LookAlong({0, 0, 1.2}, 0);
  for (int n = 0; n < 3; ++n) map.Insert(scene.Depth(test::HalfSizeShape(), X_OC), X_OC);
  std::stringstream file;
  WriteOctoMap(*map.Snapshot(), file);
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary(file));
  EXPECT_NEAR(tree.getResolution(), 0.1, 1e-12);
  const GridShape& shape = map.shape();
  int known = 0;
  for (int i = 0; i < shape.size[0]; ++i) {
    for (int j = 0; j < shape.size[1]; ++j) {
      for (int k = 0; k < shape.size[2]; ++k) {
        const base::Vec3 p_O = shape.Centre(i, j, k);
        const octomap::OcTreeNode* node = tree.search(p_O.x(), p_O.y(), p_O.z());
        const CellState state = map.State(p_O);
        ASSERT_EQ(node != nullptr, state != CellState::kUnknown);
        if (node == nullptr) continue;
        ++known;
        ASSERT_EQ(tree.isNodeOccupied(node), state == CellState::kOccupied);
      }
    }
  }
  EXPECT_GT(known, 10000);
}

TEST(OccupancyMap, RefusesAnEmptyBox) {
  EXPECT_THROW(OccupancyMap({}, {0, 0, 0}, {1, 0, 1}), base::InputError);
  EXPECT_THROW(OccupancyMap({}, {0, 0, 0}, {1e6, 1e6, 1}), base::InputError);
}

}  // namespace
}  // namespace alula::stack::mapping

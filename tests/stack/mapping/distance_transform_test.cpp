#include "stack/mapping/internal/distance_transform.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace alula::stack::mapping {
namespace {

using internal::CellBox;
using internal::DistanceTransform;

bool Occupied(CellState s) { return s == CellState::kOccupied; }

std::uint8_t BruteForce(const GridShape& shape, const std::vector<CellState>& state, double max, int i, int j, int k) {
  double best = max;
  for (int a = 0; a < shape.size[0]; ++a) {
    for (int b = 0; b < shape.size[1]; ++b) {
      for (int c = 0; c < shape.size[2]; ++c) {
        if (!Occupied(state[shape.Index(a, b, c)])) continue;
        const base::Vec3 gap =
            (base::Vec3(std::abs(a - i), std::abs(b - j), std::abs(c - k)) - base::Vec3::Constant(0.5)).cwiseMax(0.0);
        best = std::min(best, shape.cell * gap.norm());
      }
    }
  }
  return static_cast<std::uint8_t>(std::min(255.0, std::floor(255.0 * best / max + 1e-9)));
}

TEST(DistanceTransform, EqualsBruteForceAfterEachOfManyLocalChanges) {
  GridShape shape;
  shape.cell = 0.1;
  shape.size = {24, 31, 17};
  const double max = 0.75;
  DistanceTransform transform(shape, max);
  std::vector<CellState> state(shape.count(), CellState::kUnknown);
  std::vector<std::uint8_t> distance(shape.count(), 255);
  base::RandomStream random(7, "test/distance");
  for (int change = 0; change < 12; ++change) {
    CellBox box;
    for (int n = 0; n < 9; ++n) {
      const int i = static_cast<int>(random.Index(shape.size[0]));
      const int j = static_cast<int>(random.Index(shape.size[1]));
      const int k = static_cast<int>(random.Index(shape.size[2]));
      state[shape.Index(i, j, k)] = random.Uniform() < 0.5 ? CellState::kOccupied : CellState::kFree;
      box.Add(i, j, k);
    }
    transform.Update(state, box, Occupied, distance);
    for (int i = 0; i < shape.size[0]; i += 2) {
      for (int j = 0; j < shape.size[1]; j += 3) {
        for (int k = 0; k < shape.size[2]; ++k) {
          ASSERT_EQ(distance[shape.Index(i, j, k)], BruteForce(shape, state, max, i, j, k))
              << i << " " << j << " " << k;
        }
      }
    }
  }
}

TEST(ClearanceField, InterpolatesTheDistanceToAWall) {
  ClearanceField field;
  field.shape.cell = 0.1;
  field.shape.size = {20, 20, 20};
  field.max_clearance = 1.5;
  std::vector<CellState> state(field.shape.count(), CellState::kFree);
  field.to_occupied.assign(field.shape.count(), 255);
  field.to_not_free.assign(field.shape.count(), 255);
  CellBox box;
  for (int j = 0; j < 20; ++j) {
    for (int k = 0; k < 20; ++k) {
      state[field.shape.Index(0, j, k)] = CellState::kOccupied;
      box.Add(0, j, k);
    }
  }
  DistanceTransform(field.shape, 1.5).Update(state, box, Occupied, field.to_occupied);
  for (double x = 0.16; x < 1.5; x += 0.0137) {  // the wall's face stands at x = 0.1
    EXPECT_NEAR(field.Clearance({x, 1.03, 0.87}), x - 0.1, field.step() + 1e-9) << x;
    EXPECT_NEAR(field.ClearanceGradient({x, 1.03, 0.87}).x(), x > 0.2 ? 1.0 : 0.75, 0.26) << x;
  }
  EXPECT_EQ(field.State({0.05, 0.5, 0.5}), CellState::kOccupied);
  EXPECT_EQ(field.State({-0.05, 0.5, 0.5}), CellState::kUnknown);
  EXPECT_EQ(field.KnownFreeClearance({-0.05, 0.5, 0.5}), 0.0);
}

}  // namespace
}  // namespace alula::stack::mapping

#pragma once

#include <memory>
#include <vector>

#include "base/frames.h"
#include "stack/mapping/clearance_field.h"
#include "stack/mapping/internal/distance_transform.h"

namespace alula::tests {

/// A map with perfect knowledge of a made-up world of boxes, revealed as a camera would: for planners' tests.
class SyntheticMap {
 public:
  SyntheticMap(const base::Vec3& low_O, const base::Vec3& high_O, double cell = 0.1);

  /// An oriented box of the world: cells whose centre lies in it are occupied.
  void AddBox(const base::Transform& X_OA, const base::Vec3& half_extents);
  /// A square frame about an opening: bars of `bar` × `bar` m.
  void AddGate(const base::Transform& X_OG, double opening, double bar = 0.15);

  void RevealAll();
  /// Cells with centres in the box become known.
  void RevealBox(const base::Vec3& low_O, const base::Vec3& high_O);
  /// What a forward camera (80° × 64°) sees up to `range`, occlusions included.
  void Look(const base::Transform& X_OB, double range);

  std::shared_ptr<const stack::mapping::ClearanceField> Snapshot();

  /// Whether a point lies in an occupied cell of the true world.
  bool Occupied(const base::Vec3& p_O) const;
  /// Distance of a point to the nearest occupied cell's faces, by brute force, cut at `limit`.
  double TrueDistance(const base::Vec3& p_O, double limit) const;

 private:
  void Reveal(int i, int j, int k);

  stack::mapping::GridShape shape_;
  std::vector<bool> occupied_;
  std::vector<stack::mapping::CellState> state_;
  stack::mapping::internal::CellBox changed_;  // since the last snapshot
  stack::mapping::internal::DistanceTransform transform_;
  stack::mapping::ClearanceField field_;
  std::uint64_t revision_ = 0;
};

}  // namespace alula::tests

#pragma once

#include <vector>

#include "scenarios/check/camera_bench.h"

namespace alula::scenarios::check {

/// Poses X_CT of the chequer board before a camera: over the whole image into its corners, tilted up to 30° every way,
/// and some that fill it. The camera's geometry is used for aiming only.
std::vector<base::Transform> BoardPoses(const stack::CameraIntrinsics& camera);

/// True where the whole board with its border lies in the picture.
bool BoardInside(const stack::CameraIntrinsics& camera, const base::Transform& X_CT);

/// Pixels of the inner corners, row by row.
std::vector<base::Vec2> ProjectBoard(const stack::CameraIntrinsics& camera, const base::Transform& X_CT);

/// Inner corner n of the board in the chart's frame, m.
base::Vec3 BoardCorner(int n);

/// A camera group before the board, one pose after another: what was flown and what came out.
struct BoardSession {
  std::vector<base::Transform> X_WB;       // pose of the body, by view
  std::vector<std::vector<Frame>> frames;  // by camera of the group, then by view; of a view that is missing: empty
};
/// Stands still at each pose for as many frames as exposure, rolling and offsets need and some more, whose mean it
/// keeps.
BoardSession RecordBoard(const Rig& isolated, const CameraGroup& group, render::CameraRenderer& renderer);

}  // namespace alula::scenarios::check

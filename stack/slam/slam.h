#pragma once

#include <memory>
#include <vector>

#include "base/frames.h"
#include "base/trajectory_file.h"
#include "stack/estimation/odometry.h"
#include "stack/interface/calibration.h"
#include "stack/slam/map.h"
#include "stack/slam/slam_config.h"

namespace alula::stack::slam {

/// What came of one frame.
struct SlamResult {
  estimation::FrameResult odometry;
  base::Transform X_MO;  // from the odometry frame to the map, as known now
  int loops = 0;         // closed so far
  int joins = 0;         // of parts of the map, so far
  double map_ms = 0.0;   // processor time of the map's part, for reports alone
};

/// Odometry and map together, in one thread: for recorded data, and as the reference of the stack that runs both as
/// jobs. Deterministic.
class Slam {
 public:
  /// `X_MB_start`: position and heading of the body at the start. `known`: a map from before; from when a place of it
  /// is known again on, poses are in its frame. Throws base::InputError where the calibration does not hold what the
  /// estimator needs, and for a map without anything that measures depth.
  Slam(const Calibration& calibration, const SlamConfig& config, const base::Transform& X_MB_start, Map known = {});
  ~Slam();

  SlamResult Process(const estimation::FrameInput& frame);

  /// As it is now; also while the way is lost.
  const Map& map() const;

  /// X_MB of every frame that had one, after all optimisation. To be asked for once, at the end.
  std::vector<base::StampedPose> FinalTrajectory();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace alula::stack::slam

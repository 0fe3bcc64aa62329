#pragma once

#include <memory>
#include <vector>

#include "scenarios/runner.h"
#include "scenarios/slam/estimator_run.h"

namespace alula::scenarios::slam {

/// Estimators that watch one flight, and what was true of it.
struct FlightFeed {
  std::vector<Variant> variants;
  std::vector<EstimatorRun> runs;        // filled when the flight begins
  std::vector<base::StampedPose> truth;  // of the vehicle's body, as often as the IMU samples
};

/// A stack that commands nothing: every frame of the flight is handed to all estimators as it is rendered, once. They
/// know the calibration and the start as wrongly as any stack does.
StackMaker FeedEstimators(std::shared_ptr<FlightFeed> feed);

/// Notes the truth.
SpectatorMaker NoteTruth(std::shared_ptr<FlightFeed> feed);

}  // namespace alula::scenarios::slam

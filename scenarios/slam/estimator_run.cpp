#include "scenarios/slam/estimator_run.h"

#include <algorithm>
#include <utility>

#include "base/processor_clock.h"
#include "stack/slam/map_file.h"

namespace alula::scenarios::slam {

EstimatorRun::EstimatorRun(const Variant& variant, const stack::Calibration& calibration,
                           const base::Transform& X_MB_start)
    : keeps_map_(variant.keeps_map),
      slam_(std::make_unique<stack::slam::Slam>(
          calibration, variant.config, X_MB_start,
          variant.known_map.empty() ? stack::slam::Map{} : stack::slam::LoadMap(variant.known_map))) {
  result_.name = variant.name;
}

void EstimatorRun::Feed(const stack::estimation::FrameInput& frame) {
  const double begin = base::ProcessorMs();
  const stack::slam::SlamResult given = slam_->Process(frame);
  result_.frame_ms.push_back(base::ProcessorMs() - begin - given.map_ms);
  if (given.map_ms > 0.0) result_.keyframe_ms.push_back(given.map_ms);
  result_.frames.push_back(frame.stamp);
  const stack::estimation::FrameResult& odometry = given.odometry;
  result_.resets = odometry.reset_counter;
  result_.loops = std::max(result_.loops, given.loops);
  result_.joins = std::max(result_.joins, given.joins);
  if (odometry.initialised) result_.online.push_back({odometry.state.stamp, given.X_MO * odometry.state.X_OB});
  if (!odometry.note.empty() &&
      std::find(result_.notes.begin(), result_.notes.end(), odometry.note) == result_.notes.end()) {
    result_.notes.push_back(odometry.note);
  }
}

EstimatorResult EstimatorRun::Finish() {
  const double begin = base::ProcessorMs();
  result_.finished = slam_->FinalTrajectory();
  result_.finish_ms = base::ProcessorMs() - begin;
  if (keeps_map_) result_.map = stack::slam::ToBytes(slam_->map());
  return std::move(result_);
}

}  // namespace alula::scenarios::slam

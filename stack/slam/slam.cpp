#include "stack/slam/slam.h"

#include <deque>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/processor_clock.h"
#include "stack/slam/mapper.h"
#include "stack/slam/vocabulary.h"

namespace alula::stack::slam {

using base::Transform;

void Describe(base::Description& d, SlamConfig& c) {
  d.Field("odometry", c.odometry, {.meaning = "visual odometry, with an IMU or without"});
  d.Field("map", c.map, {.meaning = "keyframes and landmarks"});
}

class Slam::Impl {
 public:
  Impl(const Calibration& calibration, const SlamConfig& config, const Transform& X_MB_start, Map known)
      : config_(config),
        odometry_(calibration, config.odometry, X_MB_start),
        mapper_(rig(), config.map, config.map.loop.enabled ? SharedVocabulary() : nullptr, std::move(known)) {
    if (config.map.enabled && rig().depth == features::DepthSource::kNone)
      throw base::InputError("map.enabled: a map needs depth, of a stereo pair or a depth camera; set it to false");
  }

  SlamResult Process(const estimation::FrameInput& frame) {
    SlamResult result;
    result.odometry = odometry_.Process(frame);
    if (!result.odometry.initialised) return result;
    const Transform& X_OB = result.odometry.state.X_OB;
    if (config_.map.enabled && result.odometry.keyframe) {
      const double begin = base::ProcessorMs();
      AddKeyframe(frame, result.odometry);
      result.map_ms = base::ProcessorMs() - begin;
    }
    while (!taught_.empty() && taught_.front().known <= frame.stamp) {
      X_MO_ = taught_.front().X_MO;
      taught_.pop_front();
    }
    result.X_MO = X_MO_;
    result.loops = loops_;
    result.joins = joins_;
    poses_.push_back({result.odometry.state.stamp, last_keyframe_, X_OB_keyframe_.Inverse() * X_OB});
    return result;
  }

  const Map& map() const { return mapper_.map(); }

  std::vector<base::StampedPose> FinalTrajectory() {
    if (config_.map.enabled) mapper_.Finish();
    std::vector<base::StampedPose> trajectory;
    for (const Recorded& pose : poses_) {
      const Transform X_MK = pose.keyframe < 0 ? Transform() : mapper_.PoseOf(pose.keyframe);
      trajectory.push_back({pose.stamp, X_MK * pose.X_KB});
    }
    return trajectory;
  }

 private:
  const features::StereoRig& rig() const { return odometry_.sensors().rig; }

  struct Taught {
    base::Time known;
    Transform X_MO;
  };
  struct Recorded {
    base::Time stamp;
    int keyframe = -1;  // −1: in the odometry frame
    Transform X_KB;
  };

  void AddKeyframe(const estimation::FrameInput& frame, const estimation::FrameResult& odometry) {
    KeyframeInput input;
    input.seq = frame.seq;
    input.stamp = odometry.state.stamp;
    const estimation::NavState& state = odometry.state;
    const estimation::CalibrationEstimate refined = odometry_.RefinedCalibration();
    // The shutter opened a little before or after the stamp: the keyframe is the pose of that instant.
    const double t = refined.time_offset;
    input.X_OB = {(state.X_OB.q * base::Exp(state.w_B * t)).normalized(), state.X_OB.p + state.v_OB * t};
    input.window = odometry.window;
    shutters_.push_back({state.stamp, state.X_OB.Inverse() * input.X_OB});
    while (shutters_.size() > kShutters) shutters_.pop_front();
    for (estimation::KeyframePose& before : input.window) {
      for (const estimation::KeyframePose& s : shutters_) {
        if (s.stamp == before.stamp) before.X_OB = before.X_OB * s.X_OB;
      }
    }
    const base::Quat eye = base::Exp({refined.eye_rotation.x(), refined.eye_rotation.y(), 0.0});
    const Transform &X_BL = odometry_.sensors().X_BC, &X_LR = rig().X_LR;
    input.eyes.X_BL = {X_BL.q * base::Exp(refined.camera_rotation), X_BL.p};
    input.eyes.X_LR = Transform{X_LR.q * eye, X_LR.p};
    input.view = ViewOf(rig(), frame.left, frame.right, config_.map.orb, frame.depth);
    input.upright = odometry_.KnowsVertical();
    X_OB_keyframe_ = input.X_OB;
    const KeyframeReport report = mapper_.Add(std::move(input));
    loops_ += report.loop && !report.joined ? 1 : 0;
    joins_ += report.joined ? 1 : 0;
    taught_.push_back({frame.stamp + base::Seconds(config_.map.latency), report.X_MO});
    last_keyframe_ = report.keyframe;
  }

  SlamConfig config_;
  estimation::Odometry odometry_;
  Mapper mapper_;
  std::deque<Taught> taught_;
  Transform X_MO_;
  int last_keyframe_ = -1;
  int loops_ = 0, joins_ = 0;
  Transform X_OB_keyframe_;
  static constexpr std::size_t kShutters = 32;
  std::deque<estimation::KeyframePose> shutters_;  // of newest keyframes: body at the exposure in the body at the stamp
  std::vector<Recorded> poses_;
};

Slam::Slam(const Calibration& calibration, const SlamConfig& config, const Transform& X_MB_start, Map known)
    : impl_(std::make_unique<Impl>(calibration, config, X_MB_start, std::move(known))) {}
Slam::~Slam() = default;
SlamResult Slam::Process(const estimation::FrameInput& frame) { return impl_->Process(frame); }
const Map& Slam::map() const { return impl_->map(); }
std::vector<base::StampedPose> Slam::FinalTrajectory() { return impl_->FinalTrajectory(); }

}  // namespace alula::stack::slam

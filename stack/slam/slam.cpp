#include "stack/slam/slam.h"

#include <deque>
#include <optional>

#include "stack/slam/mapper.h"

namespace alula::stack::slam {

using base::Transform;

void Describe(base::Description& d, MatchConfig& c) {
  d.Field("radius", c.radius, {.unit = "px", .meaning = "around where a landmark is expected", .min = 1, .max = 200});
  d.Field("near_radius", c.near_radius, {.unit = "px", .meaning = "once the pose is corrected", .min = 1, .max = 100});
  d.Field("max_distance", c.max_distance, {.meaning = "bits of 256 by which descriptors may differ", .min = 1, .max = 256});
  d.Field("ratio", c.ratio, {.meaning = "of the best distance to the second best", .min = 0.1, .max = 1});
  d.Field("max_angle", c.max_angle, {.unit = "rad", .meaning = "between the ways it is and was looked at", .min = 0.1, .max = 3.2});
  d.Field("least", c.least, {.meaning = "matches below which the odometry alone is believed", .min = 3, .max = 1000});
}

void Describe(base::Description& d, AdjustConfig& c) {
  d.Field("keyframes", c.keyframes, {.meaning = "newest ones that move", .min = 1, .max = 100});
  d.Field("covisible", c.covisible, {.meaning = "others that see the same, which move too", .min = 0, .max = 100});
  d.Field("fixed", c.fixed, {.meaning = "keyframes that hold the rest where it is", .min = 1, .max = 500});
  d.Field("iterations", c.iterations, {.meaning = "of Levenberg-Marquardt at a keyframe", .min = 0, .max = 100});
  d.Field("whole_every", c.whole_every, {.meaning = "keyframes after which the whole map is fitted together; 0: never", .min = 0, .max = 100000});
  d.Field("whole_iterations", c.whole_iterations, {.meaning = "of Levenberg-Marquardt then", .min = 1, .max = 100});
  d.Field("final_iterations", c.final_iterations, {.meaning = "of the whole map, at the end", .min = 0, .max = 1000});
  d.Field("pixel_sigma", c.pixel_sigma, {.unit = "px", .meaning = "on the finest level", .min = 0.05, .max = 20});
  d.Field("huber", c.huber, {.meaning = "sigmas beyond which a pull grows no more", .min = 0.1, .max = 100});
  d.Field("gate", c.gate, {.meaning = "sigmas beyond which a sight is dropped", .min = 0.5, .max = 100});
  d.Field("motion_position", c.motion_position, {.unit = "m", .meaning = "1 sigma of the odometry between two keyframes", .min = 1e-5, .max = 1});
  d.Field("motion_drift", c.motion_drift, {.meaning = "besides, share of the way", .min = 0, .max = 1});
  d.Field("motion_angle", c.motion_angle, {.unit = "rad", .meaning = "1 sigma of its turn", .min = 1e-6, .max = 1});
  d.Field("motion_angle_drift", c.motion_angle_drift, {.unit = "rad/s", .meaning = "besides", .min = 0, .max = 1});
  d.Field("vertical", c.vertical, {.unit = "rad", .meaning = "1 sigma of the odometry's vertical", .min = 1e-5, .max = 1});
}

void Describe(base::Description& d, MapConfig& c) {
  d.Field("enabled", c.enabled, {.meaning = "keep a map; off: odometry alone"});
  d.Field("latency", c.latency, {.unit = "s", .meaning = "until what a keyframe taught is known", .min = 0, .max = 10});
  d.Field("features", c.features, {.meaning = "keypoints of a keyframe", .min = 20, .max = 5000});
  d.Field("match", c.match, {.meaning = "finding landmarks again"});
  d.Field("adjust", c.adjust, {.meaning = "fitting keyframes and landmarks together"});
  d.Field("redundant", c.redundant, {.meaning = "share of a keyframe's landmarks that three others see: it goes", .min = 0.1, .max = 2});
}

void Describe(base::Description& d, SlamConfig& c) {
  d.Field("odometry", c.odometry, {.meaning = "stereo-inertial odometry"});
  d.Field("map", c.map, {.meaning = "keyframes and landmarks"});
}

class Slam::Impl {
 public:
  Impl(const Calibration& calibration, const SlamConfig& config, const Transform& X_MB_start)
      : config_(config),
        rig_(features::MakeRig(calibration)),
        X_BL_(calibration.cameras.at(static_cast<std::size_t>((*calibration.stereo)[0])).X_BC),
        odometry_(calibration, config.odometry, X_MB_start),
        mapper_(rig_.left, config.map) {}

  SlamResult Process(const estimation::FrameInput& frame) {
    SlamResult result;
    result.odometry = odometry_.Process(frame);
    if (!result.odometry.initialised) return result;
    const Transform& X_OB = result.odometry.state.X_OB;
    if (config_.map.enabled && result.odometry.keyframe) AddKeyframe(frame, result.odometry);
    while (!taught_.empty() && taught_.front().known <= frame.stamp) {
      X_MO_ = taught_.front().X_MO;
      taught_.pop_front();
    }
    result.X_MO = X_MO_;
    poses_.push_back({result.odometry.state.stamp, last_keyframe_, X_OB_keyframe_.Inverse() * X_OB});
    return result;
  }

  std::vector<StampedPose> FinalTrajectory() {
    if (config_.map.enabled) mapper_.Finish();
    std::vector<StampedPose> trajectory;
    for (const Recorded& pose : poses_) {
      const Transform X_MK = pose.keyframe < 0 ? Transform() : mapper_.PoseOf(pose.keyframe);
      trajectory.push_back({pose.stamp, X_MK * pose.X_KB});
    }
    return trajectory;
  }

 private:
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
    const estimation::CalibrationEstimate rig = odometry_.RefinedCalibration();
    // The shutter opened a little before or after the stamp: the keyframe is the pose of that instant.
    const double t = rig.time_offset;
    input.X_OB = {(state.X_OB.q * base::Exp(state.w_B * t)).normalized(), state.X_OB.p + state.v_OB * t};
    if (last_keyframe_ >= 0 && odometry.X_OB_before) input.X_OB_previous = *odometry.X_OB_before * X_stamp_shutter_;
    X_stamp_shutter_ = state.X_OB.Inverse() * input.X_OB;
    const base::Quat eye = base::Exp({rig.eye_rotation.x(), rig.eye_rotation.y(), 0.0});
    input.eyes.X_BL = {X_BL_.q * base::Exp(rig.camera_rotation), X_BL_.p};
    input.eyes.X_LR = Transform{rig_.X_LR.q * eye, rig_.X_LR.p};
    input.features = FindKeyframeFeatures(frame.left, frame.right, rig_, config_.map.features, config_.odometry.tracker);
    X_OB_keyframe_ = input.X_OB;
    const KeyframeReport report = mapper_.Add(std::move(input));
    taught_.push_back({frame.stamp + base::Seconds(config_.map.latency), report.X_MO});
    last_keyframe_ = report.keyframe;
  }

  SlamConfig config_;
  features::StereoRig rig_;
  Transform X_BL_;
  estimation::StereoInertialOdometry odometry_;
  Mapper mapper_;
  std::deque<Taught> taught_;
  Transform X_MO_;
  int last_keyframe_ = -1;
  Transform X_OB_keyframe_;
  Transform X_stamp_shutter_;  // of the last keyframe: body at the exposure in the body at the stamp
  std::vector<Recorded> poses_;
};

Slam::Slam(const Calibration& calibration, const SlamConfig& config, const Transform& X_MB_start)
    : impl_(std::make_unique<Impl>(calibration, config, X_MB_start)) {}
Slam::~Slam() = default;
SlamResult Slam::Process(const estimation::FrameInput& frame) { return impl_->Process(frame); }
std::vector<StampedPose> Slam::FinalTrajectory() { return impl_->FinalTrajectory(); }

}  // namespace alula::stack::slam

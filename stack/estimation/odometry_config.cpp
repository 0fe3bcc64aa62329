#include "stack/estimation/odometry_config.h"

namespace alula::stack::estimation {

void Describe(base::Description& d, StaticInitConfig& c) {
  d.Field("duration", c.duration, {.unit = "s", .meaning = "of standstill that is averaged", .min = 0.2, .max = 30});
  d.Field("max_median_flow", c.max_median_flow,
          {.unit = "px", .meaning = "against the first image of the standstill", .min = 0.05, .max = 5});
  d.Field("min_features", c.min_features, {.meaning = "fewer corners say nothing about motion", .min = 4});
}

void Describe(base::Description& d, WindowConfig& c) {
  d.Field("solver", c.solver, {.meaning = "who solves it", .choices = {"schur", "ceres"}});
  d.Field("frames", c.frames, {.meaning = "states in the window", .min = 4, .max = 40});
  d.Field("recent_frames", c.recent_frames,
          {.meaning = "newest frames kept whether keyframes or not", .min = 1, .max = 20});
  d.Field("iterations", c.iterations, {.meaning = "of Levenberg-Marquardt a frame", .min = 1, .max = 50});
  d.Field("pixel_sigma", c.pixel_sigma, {.unit = "px", .meaning = "of a corner's position", .min = 0.05, .max = 10});
  d.Field("huber", c.huber, {.meaning = "width of the kernel in sigmas", .min = 0.1, .max = 100});
  d.Field("outlier_gate", c.outlier_gate,
          {.unit = "px", .meaning = "final error beyond which a sight is dropped", .min = 0.5, .max = 100});
  d.Field("min_depth", c.min_depth, {.unit = "m", .meaning = "nearer landmarks are not made", .min = 0.01});
  d.Field("max_depth", c.max_depth, {.unit = "m", .meaning = "a landmark begins no farther", .min = 1});
  d.Field("min_ray_angle", c.min_ray_angle,
          {.unit = "rad", .meaning = "between one camera's rays before a depth is believed", .min = 1e-4, .max = 1});
  d.Field("consumed_share", c.consumed_share,
          {.meaning = "of followed landmarks of a leaving keyframe that go into the prior", .min = 0, .max = 1});
  d.Field("imu_noise_scale", c.imu_noise_scale, {.meaning = "on the calibrated densities", .min = 0.1, .max = 100});
  d.Field("tilt_sigma", c.tilt_sigma, {.unit = "rad", .meaning = "of the first attitude", .min = 1e-4, .max = 1});
  d.Field("camera_rotation_sigma", c.camera_rotation_sigma,
          {.unit = "rad", .meaning = "camera against IMU", .min = 1e-6, .max = 0.5});
  d.Field("eye_rotation_sigma", c.eye_rotation_sigma,
          {.unit = "rad", .meaning = "one eye against the other", .min = 1e-6, .max = 0.5});
  d.Field("time_offset_sigma", c.time_offset_sigma,
          {.unit = "s", .meaning = "camera clock against IMU clock", .min = 1e-6, .max = 0.5});
  d.Field("refine_calibration", c.refine_calibration, {.meaning = "estimate those three while flying"});
  d.Field("first_estimates", c.first_estimates,
          {.meaning = "keep the prior's Jacobians where a state first entered it"});
  d.Check("recent_frames", [&c] {
    return c.recent_frames + 2 <= c.frames ? "" : "recent_frames must leave two of the window's frames to keyframes";
  });
}

void Describe(base::Description& d, MotionConfig& c) {
  d.Field("acceleration", c.acceleration,
          {.unit = "m/s^2/sqrt(Hz)", .meaning = "white noise on a steady speed", .min = 1e-3, .max = 1e3});
  d.Field("turn", c.turn, {.unit = "rad/s/sqrt(Hz)", .meaning = "likewise on a turn rate", .min = 1e-3, .max = 1e3});
  d.Field("max_blind_time", c.max_blind_time, {.unit = "s", .meaning = "with too few inliers", .min = 0.05});
}

void Describe(base::Description& d, LinesConfig& c) {
  d.Field("enabled", c.enabled, {.meaning = "lines beside points"});
  d.Field("detect", c.detect, {.meaning = "how segments are found"});
  d.Field("stereo", c.stereo, {.meaning = "how they are found in the right image"});
  d.Field("track", c.track, {.meaning = "how they are followed"});
  d.Field("sigma", c.sigma, {.unit = "px", .meaning = "of an end across its segment", .min = 0.05, .max = 50});
  d.Field(
      "max_direction", c.max_direction,
      {.unit = "rad", .meaning = "of its direction, 1 sigma: known worse, a line stays out", .min = 1e-3, .max = 3});
  d.Field("max_place", c.max_place, {.unit = "m", .meaning = "of its place, likewise", .min = 1e-3, .max = 100});
}

void Describe(base::Description& d, KeyframeConfig& c) {
  d.Field("min_parallax", c.min_parallax,
          {.unit = "px", .meaning = "median, rotation removed, that makes a keyframe", .min = 0.5});
  d.Field("max_flow", c.max_flow, {.unit = "px", .meaning = "median that makes a keyframe", .min = 1});
  d.Field("min_track_share", c.min_track_share,
          {.meaning = "of the reference's corners; fewer make a keyframe", .min = 0, .max = 1});
  d.Field("min_tracks", c.min_tracks, {.meaning = "fewer make a keyframe", .min = 0});
  d.Field("max_age", c.max_age, {.unit = "s", .meaning = "of the last keyframe", .min = 0.1});
}

void Describe(base::Description& d, GuardConfig& c) {
  d.Field("saturation", c.saturation,
          {.meaning = "of the IMU's range, from which a reading counts for little", .min = 0.5, .max = 1});
  d.Field("frozen_turn", c.frozen_turn,
          {.unit = "rad",
           .meaning = "turn of the body while an image repeats itself from which it counts as frozen",
           .min = 1e-5,
           .max = 1});
  d.Field("eye_delay", c.eye_delay, {.unit = "s", .meaning = "between the eyes that is told", .min = 1e-4, .max = 1});
  d.Field("compensate_eye_delay", c.compensate_eye_delay, {.meaning = "move what the right eye saw back by it"});
}

void Describe(base::Description& d, FailureConfig& c) {
  d.Field("max_blind_time", c.max_blind_time, {.unit = "s", .meaning = "with too few inliers", .min = 0.1});
  d.Field("max_imu_gap", c.max_imu_gap,
          {.unit = "s", .meaning = "between inertial samples; a longer one begins anew", .min = 0.005, .max = 10});
  d.Field("min_inliers", c.min_inliers, {.meaning = "fewer count as blind", .min = 0});
  d.Field("max_gyro_bias", c.max_gyro_bias, {.unit = "rad/s", .meaning = "beyond: failed", .min = 1e-3});
  d.Field("max_accel_bias", c.max_accel_bias, {.unit = "m/s^2", .meaning = "beyond: failed", .min = 1e-3});
  d.Field("max_speed", c.max_speed, {.unit = "m/s", .meaning = "beyond: failed", .min = 0.1});
  d.Field("max_jump", c.max_jump, {.unit = "m", .meaning = "of the solution against the IMU in a frame", .min = 0.01});
}

void Describe(base::Description& d, OdometryConfig& c) {
  d.Field("sensors", c.sensors, {.meaning = "what it looks at"});
  d.Field("tracker", c.tracker, {.meaning = "how corners are found and followed"});
  d.Field("static_init", c.static_init, {.meaning = "how standstill is judged"});
  d.Field("window", c.window, {.meaning = "the sliding window and its noise model"});
  d.Field("motion", c.motion, {.meaning = "what is expected of motion without an IMU"});
  d.Field("lines", c.lines, {.meaning = "straight edges beside corners"});
  d.Field("keyframe", c.keyframe, {.meaning = "when a keyframe is due"});
  d.Field("guard", c.guard, {.meaning = "signs that what comes in cannot be believed"});
  d.Field("failure", c.failure, {.meaning = "signs that the estimate has failed"});
}

}  // namespace alula::stack::estimation

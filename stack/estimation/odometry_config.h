#pragma once

#include "base/describe.h"
#include "stack/estimation/sensor_set.h"
#include "stack/features/line_stereo.h"
#include "stack/features/line_tracks.h"
#include "stack/features/stereo_tracker_config.h"

namespace alula::stack::estimation {

/// Standstill initialisation: how the odometry judges, by images alone, that the vehicle stands.
struct StaticInitConfig {
  double duration = 1.0;         // s of standstill that are averaged
  double max_median_flow = 0.5;  // px against the first image of the standstill; noise alone gives ≈ 0.1
  int min_features = 6;          // fewer say nothing about motion
};

/// Who solves the window: our own elimination of landmarks, or Ceres, its reference.
enum class WindowSolver { kSchur, kCeres };

/// The sliding window and its noise model.
struct WindowConfig {
  WindowSolver solver = WindowSolver::kSchur;
  int frames = 10;                        // states in the window; more: slower, hardly better
  int recent_frames = 3;                  // newest frames kept whether keyframes or not; they pin the velocity
  int iterations = 3;                     // of Levenberg–Marquardt a frame; a fourth changes no error
  double pixel_sigma = 1.0;               // px; KLT alone has ≈ 0.3, the rest is what calibration leaves
  double huber = 1.5;                     // in sigmas
  double outlier_gate = 4.0;              // px of final residual beyond which an observation is dropped
  double min_depth = 0.15;                // m; nearer landmarks are dropped
  double max_depth = 80.0;                // m; a landmark begins no farther
  double min_ray_angle = 0.02;            // rad: what one camera's rays must make before a depth is believed
  double consumed_share = 0.5;            // of live tracks seen by a leaving keyframe that go into the prior
  double imu_noise_scale = 1.5;           // on the calibrated densities: vibration, sampling
  double tilt_sigma = 0.035;              // rad, of the first state; the accelerometer decides
  double camera_rotation_sigma = 0.0035;  // rad (0.2°), of X_BC's rotation
  double eye_rotation_sigma = 0.00035;    // rad (0.02°), of one eye against the other
  double time_offset_sigma = 0.002;       // s
  bool refine_calibration = true;         // estimate those three online
  bool first_estimates = true;            // priors linearised where a state first entered one; off: for comparison
};

/// What is taken for granted of motion where no IMU measures it: speed and turn rate go on as they are, but for white
/// noise (a Gaussian process with white noise on acceleration; Anderson and Barfoot 2015). It stands where inertial
/// samples would, without gravity.
struct MotionConfig {
  double acceleration = 2.0;    // m/s²/√Hz
  double turn = 0.3;            // rad/s/√Hz, of the rate
  double max_blind_time = 0.5;  // s with fewer than `failure.min_inliers`: after that nothing is known of the way
};

/// Lines beside points.
struct LinesConfig {
  bool enabled = false;
  features::LineConfig detect;
  features::LineStereoConfig stereo;
  features::LineTrackConfig track;
  double sigma = 1.5;           // px, of an end across its segment: distortion bends, merging shifts
  double max_direction = 0.07;  // rad (4°): a line that is known worse does not enter the solver,
  double max_place = 0.25;      // m       nor one whose place is
};

/// When a new keyframe is due.
struct KeyframeConfig {
  double min_parallax = 12.0;     // px, median, rotation removed
  double max_flow = 80.0;         // px, median: patches deform beyond
  double min_track_share = 0.65;  // of the tracks that the reference keyframe had
  int min_tracks = 60;
  double max_age = 5.0;  // s
};

/// Signs that what comes in cannot be believed.
struct GuardConfig {
  double saturation = 0.98;    // of the IMU's range
  double frozen_turn = 0.005;  // rad that the body turned while the image stayed the same to the last bit
  double eye_delay = 0.003;    // s between the eyes that are worth a word
  bool compensate_eye_delay = true;
};

/// Signs that the estimate has failed.
struct FailureConfig {
  double max_blind_time = 4.0;  // s with fewer than `min_inliers`, or without images
  double max_imu_gap = 0.1;     // s between inertial samples: what happened in between is not known
  int min_inliers = 8;
  double max_gyro_bias = 0.3;   // rad/s
  double max_accel_bias = 3.0;  // m/s²
  double max_speed = 30.0;      // m/s
  double max_jump = 1.0;        // m between the IMU's prediction and the solution
};

struct OdometryConfig {
  SensorsConfig sensors;
  features::StereoTrackerConfig tracker;
  StaticInitConfig static_init;
  WindowConfig window;
  MotionConfig motion;
  LinesConfig lines;
  KeyframeConfig keyframe;
  GuardConfig guard;
  FailureConfig failure;
};

void Describe(base::Description& d, StaticInitConfig& c);
void Describe(base::Description& d, WindowConfig& c);
void Describe(base::Description& d, MotionConfig& c);
void Describe(base::Description& d, LinesConfig& c);
void Describe(base::Description& d, KeyframeConfig& c);
void Describe(base::Description& d, GuardConfig& c);
void Describe(base::Description& d, FailureConfig& c);
void Describe(base::Description& d, OdometryConfig& c);

}  // namespace alula::stack::estimation

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "stack/estimation/odometry_config.h"
#include "stack/interface/calibration.h"
#include "stack/interface/measurement.h"
#include "stack/interface/navigation_stack.h"

namespace alula::stack::estimation {

/// One IMU sample in the IMU frame I: angular velocity (rad/s) and specific force (m/s²), biases in.
struct TimedImu {
  base::Time time;
  base::Vec3 gyro = base::Vec3::Zero();
  base::Vec3 accel = base::Vec3::Zero();
};

/// What was seen at one instant and the inertial samples that lead to it. What a vehicle does not have stays empty.
struct FrameInput {
  std::uint32_t seq = 0;
  base::Time stamp;    // of all images, in IMU time (captured + nominal offset)
  Image left, right;   // 8-bit grey; a camera without a partner is the left one
  DepthImage depth{};  // as the left camera sees it
  /// All samples newer than those of the previous frame, at least up to the first one at or after `stamp`, in order.
  std::vector<TimedImu> imu{};
};

/// Motion of the body at an instant, and the IMU's biases. The odometry frame O is z up; its origin and heading are
/// those of the pose that the odometry was started with.
struct NavState {
  base::Time stamp;
  base::Transform X_OB;
  base::Vec3 v_OB = base::Vec3::Zero();
  base::Vec3 w_B = base::Vec3::Zero();         // rad/s
  base::Vec3 gyro_bias = base::Vec3::Zero();   // rad/s, IMU frame
  base::Vec3 accel_bias = base::Vec3::Zero();  // m/s², IMU frame
};

/// A keyframe of the window as it is known now.
struct KeyframePose {
  base::Time stamp;
  base::Transform X_OB;
};

struct FrameResult {
  std::uint32_t seq = 0;
  bool initialised = false;
  NavState state;
  base::Mat6 pose_covariance = base::Mat6::Zero();  // of (δp in O, δθ in B), m², rad²
  base::Mat3 velocity_covariance = base::Mat3::Zero();
  std::uint32_t reset_counter = 0;  // grows when the state was re-initialised
  bool keyframe = false;            // the window keeps this frame
  /// With a keyframe: where those before it that the window still holds are now known to be, oldest first; empty after
  /// a (re)start.
  std::vector<KeyframePose> window;
  std::vector<FeatureView> features;
  int tracked = 0;   // corners followed into this image
  int inliers = 0;   // of them, those that agree with the motion
  std::string note;  // why not initialised, or in what way degraded; else empty
};

/// What is estimated of the calibration while flying; added to the nominal one.
struct CalibrationEstimate {
  base::Vec3 camera_rotation = base::Vec3::Zero();  // rad, in the left camera's axes
  base::Vec2 eye_rotation = base::Vec2::Zero();     // rad about x and y of the right camera
  double time_offset = 0.0;                         // s, added to the image stamps
  double eye_delay = 0.0;                           // s, of the right eye; as usual of late
};

/// Processor time of the calling thread by stage in ms, for profiling; never enters a result.
struct OdometryTiming {
  double track = 0.0, detect = 0.0, solve = 0.0, covariance = 0.0, marginalise = 0.0;
  std::uint64_t frames = 0;
};

/// Visual odometry from a stereo pair, a depth camera or one camera, with or without an IMU: a sliding window of poses,
/// velocities, biases and landmarks, solved in the least-squares sense (Leutenegger et al. 2015; Qin et al. 2018;
/// Forster et al. 2017; Usenko et al. 2020). One call a frame:
///
///   track corners from the reference keyframe (prediction by the IMU) → reject what does not move rigidly
///   → new keyframe? find corners, match left to right → solve the window → drop outliers → slide the window.
///
/// With an IMU `initialised` is false until the vehicle has stood still for a second, and `note` says why; one camera
/// with an IMU holds its place until it moves. Without an IMU it begins at once, level is what the start says, and
/// motion is expected to go on as it is (MotionConfig). Deterministic, one thread.
class Odometry {
 public:
  /// `X_OB_start`: position and heading of the body at the start; roll and pitch come from gravity where there is an
  /// IMU. Throws base::InputError as ChooseSensors does, and for lines without a stereo pair.
  Odometry(const Calibration& calibration, const OdometryConfig& config, const base::Transform& X_OB_start);
  ~Odometry();
  Odometry(Odometry&&) noexcept;
  Odometry& operator=(Odometry&&) noexcept;

  FrameResult Process(const FrameInput& input);

  const SensorSet& sensors() const;
  bool KnowsVertical() const { return sensors().imu.has_value(); }

  CalibrationEstimate RefinedCalibration() const;
  OdometryTiming Timing() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace alula::stack::estimation

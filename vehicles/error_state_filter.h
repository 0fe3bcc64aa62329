#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>

#include "base/describe.h"
#include "base/frames.h"
#include "base/time.h"
#include "stack/interface/measurement.h"
#include "stack/interface/navigation_stack.h"
#include "vehicles/inertial_error_model.h"

namespace alula::vehicles {

/// Noise of the autopilot's sensors as the filter believes it (continuous-time densities), and what it takes from the
/// stack's estimates.
struct ErrorStateFilterConfig {
  double gyro_noise = 3e-4;                  // rad/s/√Hz; a consumer IMU on a shaking airframe
  double accelerometer_noise = 6e-3;         // m/s²/√Hz
  double gyro_bias_walk = 2e-5;              // rad/s²/√Hz
  double accelerometer_bias_walk = 3e-4;     // m/s³/√Hz
  double gyro_turn_on_bias = 0.02;           // rad/s, 1σ before the filter has learnt it
  double accelerometer_turn_on_bias = 0.15;  // m/s², 1σ
  double barometer_noise = 0.4;              // m, 1σ; weak on purpose: vision leads
  double barometer_drift = 0.05;             // m/√s, walk of the barometer's offset from the odometry's height
  /// Estimates closer than this to the last one fused are skipped: their errors are too much alike to count twice.
  base::Duration vision_interval = base::Milliseconds(15);
  double vision_position_floor = 0.01;  // m, least 1σ believed
  double vision_velocity_floor = 0.03;  // m/s
  double vision_yaw_floor = 0.005;      // rad
  double gate = 4.0;                    // chi-square gate of an innovation, as the one-sided quantile of a normal, σ
  /// Estimates rejected for this long re-initialise position, velocity and yaw, and let tilt and biases be learned
  /// anew: the filter must be what is wrong.
  base::Duration rejection_timeout = base::Milliseconds(800);
  /// The filter itself stands at most this far behind the present while vision is silent; older estimates are dropped.
  base::Duration horizon = base::Milliseconds(400);
  base::Duration standstill = base::Milliseconds(500);  // averaged for the first attitude and gyro bias
  double standstill_gyro = 0.06;                        // rad/s, 1σ of the readings above which it is no standstill
  double standstill_accelerometer = 0.6;                // m/s²
};
void Describe(base::Description& d, ErrorStateFilterConfig& c);

/// Error-state Kalman filter of a multicopter: 15 inertial states and the barometer's offset. It stands at the stamp of
/// the last estimate that it fused; from there its nominal state is carried to the present through the buffered IMU
/// samples, so that an estimate that arrives late is fused at the instant that it describes and what happened since is
/// replayed. (Delayed horizon as in PX4's EKF2, with exact replay in place of its output predictor.)
class ErrorStateFilter {
 public:
  explicit ErrorStateFilter(const ErrorStateFilterConfig& config);

  /// One tick: a sample that holds since the last tick. `barometric_height`: m above where the vehicle stood.
  void AddInertial(base::Time now, const stack::ImuSample& imu, std::optional<double> barometric_height);

  /// What the stack says. Position, yaw and, where velocity_covariance is not zero, velocity are fused with their
  /// covariance behind a chi-square gate. Tilt is the filter's own. A new reset_counter re-initialises position,
  /// velocity and yaw.
  void AddEstimate(base::Time now, const stack::Estimate& estimate);

  bool initialised() const { return initialised_; }
  /// State at the last tick.
  const NavigationState& state() const { return present_; }
  /// State and covariance where the filter stands.
  const NavigationState& delayed_state() const { return delayed_; }
  const ErrorMatrix& covariance() const { return covariance_; }
  base::Time delayed_time() const { return delayed_time_; }

  /// Arrival of the last estimate that was fused or that re-initialised.
  std::optional<base::Time> last_fused() const { return last_fused_; }
  /// Grows whenever the state jumps by re-initialisation; `last_jump` is how p_OB and yaw moved.
  std::uint32_t jumps() const { return jumps_; }
  struct Jump {
    base::Vec3 position = base::Vec3::Zero();
    double yaw = 0.0;
  };
  const Jump& last_jump() const { return last_jump_; }
  std::uint64_t rejected() const { return rejected_; }

 private:
  struct Sample {
    base::Time start, end;
    stack::ImuSample imu;
    std::optional<double> barometric_height;  // at `end`
  };
  /// Running moments of the IMU while the vehicle may stand still.
  struct Standstill {
    int count = 0;
    base::Vec3 gyro_sum = base::Vec3::Zero(), force_sum = base::Vec3::Zero();
    base::Vec3 gyro_squares = base::Vec3::Zero(), force_squares = base::Vec3::Zero();
  };

  void WatchStandstill(base::Time now, const stack::ImuSample& imu);
  void Initialise(const stack::Estimate& estimate);
  /// The IMU is not what the filter takes it for: lets tilt and biases be learned anew.
  void Doubt();
  void Reinitialise(const stack::Estimate& estimate);
  void Forget(int block, int size);
  void AdvanceTo(base::Time target);
  void PropagateCovariance(const base::Quat& q_start, const InertialStretch& stretch);
  void FuseHeight(double barometric_height);
  bool FuseEstimate(const stack::Estimate& estimate);
  void Inject(const ErrorVector& delta);
  void Replay();

  ErrorStateFilterConfig config_;
  double gate_pose_;      // chi-square of 4 degrees of freedom: position and yaw
  double gate_velocity_;  // of 3
  double gate_height_;    // of 1
  bool initialised_ = false;
  bool stands_still_ = false;
  Standstill standstill_;
  base::Time standstill_since_;
  base::Vec3 still_gyro_ = base::Vec3::Zero(), still_force_ = base::Vec3::Zero();  // means of the last stretch
  std::optional<double> still_height_;

  NavigationState delayed_;
  base::Time delayed_time_;
  ErrorMatrix covariance_ = ErrorMatrix::Zero();
  NavigationState present_;
  base::Time present_time_;
  bool has_tick_ = false;

  std::deque<Sample> samples_;  // those that end after delayed_time_

  std::uint32_t reset_counter_ = 0;
  std::optional<base::Time> last_fused_;
  std::optional<base::Time> last_stamp_;
  std::optional<base::Time> rejecting_since_;
  std::uint32_t jumps_ = 0;
  Jump last_jump_;
  std::uint64_t rejected_ = 0;
};

}  // namespace alula::vehicles

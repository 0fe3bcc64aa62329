#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/describe.h"
#include "base/frames.h"
#include "base/time.h"
#include "stack/interface/measurement.h"
#include "stack/interface/navigation_stack.h"

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
  double gate_probability = 0.9999;     // chi-square gate of an innovation
  /// Estimates rejected for this long re-initialise position, velocity and yaw: the filter must be what is wrong.
  base::Duration rejection_timeout = base::Milliseconds(800);
  /// The filter itself stands at most this far behind the present while vision is silent; older estimates are dropped.
  base::Duration horizon = base::Milliseconds(400);
  base::Duration standstill = base::Milliseconds(500);  // averaged for the first attitude and gyro bias
  double standstill_gyro = 0.06;                        // rad/s, 1σ of the readings above which it is no standstill
  double standstill_accelerometer = 0.6;                // m/s²
};
void Describe(base::Description& d, ErrorStateFilterConfig& c);

/// Layout of the error state: right perturbation R = R̂ Exp(δθ), everything else additive.
struct ErrorLayout {
  static constexpr int kPosition = 0;           // δp_OB, m
  static constexpr int kVelocity = 3;           // δv_OB, m/s
  static constexpr int kRotation = 6;           // δθ, rad, body axes
  static constexpr int kAccelerometerBias = 9;  // δb_a, m/s²
  static constexpr int kGyroBias = 12;          // δb_g, rad/s
  static constexpr int kBarometer = 15;         // δb_h, m: barometric height minus odometry height
  static constexpr int kSize = 16;
};
using ErrorVector = Eigen::Matrix<double, ErrorLayout::kSize, 1>;
using ErrorMatrix = Eigen::Matrix<double, ErrorLayout::kSize, ErrorLayout::kSize>;

/// The nominal state.
struct NavigationState {
  base::Vec3 p_OB = base::Vec3::Zero();
  base::Vec3 v_OB = base::Vec3::Zero();
  base::Quat q_OB = base::Quat::Identity();
  base::Vec3 accelerometer_bias = base::Vec3::Zero();
  base::Vec3 gyro_bias = base::Vec3::Zero();
  double barometer_offset = 0.0;
};

/// x ⊞ δ.
NavigationState Plus(const NavigationState& x, const ErrorVector& delta);
/// δ with x ⊞ δ = y.
ErrorVector Minus(const NavigationState& y, const NavigationState& x);

/// One IMU sample held for dt (s), attitude at mid-interval for the specific force:
///   a = R Exp(½ ω dt) (f − b_a) + g,  p += v dt + ½ a dt²,  v += a dt,  R ← R Exp(ω dt),  ω = w − b_g.
void Propagate(NavigationState& x, const stack::ImuSample& imu, double dt);

/// Motion over a stretch of IMU samples from its first attitude R_0, gravity excluded.
struct InertialStretch {
  double duration = 0.0;                         // s
  base::Vec3 velocity = base::Vec3::Zero();      // R_0ᵀ ∫ R f
  base::Vec3 displacement = base::Vec3::Zero();  // R_0ᵀ ∬ R f
  base::Quat rotation = base::Quat::Identity();  // R_0ᵀ R_1
  void Add(const NavigationState& x, const stack::ImuSample& imu, double dt);
};

/// Transition of the error state over a stretch (Solà 2017, eqs. 269–270, extended from one sample to a stretch of a
/// few milliseconds; bias columns to second order in its duration).
ErrorMatrix Transition(const base::Quat& q_OB_start, const InertialStretch& stretch);

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
  class Standstill {
   public:
    void Add(const stack::ImuSample& imu);
    void Clear() { *this = Standstill(); }
    int count = 0;
    base::Vec3 gyro_sum = base::Vec3::Zero(), force_sum = base::Vec3::Zero();
    base::Vec3 gyro_squares = base::Vec3::Zero(), force_squares = base::Vec3::Zero();
  };

  void WatchStandstill(base::Time now, const stack::ImuSample& imu);
  void Initialise(base::Time now, const stack::Estimate& estimate);
  void Reinitialise(base::Time now, const stack::Estimate& estimate);
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
  base::Vec3 still_gyro_ = base::Vec3::Zero(), still_force_ = base::Vec3::Zero();

  NavigationState delayed_;
  base::Time delayed_time_;
  ErrorMatrix covariance_ = ErrorMatrix::Zero();
  NavigationState present_;
  base::Time present_time_;
  bool has_tick_ = false;

  std::vector<Sample> ring_;  // samples that end after delayed_time_: ring_[first_], …
  std::size_t first_ = 0, size_ = 0;

  std::uint32_t reset_counter_ = 0;
  std::optional<base::Time> last_fused_;
  std::optional<base::Time> last_stamp_;
  std::optional<base::Time> rejecting_since_;
  std::uint32_t jumps_ = 0;
  Jump last_jump_;
  std::uint64_t rejected_ = 0;
};

}  // namespace alula::vehicles

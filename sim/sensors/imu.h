#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "base/describe.h"
#include "base/random.h"
#include "base/time.h"
#include "sim/sensors/imu_errors.h"
#include "sim/sensors/rotor_vibration.h"
#include "stack/interface/calibration.h"
#include "vehicles/vehicle.h"

namespace alula::sim {

/// Values of the class of an ADIS16448 (Analog Devices data sheet, rev. F); turn-on biases are those left after a
/// factory calibration.
struct ImuConfig {
  base::Rate rate{200, 1};
  base::Vec3 position = base::Vec3::Zero();     // p_BI, m
  base::Vec3 orientation = base::Vec3::Zero();  // of I in B: yaw, pitch, roll, rad
  double bandwidth = 90.0;  // −3 dB of a second-order Butterworth low-pass, Hz; below half the rate
  stack::ImuNoise noise{.gyro_noise = 1.7e-4,
                        .accelerometer_noise = 2.0e-3,
                        .gyro_bias_walk = 2.0e-5,
                        .accelerometer_bias_walk = 3.0e-3,
                        .gyro_turn_on_bias = 3.0e-3,
                        .accelerometer_turn_on_bias = 0.05,
                        .gyro_range = 17.5,             // 1000 deg/s
                        .accelerometer_range = 176.5};  // 18 g
  std::optional<ImuErrors> errors{};                    // none: bias and noise are all that is wrong
};
void Describe(base::Description& d, ImuConfig& c);
/// The autopilot's own: 1 kHz and wide, so that the rate loop keeps its phase.
ImuConfig AutopilotImuDefaults();

/// An inertial measurement unit at a lever arm, driven by what the physics did, contacts included:
///
///   f_I = R_IW (Δv_WI/Δt − g_W),   w_I = R_IB w_B   over each physics step,
///   measured = clamp(lowpass(true) + b + n),   n ~ N(0, density²·rate),   b_{k+1} = b_k + N(0, walk²/rate).
///
/// What else is wrong with a unit: imu_errors.h.
/// The low-pass runs at the physics rate and delays by `delay()`; stamps are set back by as much, as drivers do.
class Imu {
 public:
  /// Streams of random numbers: "<name>.gyro", "<name>.accelerometer", "<name>.bias", "<name>.vibration".
  Imu(const ImuConfig& config, base::Duration physics_step, std::uint64_t seed, const std::string& name);

  /// Sets the filter as after a long rest in this state.
  void Settle(const vehicles::BodyState& state);
  /// Takes in one physics step; the rotors as they turn at its end.
  void Integrate(const vehicles::BodyState& before, const vehicles::BodyState& after,
                 std::span<const vehicles::RotorState> rotors = {});
  /// One output sample, taken `ago` before the end of the last step; call it once per period of the rate.
  stack::ImuSample Sample(base::Duration ago = {});

  /// Group delay at low frequency: half a physics step for the difference, √2/ω₀ for the filter.
  base::Duration delay() const { return delay_; }
  /// What the next sample adds, the temperature's share included.
  base::Vec3 gyro_bias() const;
  base::Vec3 accelerometer_bias() const;

 private:
  /// Second-order section, direct form II transposed.
  struct LowPass {
    double b0 = 1, b1 = 0, b2 = 0, a1 = 0, a2 = 0;
    base::Vec6 s1 = base::Vec6::Zero(), s2 = base::Vec6::Zero();
    base::Vec6 out = base::Vec6::Zero();
    void Push(const base::Vec6& in);
    void Settle(const base::Vec6& in);
  };

  /// K above the temperature of calibration at the next sample.
  double Warmth() const;
  /// What the sensing axes read of the filtered truth.
  base::Vec6 Sensed(base::Duration ago) const;

  ImuConfig config_;
  base::Duration step_;
  base::Duration delay_;
  base::Transform X_BI_;
  LowPass filter_;
  base::RandomStream gyro_stream_, accelerometer_stream_, bias_stream_;
  base::Vec3 gyro_bias_, accelerometer_bias_;
  std::optional<RotorVibration> vibration_;
  std::int64_t samples_ = 0;
};

}  // namespace alula::sim

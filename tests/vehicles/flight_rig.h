#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "base/random.h"
#include "vehicles/multicopter_autopilot.h"
#include "vehicles/quadrotor.h"

namespace alula::vehicles {

/// Rigid body at 1 kHz by semi-implicit Euler, in free air above a ground plane at z = 0 that carries the four legs by
/// springs; for closed loops in tests, where no physics engine is wanted.
class RigidBodyRig {
 public:
  explicit RigidBodyRig(const VehicleBody& body);

  /// Returns the mean specific force over the step, body axes, m/s².
  base::Vec3 Step(const Wrench& wrench, double dt);

  BodyState state;
  bool ground = true;

 private:
  Wrench Contact() const;

  double mass_;
  base::Mat3 inertia_;
  base::Mat3 inverse_inertia_;
  std::vector<base::Vec3> feet_B_;
};

struct RigOptions {
  std::uint64_t seed = 1;
  double mass = 0.75;  // kg, of the vehicle that flies
  // The stack's estimates: rate, age at arrival, white noise (1σ).
  base::Duration vision_period = base::Milliseconds(20);
  base::Duration vision_delay = base::Milliseconds(20);
  double vision_position_noise = 0.0;  // m
  double vision_attitude_noise = 0.0;  // rad
  double vision_velocity_noise = 0.0;  // m/s
  bool vision_velocity = true;         // whether estimates carry a velocity
  base::Duration command_delay = base::Milliseconds(5);
  base::Vec3 wind = base::Vec3::Zero();
  double gust = 0.0;  // m/s, 1σ, correlated over 2 s
  bool sensor_noise = true;
  MulticopterAutopilotConfig autopilot;
};

/// Quadrotor, autopilot and stack's estimates in one loop.
class FlightRig {
 public:
  explicit FlightRig(const RigOptions& options);

  /// One millisecond.
  void Step();
  /// `each` is called before every step with the time.
  void RunFor(double seconds, const std::function<void(base::Time)>& each = nullptr);

  void Send(const stack::Command& command) { commands_.push_back({now + options_.command_delay, command}); }
  template <typename What>
  void Send(const What& what, base::Duration valid = base::Milliseconds(300)) {
    Send(stack::Command{what, now, now + valid});
  }
  /// Arms and climbs to (0, 0, height).
  void TakeOff(double height, double seconds);

  base::Time now;
  RigidBodyRig body;
  AutopilotOutput output;
  bool vision = true;    // whether estimates are sent
  base::Transform X_OW;  // the stack's odometry frame, as it is now
  std::uint32_t reset_counter = 0;
  std::unique_ptr<VehicleModel> vehicle;
  std::unique_ptr<Autopilot> autopilot;

 private:
  AutopilotSensors Measure(const base::Vec3& specific_force);
  void SendEstimate();
  base::Vec3 Wind(double dt);

  struct Late {
    base::Time due;
    stack::Command command;
  };
  struct LateEstimate {
    base::Time due;
    stack::Estimate estimate;
  };

  RigOptions options_;
  base::RandomStream noise_, vision_noise_, gusts_;
  base::Vec3 gyro_bias_, accelerometer_bias_, gust_ = base::Vec3::Zero();
  base::Vec3 specific_force_{0, 0, base::kGravity};
  std::deque<Late> commands_;
  std::deque<LateEstimate> estimates_;
};

}  // namespace alula::vehicles

#include "worlds/actors/sway.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "worlds/actors/grass.h"

namespace alula::worlds {
namespace {

using base::Vec2;
using base::Vec3;

constexpr double kAirDensity = 1.225;  // kg/m³

/// Velocity of the air at a tuft's root.
Vec2 AirAt(const Vec3& root, double gust, const ActorStimulus& vehicle) {
  constexpr double kNearGround = 0.5;
  constexpr double kGusts = 0.3;
  constexpr double kFar = 6.0;  // m
  Vec2 air = kNearGround * (1.0 + kGusts * gust) * vehicle.wind_W.head<2>();
  const Vec3 from_vehicle = root - vehicle.p_WB;
  const double height = -from_vehicle.z();
  const double distance = from_vehicle.head<2>().norm();
  if (vehicle.thrust <= 0.0 || height <= 0.0 || height > kFar || distance > kFar || distance < 1e-6) return air;
  const double area = std::numbers::pi * vehicle.radius * vehicle.radius;
  const double wake = std::sqrt(2.0 * vehicle.thrust / (kAirDensity * area));
  const double speed = GroundJetSpeed(vehicle.thrust, std::max(height, vehicle.radius), distance, wake);
  return air + (1.0 + kGusts * gust) * speed / distance * from_vehicle.head<2>();
}

}  // namespace

double GroundJetSpeed(double thrust, double height, double distance, double wake_speed) {
  constexpr double kStagnation = 0.22;  // of the height
  if (!(thrust > 0.0)) return 0.0;
  const double share = std::max(distance / height, kStagnation);
  const double jet = 1.32 * std::sqrt(thrust / kAirDensity) / height * std::pow(share, -1.10);
  return std::min(jet, wake_speed) * std::min(distance / (kStagnation * height), 1.0);
}

double RestingLean(double speed, double stiffness_speed) {
  const double at_half = std::cos(0.5);
  const double c = 0.5 / (at_half * at_half) * (speed * speed) / (stiffness_speed * stiffness_speed);
  double lean = std::min(c, 1.2);
  for (int i = 0; i < 4; ++i) {  // Newton on θ − C cos² θ
    const double cosine = std::cos(lean);
    lean -= (lean - c * cosine * cosine) / (1.0 + c * std::sin(2.0 * lean));
    lean = std::clamp(lean, 0.0, 1.5);
  }
  return lean;
}

SwayState Begin(const Sway& sway, base::RandomStream& random) {
  SwayState state;
  state.tufts.resize(sway.X_WR.size());
  for (TuftState& tuft : state.tufts) tuft.gust = random.Gaussian();
  return state;
}

void Advance(const Sway& sway, SwayState& state, const ActorSurroundings& around) {
  constexpr double kGustTime = 0.7;  // s
  const double keep = std::exp(-around.dt / kGustTime);
  const double drive = std::sqrt(1.0 - keep * keep);
  const double w = 2.0 * std::numbers::pi * sway.frequency;
  for (std::size_t i = 0; i < state.tufts.size(); ++i) {
    TuftState& tuft = state.tufts[i];
    tuft.gust = keep * tuft.gust + drive * around.random.Gaussian();
    const Vec2 air = AirAt(sway.X_WR[i].p, tuft.gust, around.vehicle);
    const double speed = air.norm();
    Vec2 resting = Vec2::Zero();
    if (speed > 1e-9) resting = RestingLean(speed, sway.stiffness_speed) / speed * Vec2(-air.y(), air.x());
    tuft.rate += around.dt * (w * w * (resting - tuft.lean) - 2.0 * sway.damping * w * tuft.rate);
    tuft.lean += around.dt * tuft.rate;
  }
}

void Coordinates(const Sway&, const SwayState& state, double* q) {
  for (const TuftState& tuft : state.tufts) {
    *q++ = tuft.lean.x();
    *q++ = tuft.lean.y();
  }
}

base::Transform PlaceRoot(const Sway& sway, const double* q) {
  if (sway.X_WR.empty()) return {};
  return {base::Exp({q[0], q[1], 0.0}) * sway.X_WR[0].q, sway.X_WR[0].p};
}

void PlaceJoints(const Sway& sway, const double* q, base::Transform* X_WJ) {
  for (std::size_t i = 0; i < sway.X_WR.size(); ++i) {
    X_WJ[i] = {base::Exp({q[2 * i], q[2 * i + 1], 0.0}) * sway.X_WR[i].q, sway.X_WR[i].p};
  }
}

}  // namespace alula::worlds

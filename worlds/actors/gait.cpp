#include "worlds/actors/gait.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace alula::worlds {
namespace {

using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kPi = std::numbers::pi;
constexpr double kStance = 0.62;      // share of the stride that a foot stands
constexpr double kAhead = 0.23;       // strides that a foot touches down before the body
constexpr double kHeelOff = 0.36;     // phase of its stance at which the heel begins to rise
constexpr double kHeelRise = 0.96;    // rad at toe-off of a long stride
constexpr double kLongStride = 1.4;   // m
constexpr double kShortStride = 0.5;  // m, the shortest
constexpr double kStepTime = 0.55;    // s that a step takes at most: who stops does not stay on one leg

Vec2 Forward(double yaw) { return {std::cos(yaw), std::sin(yaw)}; }

double MinimumJerk(double u) { return u * u * u * (10.0 - u * (15.0 - 6.0 * u)); }

/// How far a foot's heel has risen at its own phase.
double HeelRise(double phase, double stride) {
  const double u = std::clamp((phase - kHeelOff) / (kStance - kHeelOff), 0.0, 1.0);
  const double share = std::clamp((stride - 0.8 * kShortStride) / (kLongStride - 0.8 * kShortStride), 0.0, 1.2);
  return kHeelRise * share * u * u * (3.0 - 2.0 * u);
}

double FootPhase(double phase, int side) {
  const double own = phase + 0.5 * side;
  return own - std::floor(own);
}

/// Ball of a foot that stands `ahead` metres before the body.
Vec2 Footfall(const Body& body, const Proportions& size, int side, const Vec2& ahead) {
  const Vec2 forward = Forward(body.yaw);
  const Vec2 left(-forward.y(), forward.x());
  return body.p + ahead + size.ball * forward + (side == 0 ? 0.85 : -0.85) * size.hip * left;
}

Transform FootPose(const Proportions& size, const Vec3& ball, double yaw, double pitch) {
  const base::Quat q = base::FromYawPitchRoll(yaw, pitch, 0.0);
  return {q, ball + q * Vec3(-size.ball, 0.0, size.ankle)};
}

/// Highest pelvis from which the leg reaches its ankle; `hip`: the hip's place, its height apart.
double HighestPelvis(const Proportions& size, const Vec2& hip, const Vec3& ankle) {
  const double leg = 0.997 * (size.thigh + size.shin);
  const double across = std::min((ankle.head<2>() - hip).norm(), 0.75 * leg);
  return ankle.z() + std::sqrt(leg * leg - across * across);
}

Vec2 HipPlace(const Body& body, const Proportions& size, double twist, int side) {
  const double yaw = body.yaw + twist;
  return body.p + (side == 0 ? size.hip : -size.hip) * Vec2(-std::sin(yaw), std::cos(yaw));
}

double Twist(double swing) { return -0.15 * swing; }  // of the pelvis; left hip forward with the left foot

/// A limb along −z from `from` to `to`, its x axis as near to `forward` as may be.
Transform Along(const Vec3& from, const Vec3& to, const Vec3& forward) {
  const Vec3 z = (from - to).normalized();
  const Vec3 y = z.cross(forward).normalized();
  base::Mat3 R;
  R << y.cross(z), y, z;
  return {base::Quat(R), from};
}

void PlaceLeg(const Proportions& size, const Vec3& hip, const Transform& X_WF, const Vec3& forward, Transform* thigh) {
  const double most = 0.9995 * (size.thigh + size.shin);
  const Vec3 way = X_WF.p - hip;
  const double length = std::clamp(way.norm(), 0.2 * most, most);
  const Vec3 u = way.normalized();
  const Vec3 f = (forward - forward.dot(u) * u).normalized();
  const double cosine =
      (size.thigh * size.thigh + length * length - size.shin * size.shin) / (2.0 * size.thigh * length);
  const double bend = std::acos(std::clamp(cosine, -1.0, 1.0));
  const Vec3 knee = hip + size.thigh * (std::cos(bend) * u + std::sin(bend) * f);
  thigh[0] = Along(hip, knee, forward);
  thigh[1] = Along(knee, X_WF.p, forward);
  thigh[2] = X_WF;
}

void PlaceArm(const Proportions& size, const Transform& X_WC, int side, double angle, Transform* arm) {
  const double outward = side == 0 ? 0.10 : -0.10;  // rad, off the trunk
  const Vec3 shoulder(0.0, side == 0 ? size.shoulder : -size.shoulder, size.shoulder_height - size.chest);
  arm[0] = X_WC * Transform{base::FromYawPitchRoll(0.0, -angle, outward), shoulder};
  const double elbow = 0.30 + 0.5 * std::max(angle, 0.0);
  arm[1] = arm[0] * Transform{base::FromYawPitchRoll(0.0, -elbow, 0.0), {0.0, 0.0, -size.upper_arm}};
}

/// Lifts, swings and sets down one foot whose own phase has come to `phase`.
void StepFoot(Foot& foot, int side, double phase, double stride, const Body& body, const Proportions& size,
              const GroundHeight& ground) {
  const double speed = body.v.norm();
  const Vec2 way = speed > 1e-6 ? Vec2(body.v / speed) : Vec2::Zero();
  const double share = std::min(speed / 0.3, 1.0);  // who hardly moves sets the feet side by side
  if (phase < kStance) {
    if (foot.swings) {  // it has just come down
      const Vec2 p = Footfall(body, size, side, share * (kAhead - phase) * stride * way);
      foot.ball = {p.x(), p.y(), ground(p)};
      foot.yaw = foot.lifted_yaw + base::WrapAngle(body.yaw - foot.lifted_yaw);
    }
    foot.swings = false;
    // A heel that rises never sinks back while it stands.
    foot.pitch = phase < 0.5 * kHeelOff ? HeelRise(phase, stride) : std::max(foot.pitch, HeelRise(phase, stride));
    return;
  }
  if (!foot.swings) {
    foot.swings = true;
    foot.lifted = foot.ball;
    foot.lifted_yaw = foot.yaw;
    foot.lifted_pitch = foot.pitch;
  }
  const double u = (phase - kStance) / (1.0 - kStance);
  const double w = MinimumJerk(u);
  const Vec2 target = Footfall(body, size, side, share * ((1.0 - phase) + kAhead) * stride * way);
  const double lift = 0.02 + 0.035 * std::min(stride / kLongStride, 1.0);
  foot.ball.head<2>() = foot.lifted.head<2>() + w * (target - foot.lifted.head<2>());
  foot.ball.z() = foot.lifted.z() + w * (ground(target) - foot.lifted.z()) + lift * 4.0 * u * (1.0 - u);
  foot.yaw = foot.lifted_yaw + w * base::WrapAngle(body.yaw - foot.lifted_yaw);
  foot.pitch = foot.lifted_pitch * (1.0 - w) - 0.2 * std::sin(kPi * w) * w;
}

}  // namespace

Proportions::Proportions(double height)
    : thigh(0.245 * height),
      shin(0.246 * height),
      ankle(0.039 * height),
      ball(0.075 * height),
      heel(0.040 * height),
      toe(0.112 * height),
      hip(0.055 * height),
      chest(0.10 * height),
      shoulder(0.115 * height),
      shoulder_height(0.275 * height),
      neck(0.325 * height),
      upper_arm(0.175 * height),
      forearm(0.22 * height) {}

double StrideLength(double height, double speed) {
  constexpr double kWalkRatio = 0.0064 * 60.0;  // m s
  return std::max(2.0 * height / 1.75 * std::sqrt(kWalkRatio * std::max(speed, 0.0)), kShortStride);
}

GaitState StandAt(const Body& body, double height, double phase, const GroundHeight& ground) {
  const Proportions size(height);
  GaitState gait;
  gait.phase = phase - std::floor(phase);
  const double speed = body.v.norm();
  const double stride = StrideLength(height, speed);
  for (int side = 0; side < 2; ++side) {
    Foot& foot = gait.feet[static_cast<std::size_t>(side)];
    const double own = FootPhase(gait.phase, side);
    // Where it stands, or would stand had it just been lifted.
    const double ahead = kAhead - std::min(own, kStance);
    const double share = std::min(speed / 0.3, 1.0);
    const Vec2 p = Footfall(body, size, side, share * ahead * stride * Forward(body.yaw));
    foot.ball = {p.x(), p.y(), ground(p)};
    foot.yaw = body.yaw;
    foot.pitch = speed > 0.0 ? HeelRise(std::min(own, kStance), stride) : 0.0;
    StepFoot(foot, side, own, stride, body, size, ground);
  }
  return gait;
}

void StepGait(GaitState& gait, const Body& body, double height, double dt, const GroundHeight& ground) {
  const Proportions size(height);
  const double speed = body.v.norm();
  const double stride = StrideLength(height, speed);
  constexpr double kTurnPerStep = 0.7;  // rad
  constexpr double kSlow = 0.4;         // m/s, below which a step is finished by itself
  const bool on_one_leg = gait.feet[0].swings || gait.feet[1].swings;
  const double stopping = on_one_leg ? std::max(1.0 - speed / kSlow, 0.0) : 0.0;
  const double advance = std::max(
      {speed * dt / stride, std::abs(body.yaw_rate) * dt / (2.0 * kTurnPerStep), stopping * 0.5 * dt / kStepTime});
  gait.phase += advance;
  gait.phase -= std::floor(gait.phase);
  for (int side = 0; side < 2; ++side) {
    StepFoot(gait.feet[static_cast<std::size_t>(side)], side, FootPhase(gait.phase, side), stride, body, size, ground);
  }
  const double amplitude = std::min(speed / 1.2, 1.2);
  const double wanted = amplitude * std::cos(2.0 * kPi * gait.phase);
  gait.swing += std::clamp(wanted - gait.swing, -8.0 * dt, 8.0 * dt);
  gait.lean += (0.03 + 0.025 * speed - gait.lean) * std::min(2.0 * dt, 1.0);
}

void WalkCoordinates(const GaitState& gait, const Body& body, double height, double* q) {
  const Proportions size(height);
  constexpr double kSoft = 0.005;  // m, over which one bound takes over from the other
  // Upright with a little bend in the knees, or lower where a leg does not reach.
  double highest = 1e9;
  std::array<double, 3> bounds{};
  for (int side = 0; side < 2; ++side) {
    const Foot& foot = gait.feet[static_cast<std::size_t>(side)];
    const Transform X_WF = FootPose(size, foot.ball, foot.yaw, foot.pitch);
    bounds[static_cast<std::size_t>(side)] = HighestPelvis(size, HipPlace(body, size, Twist(gait.swing), side), X_WF.p);
    highest = std::min(highest, foot.ball.z());
  }
  bounds[2] = highest + size.ankle + 0.998 * (size.thigh + size.shin);
  const double least = std::min({bounds[0], bounds[1], bounds[2]});
  double sum = 0.0;
  for (const double bound : bounds) sum += std::exp(-(bound - least) / kSoft);
  q[0] = body.p.x();
  q[1] = body.p.y();
  q[2] = least - kSoft * std::log(sum);
  q[3] = body.yaw;
  q[4] = gait.swing;
  q[5] = gait.lean;
  for (std::size_t side = 0; side < 2; ++side) {
    const Foot& foot = gait.feet[side];
    double* out = q + 6 + 5 * side;
    std::copy_n(foot.ball.data(), 3, out);
    out[3] = foot.yaw;
    out[4] = foot.pitch;
  }
}

Transform PelvisPose(const double* q) { return {base::FromYaw(q[3] + Twist(q[4])), {q[0], q[1], q[2]}}; }

void PlacePerson(double height, const double* q, Transform* X_WJ) {
  const Proportions size(height);
  const double swing = q[4];
  const double twist = Twist(swing);
  const Transform X_WP = PelvisPose(q);
  X_WJ[kPelvis] = X_WP;
  X_WJ[kChest] = X_WP * Transform{base::FromYawPitchRoll(-1.8 * twist, q[5], 0.0), {0.0, 0.0, size.chest}};
  const Vec3 neck(0.0, 0.0, size.neck - size.chest);
  X_WJ[kHead] = {base::FromYaw(q[3]), X_WJ[kChest] * neck};
  PlaceArm(size, X_WJ[kChest], 0, -0.42 * swing, X_WJ + kArmL);
  PlaceArm(size, X_WJ[kChest], 1, 0.42 * swing, X_WJ + kArmR);
  const Vec3 forward = base::FromYaw(q[3]) * Vec3::UnitX();
  for (int side = 0; side < 2; ++side) {
    const double* foot = q + 6 + 5 * side;
    const Transform X_WF = FootPose(size, {foot[0], foot[1], foot[2]}, foot[3], foot[4]);
    const Vec3 hip(0.0, side == 0 ? size.hip : -size.hip, 0.0);
    PlaceLeg(size, X_WP * hip, X_WF, forward, X_WJ + (side == 0 ? kThighL : kThighR));
  }
}

}  // namespace alula::worlds

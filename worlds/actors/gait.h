#pragma once

#include <array>
#include <functional>

#include "base/frames.h"

namespace alula::worlds {

/// Lengths of a body, m: legs and feet as shares of its height as Winter (2009, "Biomechanics and Motor Control",
/// fig. 4.1) has them; trunk and arms a little less, because the joints of what is drawn lie inside its outline.
struct Proportions {
  explicit Proportions(double height);
  double thigh, shin;                // hip to knee, knee to ankle
  double ankle;                      // above the sole
  double ball, heel, toe;            // along the foot, from under the ankle: forward, back, forward
  double hip;                        // half the distance of the hips
  double chest;                      // pelvis to the middle of the chest's lower rim
  double shoulder, shoulder_height;  // half their distance; above the pelvis
  double neck;                       // above the pelvis
  double upper_arm, forearm;         // with the hand
};

/// Joint frames of a walker: x forward, y left, z up when it stands; limbs hang down from their joint.
enum PersonJoint {
  kPelvis,
  kChest,
  kHead,
  kArmL,
  kForearmL,
  kArmR,
  kForearmR,
  kThighL,
  kShinL,
  kFootL,
  kThighR,
  kShinR,
  kFootR,
  kPersonJoints
};

/// A foot: its ball is what stands.
struct Foot {
  base::Vec3 ball = base::Vec3::Zero();  // on the sole, world axes, m
  double yaw = 0.0;                      // rad
  double pitch = 0.0;                    // rad, heel up
  bool swings = false;
  base::Vec3 lifted = base::Vec3::Zero();  // where it left the ground
  double lifted_yaw = 0.0, lifted_pitch = 0.0;
};

/// A gait whose phase is tied to the distance walked. One stride S (two steps) is one unit of phase; the left foot is
/// half a stride before the right. A foot stands for 62 % of the stride: its ball does not move at all, from the middle
/// of the stance on the heel rises about it. It then swings, on a minimum-jerk curve, to where the body will be. The
/// pelvis is as high as both legs let it be (compass gait), knees by inverse kinematics; arms swing against the legs.
/// Stride from speed: step length / step rate is taken as constant, 0.0064 m min (the walk ratio of Sekiya & Nagasaki
/// 1998; the measured one grows below about 1 m/s), so S = 2 √(0.0064 · 60 · v) for 1.75 m of height, and in
/// proportion.
struct GaitState {
  double phase = 0.0;  // strides, in [0, 1): 0 is the left foot's touch-down
  std::array<Foot, 2> feet;
  double swing = 0.0;  // of the arms and the twist of the trunk: amplitude · cos(2π phase)
  double lean = 0.03;  // of the trunk, rad
};

/// Where a body is: its middle on the ground, its velocity and the way it faces.
struct Body {
  base::Vec2 p{0.0, 0.0};
  base::Vec2 v{0.0, 0.0};
  double yaw = 0.0;
  double yaw_rate = 0.0;
};
using GroundHeight = std::function<double(const base::Vec2&)>;

double StrideLength(double height, double speed);

/// Standing in step at some phase.
GaitState StandAt(const Body& body, double height, double phase, const GroundHeight& ground);
/// After the body has moved on to `body` in dt seconds.
void StepGait(GaitState& gait, const Body& body, double height, double dt, const GroundHeight& ground);

/// Generalised coordinates: pelvis (3), yaw, swing, lean, then of each foot: ball (3), yaw, pitch.
inline constexpr std::size_t kWalkCoordinates = 16;
void WalkCoordinates(const GaitState& gait, const Body& body, double height, double* q);
base::Transform PelvisPose(const double* q);
/// Poses of the kPersonJoints frames.
void PlacePerson(double height, const double* q, base::Transform* X_WJ);

}  // namespace alula::worlds

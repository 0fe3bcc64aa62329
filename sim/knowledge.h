#pragma once

#include <cstdint>
#include <vector>

#include "base/describe.h"
#include "base/frames.h"
#include "stack/interface/calibration.h"
#include "stack/interface/mission.h"
#include "worlds/world.h"

namespace alula::sim {

/// How wrong what a stack is told is. One standard deviation each, except for the gates.
struct KnowledgeErrors {
  double extrinsics_angle = 0.0034906585039886592;  // camera against IMU, per axis, rad (0.2 deg)
  double extrinsics_position = 0.002;               // per axis, m
  double eye_angle = 0.00034906585039886592;        // one eye against the other, per axis, rad (0.02 deg)
  double baseline = 0.001;                          // share of the baseline
  double focal = 0.001;                             // share of the focal length, common to both eyes
  base::Duration time_offset = base::Milliseconds(2);
  double start_position = 0.1;              // per axis, m
  double start_yaw = 0.034906585039886592;  // rad (2 deg)
  double gate_offset_min = 0.3;             // in the opening's plane, uniform between the two, m
  double gate_offset_max = 0.6;
  double gate_yaw = 0.17453292519943295;      // uniform within ±, rad (10 deg)
  double declination = 0.006981317007977318;  // of Earth's field, rad (0.4 deg, ours: the order of field models')
};
void Describe(base::Description& d, KnowledgeErrors& c);

/// The calibration as a laboratory got it: the truth with errors of streams "knowledge/calibration/…".
stack::Calibration Misjudge(const stack::Calibration& truth, const KnowledgeErrors& errors, std::uint64_t seed);

/// The mission as surveyed: the world, and `X_WB` where the body is at the start, with errors of streams
/// "knowledge/mission/…". `waypoints_W` pass unchanged.
stack::Mission SurveyMission(const worlds::World& world, const base::Transform& X_WB,
                             const std::vector<base::Vec3>& waypoints_W, const KnowledgeErrors& errors,
                             std::uint64_t seed);

/// Where the body stands at the start: the world's ground point, one standing height up.
base::Transform StartPose(const worlds::World& world, double standing_height);

}  // namespace alula::sim

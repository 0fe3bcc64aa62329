#pragma once

#include "base/describe.h"
#include "stack/slam/loop_filter.h"
#include "stack/slam/relative_pose.h"

namespace alula::stack::slam {

/// When a place counts as seen before, and what it must agree with.
struct LoopConfig {
  bool enabled = true;
  LoopFilterConfig filter;
  RelativePoseConfig geometry;
  int recent = 10;  // keyframes before the newest that are no news
  int looks = 3;    // of a place's views, that are compared with the newest
  int least = 30;   // landmarks of the known place that the newest keyframe must show
  // Two views that are alike to the pixel are the same place for geometry. So more than one keyframe must say the same,
  int agree = 2;                // keyframes
  int agree_within = 5;         // keyframes
  double agree_position = 0.3;  // m
  double agree_angle = 0.03;    // rad
  double tilt = 0.05;           // rad by which the verticals may differ
  // and the odometry must have been able to drift as far as they say (within one part of the map).
  double drift_position = 0.2;     // m
  double drift_share = 0.02;       //   and this share of the way since then
  double drift_angle = 0.03;       // rad of heading
  double drift_angle_rate = 5e-4;  //   and rad/s
  double tie_position = 0.02;      // m, 1σ by which two that see the same may move against one another as it closes
  double tie_angle = 0.004;        // rad, likewise
};

void Describe(base::Description& d, LoopConfig& c);

}  // namespace alula::stack::slam

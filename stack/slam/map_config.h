#pragma once

#include "base/describe.h"
#include "stack/features/orb_config.h"
#include "stack/slam/loop_config.h"

namespace alula::stack::slam {

/// Finding landmarks of the map again in a new keyframe.
struct SearchConfig {
  double radius = 12.0;      // px around where a landmark is expected
  double near_radius = 4.0;  // px, once the pose is corrected
  int max_distance = 60;     // bits of 256 by which descriptors may differ
  double ratio = 0.85;       // of the best distance to the second best on the same level
  double max_angle = 1.05;   // rad (60°) between the ways it is and was looked at
  int least = 12;            // matches below which the odometry alone is believed
};

/// How keyframes and what they see are fitted together.
struct AdjustConfig {
  int keyframes = 8;                   // newest ones that move
  int covisible = 8;                   // others that see the same, which move too
  int fixed = 30;                      // keyframes that hold the rest where it is
  int iterations = 4;                  // of Levenberg–Marquardt at a keyframe
  int whole_every = 10;                // keyframes, after which the whole map is fitted together
  int whole_iterations = 3;            // then
  int final_iterations = 15;           // of the whole map, at the end
  double pixel_sigma = 1.0;            // px on the finest level; coarser ones by their scale
  double huber = 2.0;                  // σ
  double gate = 4.0;                   // σ beyond which a sight is dropped
  double motion_position = 0.004;      // m, 1σ of the odometry between two keyframes, besides
  double motion_drift = 0.006;         //   this share of the way
  double motion_angle = 0.001;         // rad, likewise
  double motion_angle_drift = 0.0007;  // rad/s
  double vertical = 0.004;             // rad, of the odometry's vertical
};

struct MapConfig {
  bool enabled = true;
  double latency = 0.2;                       // s until what a keyframe taught is known
  features::OrbConfig orb{.keypoints = 400};  // of a keyframe
  double farthest = 100.0;                    // m: where a landmark may begin
  SearchConfig search;
  AdjustConfig adjust;
  LoopConfig loop;
  double redundant = 0.9;  // share of its landmarks that three others see: such a keyframe goes
};

void Describe(base::Description& d, SearchConfig& c);
void Describe(base::Description& d, AdjustConfig& c);
void Describe(base::Description& d, MapConfig& c);

}  // namespace alula::stack::slam

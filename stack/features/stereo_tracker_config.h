#pragma once

#include "base/describe.h"

namespace alula::stack::features {

/// How corners are found and followed.
struct StereoTrackerConfig {
  int cell = 40;                    // px: side of a grid cell, one corner each; 40 gives 192 cells at 640×480
  int max_tracks = 140;             // more cost time and bring little
  int fast_threshold = 5;           // grey levels; a dim wall has no more, pixel noise is about 1
  double min_corner_score = 4.0;    // smaller eigenvalue of the mean gradient matrix, (grey level/px)²; noise has 0.2
  int window = 15;                  // px: side of the KLT patch
  int levels = 3;                   // pyramid levels above the image
  int iterations = 12;              // of KLT a level
  double max_back_error = 0.6;      // px: there and back again
  double max_epipolar_error = 1.5;  // px between the right match and its epipolar line
  double min_stereo_depth = 0.35;   // m: nearest depth searched for in the right image
  int border = 10;                  // px kept free at the edge
  int max_misses = 5;               // frames for which a lost corner is looked for again
};

void Describe(base::Description& d, StereoTrackerConfig& c);

}  // namespace alula::stack::features

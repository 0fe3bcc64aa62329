#pragma once

#include <array>
#include <vector>

#include "stack/features/line_segments.h"
#include "stack/features/stereo_rig.h"

namespace alula::stack::features {

/// When a segment of the left image and one of the right image show the same edge.
struct LineStereoConfig {
  double min_depth = 0.35;    // m: no nearer
  double max_angle = 0.2;     // rad between them in rectified views
  double min_overlap = 0.4;   // of the rows of the left one, that the right one shares
  double min_slope = 0.12;    // sine of the angle to the rows: along them nothing tells the depth
  double min_likeness = 0.6;  // normalised cross-correlation at the middles
  double sparsity = 0.1;      // λ of the L1 term
  double min_weight = 0.6;    // of the best candidate, of all weights
  int patch = 11;             // px, side of the patches
};
void Describe(base::Description& d, LineStereoConfig& c);

/// A segment of the left image found in the right one.
struct StereoLine {
  int left = 0, right = 0;                                                   // indices
  std::array<base::Vec3, 2> ends_L{base::Vec3::Zero(), base::Vec3::Zero()};  // m, left camera: its ends in space
  double weight = 0.0;
};

/// Without descriptors, as P0 does (section 3.3): each left segment has, with each candidate of the right image, the
/// vector q = (1 − cos of the angle, horizontal distance of the ends over the largest one, NCC at the middles, ratio of
/// the lengths within the common rows); the best is the heaviest of the non-negative w that minimises
///   ½ |Q w − (0, 0, 1, 1)|² + λ |w|₁
/// (the form is that of Gomez-Ojeda and Gonzalez-Jimenez 2018). Its line at the rows of the left ends gives their
/// depth. All in views that are rectified by the calibration, lens distortion taken out.
std::vector<StereoLine> MatchLines(const StereoRig& rig, const Image& left, const Image& right,
                                   const std::vector<LineSegment>& left_lines,
                                   const std::vector<LineSegment>& right_lines, const LineStereoConfig& config);

}  // namespace alula::stack::features

#pragma once

#include <vector>

#include "base/frames.h"
#include "stack/features/line_config.h"
#include "stack/interface/measurement.h"

namespace alula::stack::features {

/// A straight edge in an image, from `a` to `b` with the brighter side to its right as the image is looked at (u right,
/// v down): so a segment has a direction, and one edge never matches the opposite one.
struct LineSegment {
  base::Vec2 a = base::Vec2::Zero(), b = base::Vec2::Zero();  // px
  double contrast = 0.0;                                      // mean gradient across it, grey levels a px

  base::Vec2 Middle() const { return 0.5 * (a + b); }
  base::Vec2 Along() const { return (b - a).normalized(); }
  double Length() const { return (b - a).norm(); }
};

/// What was found before and after the reduction.
struct LineCounts {
  int found = 0, kept = 0;
  double found_length = 0.0, kept_length = 0.0;  // px, means
};

/// Segments of an image, longest first: found by the detector, then P0's four steps (section 3.2): sorted by length;
/// short ones go; of the others each is merged with those that nearly continue it (the angle filter is taken within
/// such a group: literally it would keep one direction only). Throws base::InputError where the image is not 8-bit
/// grey.
std::vector<LineSegment> DetectLines(const Image& image, const LineConfig& config, LineCounts* counts = nullptr);

/// P0's steps alone, of segments in an image of width × height px.
std::vector<LineSegment> ReduceLines(std::vector<LineSegment> segments, int width, int height,
                                     const LineConfig& config);

}  // namespace alula::stack::features

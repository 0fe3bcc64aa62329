#pragma once

#include <cstdint>

#include "base/describe.h"

namespace alula::stack::features {

/// Grompone von Gioi et al. 2010, as OpenCV has it; or edge drawing and fitting (Akinlar and Topal 2011), of our own.
enum class LineDetector : std::uint8_t { kEdLines, kLsd };

/// How line segments are found, and which are kept (P0, section 3.2).
struct LineConfig {
  LineDetector detector = LineDetector::kEdLines;
  bool half = true;            // at half resolution: a third of the time
  double min_gradient = 3.0;   // grey levels a px of the searched image that make an edge; noise has 0.5
  double anchor_excess = 0.5;  // grey levels a px by which an anchor stands out from its neighbours across
  double fit_error = 1.0;      // px of the searched image from the line for what still belongs to it
  bool reduce = true;          // the four steps below; off: as the detector gives them
  double min_share = 0.07;     // of the image's shorter side: shorter segments go (P0's δ)
  double merge_angle = 0.035;  // rad (2°) between segments that are merged
  double merge_offset = 2.0;   // px between their lines
  double merge_gap = 0.5;      // between their ends, of the shorter one's length
  int keep = 80;               // longest ones
};

void Describe(base::Description& d, LineConfig& c);

}  // namespace alula::stack::features

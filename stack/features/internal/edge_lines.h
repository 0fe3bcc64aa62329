#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "stack/features/line_segments.h"

namespace alula::stack::features {

/// Edge drawing and line fitting (Akinlar and Topal 2011, EDLines): smoothing → gradient → anchors, from which edges
/// are walked along the ridge of the gradient → least-squares lines through stretches of each edge → those kept that
/// chance would not make (a contrario, number of false alarms ≤ 1). Points of an edge are placed between pixels by a
/// parabola across it. Coordinates in the image given, 8-bit grey.
std::vector<LineSegment> EdgeLines(const cv::Mat& image, const LineConfig& config);

}  // namespace alula::stack::features

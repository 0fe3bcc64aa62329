#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stack/features/line_segments.h"
#include "stack/interface/camera_model.h"

namespace alula::stack::features {

/// How segments are followed from image to image.
struct LineTrackConfig {
  double max_offset = 8.0;   // px across, between the middles of prediction and segment
  double max_angle = 0.09;   // rad (5°)
  double min_overlap = 0.5;  // of the shorter one, along the line
};
void Describe(base::Description& d, LineTrackConfig& c);

/// A line where it should be seen, and the segment that shows it.
struct ExpectedLine {
  std::uint64_t id = 0;
  LineSegment segment;
};
struct FollowedLine {
  std::uint64_t id = 0;
  int segment = 0;
};

/// What an eye sees of a segment in space, both ends in its frame (m), cut off at the image's edge: P4's prediction
/// (section 2.2). None where nothing is seen of it. Lens distortion bends it: the ends are where they are seen.
std::optional<LineSegment> ExpectSegment(const CameraIntrinsics& camera, const base::Vec3& a_C, const base::Vec3& b_C);

/// Pairs expected lines with segments that lie nearly on them, the best first; each is given once.
std::vector<FollowedLine> FollowLines(const std::vector<ExpectedLine>& expected,
                                      const std::vector<LineSegment>& segments, const LineTrackConfig& config);

}  // namespace alula::stack::features

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/describe.h"
#include "base/frames.h"
#include "stack/interface/mission.h"
#include "stack/mapping/depth_map.h"

namespace alula::stack::perception {

/// A gate as measured from depth.
struct GateObservation {
  /// x along the direction of passage (on the hint's side), z up, origin mid-opening.
  base::Transform X_OG;
  double opening = 0.0;         // side of the square opening, m (as the mission states it)
  double score = 0.0;           // mean agreement of bars and opening with what was seen, at most 1
  double position_sigma = 0.0;  // 1σ per axis in the opening's plane, m
  double normal_sigma = 0.0;    // 1σ along the normal, m
  double yaw_sigma = 0.0;       // 1σ, rad
  int support = 0;              // depth pixels on the bars
  int bars = 0;                 // bars seen, 3 or 4
  double nearest = 0.0;         // depth at which the nearest view was taken, m
};

struct GateFinderConfig {
  double search_in_plane = 1.2;  // m to each side of the hint: survey error plus misalignment of the map frame
  double search_normal = 0.6;    // m to each side
  double search_yaw = 0.44;      // rad (25°) to each side
  double bar_width = 0.12;       // m, of the thinnest bars
  double bar_depth = 0.16;       // m along the passage, typical
  double disparity_sigma = 0.2;  // px of the depth map
  double disparity_bias = 0.1;   // px, common to a whole view (calibration of the eyes)
  double max_range = 6.0;        // m; farther pixels do not tell a bar from a wall
  double min_bar_support = 0.4;  // mean evidence in (−1 … 1) that a bar needs to count as seen
  double min_opening = 0.35;     // mean evidence that the opening needs to be something one sees through
  double min_coverage = 0.35;    // share of a bar's length that must have been looked at
  int max_views = 12;            // depth maps kept for each gate; the oldest goes first
  double view_spacing = 0.12;    // m of travel (or 0.1 rad of turn) between kept views
  int max_samples = 2000;        // pixels kept of one view
};
void Describe(base::Description& d, GateFinderConfig& c);

/// Measures where the mission's gates really are, from the depth maps of the approach: an upright square frame with a
/// known opening is fitted to all views kept (four unknowns: position and yaw). What is seen *through* the opening
/// counts as much as what is seen on the bars; pixels without depth count nothing.
class GateFinder {
 public:
  GateFinder(std::vector<GateHint> hints, const GateFinderConfig& config);
  ~GateFinder();
  GateFinder(GateFinder&&) noexcept;
  GateFinder& operator=(GateFinder&&) noexcept;

  /// Takes a depth map in; X_OC is the pose of its camera, X_MO of the odometry frame in the map frame (the hints').
  void Add(const mapping::DepthMap& depth, const base::Transform& X_OC, const base::Transform& X_MO);
  /// The best fit so far, or nothing while fewer than three bars agree.
  std::optional<GateObservation> Best(int gate) const;
  int size() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace alula::stack::perception

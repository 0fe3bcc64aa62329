#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "stack/perception/gate_finder.h"

namespace alula::stack::perception::internal {

/// One pixel of a view: the ray with unit planar depth, so that the point seen is p_OC + z · ray_O.
struct Sample {
  Eigen::Vector3f ray_O;
  float z = 0.0F;  // m; +inf: far
};

/// The part of one depth map that looks at a gate's surroundings.
struct GateView {
  base::Transform X_OC;
  std::vector<Sample> samples;
  double pixels_per_sample = 1.0;
  double focal = 0.0;           // px
  double focal_baseline = 0.0;  // px·m
  double depth = 0.0;           // of the hinted centre when the view was taken, m
};

/// An upright square frame: mid-opening and heading of the passage.
struct GatePose {
  base::Vec3 p_O = base::Vec3::Zero();
  double yaw = 0.0;

  base::Vec3 Normal() const { return {std::cos(yaw), std::sin(yaw), 0.0}; }
  base::Vec3 Left() const { return {-std::sin(yaw), std::cos(yaw), 0.0}; }
};

/// A sample against the slab that a gate fills: where its ray enters and leaves it (lateral and up from the gate's
/// centre, m), and whether something was seen there (evidence +1), behind it (−1), or in front (0).
struct Crossing {
  float y_in = 0, z_in = 0, y_out = 0, z_out = 0;
  float evidence = 0;
  float weight = 0;       // pixels that the sample stands for
  float depth_error = 0;  // measured depth minus that of the near face, m
  float sigma = 0;        // of the measured depth, without what is common to a view, m
  float slope = 0;        // change of the near face's depth with a shift of the gate along its normal
  float depth = 0;        // of the near face, m
};

/// How well a pose explains the views.
struct Quality {
  std::array<double, 4> bar{};       // mean evidence: left, right, bottom, top
  std::array<double, 4> coverage{};  // share of the bar's length that was looked at
  double opening = 0.0;              // mean evidence that the opening is seen through
  double opening_coverage = 0.0;     // share of the opening with depth (a plain sky has none)
  int bars = 0;                      // that count as seen
  int support = 0;                   // samples on the bars that agree
  bool accepted = false;
  double score = -1.0;
};

/// Fits the pose of a gate of known opening to views. Stateless.
class GateFit {
 public:
  GateFit(const GateFinderConfig& config, double opening) : config_(config), opening_(opening) {}

  /// The best poses of an exhaustive search on a coarse raster about `hint`, best first, at most three.
  std::vector<GatePose> Search(const std::vector<GateView>& views, const GatePose& hint) const;

  struct Result {
    GatePose pose;
    Quality quality;
    double position_sigma = 0.0;
    double normal_sigma = 0.0;
    double yaw_sigma = 0.0;
  };
  /// Coarse: from a pose of the raster, large steps on half of the samples, softened evidence. Fine: from a pose that
  /// is about right (a former result or a coarse one).
  enum class Steps { kCoarse, kFine };
  /// Alternates between the plane (normal offset and yaw, from depths on the bars) and the place in the plane (from
  /// what is bar and what is seen through), starting at `start`.
  Result Refine(const std::vector<GateView>& views, const GatePose& start, const GatePose& hint, Steps steps) const;

  /// The samples of the views whose rays pass the pose's slab within `margin` (m) of the opening.
  /// `extra_sigma` (m) softens the evidence for coarse poses; only every `stride`-th sample is taken.
  void Cross(const std::vector<GateView>& views, const GatePose& pose, double margin, double extra_sigma, int stride,
             std::vector<Crossing>& out) const;
  Quality Judge(const std::vector<Crossing>& crossings) const;

 private:
  double InPlaneObjective(const std::vector<Crossing>& crossings, double dy, double dz, double ramp) const;
  void AdjustInPlane(const std::vector<Crossing>& crossings, double step, GatePose& pose) const;
  struct PlaneStep {
    double normal = 0.0, yaw = 0.0;              // m, rad
    double normal_sigma = 0.0, yaw_sigma = 0.0;  // 1σ
    double depth = 0.0;                          // mean of the bars' samples, m
  };
  PlaneStep AdjustPlane(const std::vector<Crossing>& crossings, const GatePose& pose, const GatePose& hint) const;

  GateFinderConfig config_;
  double opening_;  // m
};

}  // namespace alula::stack::perception::internal

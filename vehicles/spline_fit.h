#pragma once

#include <array>
#include <vector>

#include "base/frames.h"
#include "vehicles/b_spline.h"

namespace alula::vehicles {

/// Least squares for the control points c of a uniform quintic B-spline:
///
///   min  Σ_i |Σ_j B_j(u_i) c_j − s_i|² + λ n Σ_j |Δ³c_j|²,   n samples a segment in the mean
///
/// (Eilers and Marx 1996: the third differences only bridge what no sample determines; λ is far too small to bend what
/// samples do). The normal equations are banded; they are factored once, for any number of right-hand sides.
class SplineFit {
 public:
  /// `u`: where the samples lie, ascending, in [0, segments].
  SplineFit(const std::vector<double>& u, int segments);

  int controls() const { return static_cast<int>(factor_.size()); }
  /// The control points for samples s_i at the u given to the constructor.
  std::vector<base::Vec3> Solve(const std::vector<base::Vec3>& samples) const;

  struct Place {  // of a sample: its segment and the weights of its control points
    int segment = 0;
    QuinticBasis basis;
  };
  const std::vector<Place>& places() const { return places_; }

 private:
  static constexpr int kBand = QuinticSpline<base::Vec3>::kDegree;
  void Factor();

  std::vector<Place> places_;
  std::vector<std::array<double, kBand + 1>> factor_;  // row i: entries (i, i), (i, i−1), … of LDLᵀ; D in column 0
};

}  // namespace alula::vehicles

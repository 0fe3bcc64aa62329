#pragma once

namespace alula::stack::features::internal {

inline constexpr int kPatchRadius = 15;  // px of the disc that gives orientation and tests

/// Half a side of the disc's row v: |u| ≤ RowHalf(v) inside.
constexpr int RowHalf(int v) {
  int u = kPatchRadius;
  while (u * u + v * v > kPatchRadius * kPatchRadius + kPatchRadius) --u;
  return u;
}

/// 256 pairs of points, px, of an upright patch: bit i is I(a_i) < I(b_i).
struct BriefPattern {
  float ax[256], ay[256], bx[256], by[256];
};

/// Tests that say much and say different things. Rublee et al. (2011, section 4.3) search them greedily on training
/// patches; here the same search is done in closed form on a model of images, a stationary Gaussian field with
/// covariance C(r) = 1/(1 + r²/ρ²). Given the moments m = (m10, m01) of the disc, by which a patch is turned upright, d
/// = I(a) − I(b) has a known mean (a bit whose mean is far from ½ says little) and known correlations with other tests.
/// Of candidates from a fixed seed the half of which m says least is kept; then tests are taken one after another, each
/// the one whose largest correlation, given m, with those taken is least. Made once a process, about 4 ms.
const BriefPattern& Pattern();

}  // namespace alula::stack::features::internal

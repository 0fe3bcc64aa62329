#pragma once

#include <vector>

#include "worlds/actors/outline.h"
#include "worlds/world.h"

namespace alula::worlds {

/// Share of the wind that an endless solid fence of height h takes away, x behind it and z above the ground (m): Perera
/// 1981 (J. Wind Eng. Ind. Aerodyn. 8, 93), the form of Counihan, Hunt & Jackson 1974 that Taylor & Salmon 1993 (J.
/// Appl. Meteorol. 32, 1683) build on,
///   ΔU / U = 9.75 (h / x) η exp(−0.67 η^1.5),  η = (z / h) (K x / h)^−0.47,  K = 0.32 / ln(h / z₀),
/// with the roughness z₀ = 3 cm. It is a law of the far wake: nearer than 5 h it is taken at 5 h, above that for z < h
/// only (beside and over the bubble behind the fence, for z ≥ h, it fades out towards the fence). In [0, 0.95].
double FenceDeficit(double x, double z, double h);

/// What keeps the wind off: solids that stand on the ground, as the mean wind meets them. The deficit of one of finite
/// width is the fence's, spread sideways by turbulence of 15 %, σ_y = 0.15 x (Taylor 1921, near field):
///   ½ [erf((y + b) / (√2 σ_y)) − erf((y − b) / (√2 σ_y))],  b: half its width across the wind;
/// deficits of several add (Lissaman 1979), to 0.95 at most. Beyond 30 h nothing is left.
class Shelter {
 public:
  /// Things 0.5 m and more high that begin within 0.5 m of the ground (z = 0), or on top of such a thing with the same
  /// outline. `mean_W`: a horizontal wind; none is sheltered where it is 0.
  Shelter(const World& world, const base::Vec3& mean_W);

  /// Share of the wind that comes through at p_W, in [0.05, 1].
  double Through(const base::Vec3& p_W) const;

 private:
  struct Body {
    double lee = 0.0;     // along the wind, of its far side, m
    double across = 0.0;  // of its middle, m
    double half = 0.0;    // width across the wind, m
    double height = 0.0;  // m
  };
  base::Vec2 along_{1.0, 0.0};
  std::vector<Body> bodies_;
};

}  // namespace alula::worlds

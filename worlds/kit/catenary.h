#pragma once

#include <vector>

#include "base/frames.h"

namespace alula::worlds {

/// A line of even weight hung between two points of a vertical plane. With the horizontal tension H (N) and the weight
/// w (N/m) the parameter is a = H / w, and
///   z(x) = a cosh((x − x₀) / a) + c
/// through both ends: for ends L apart and h higher at the far one
///   x₀ = L/2 − a asinh(h / (2 a sinh(L / 2a)))
/// (Irvine 1981, Cable Structures, section 1.2).
class Catenary {
 public:
  /// `a`: H / w, m. The ends must not lie one above the other.
  Catenary(const base::Vec3& from, const base::Vec3& to, double a);

  /// The point at a share of the horizontal way, in [0, 1].
  base::Vec3 At(double share) const;
  /// Length of the line, m: a (sinh((L − x₀) / a) + sinh(x₀ / a)).
  double Length() const;
  /// Largest distance below the straight line between the ends, m, where the line is parallel to it.
  double Sag() const;

 private:
  base::Vec3 from_;
  base::Vec3 level_;  // unit, from the first end towards the second
  double span_ = 0.0, rise_ = 0.0, a_ = 1.0, lowest_ = 0.0;
};

}  // namespace alula::worlds

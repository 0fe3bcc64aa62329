#pragma once

#include <vector>

#include "base/frames.h"
#include "base/random.h"

namespace alula::stack::features {

/// A known point, already turned into the camera's axes by a rotation that the gyroscope vouches for (q_CO p_O), and
/// where the camera saw it (normalised).
struct TurnedPoint {
  base::Vec3 p;
  base::Vec2 seen;
};

struct TranslationResult {
  base::Vec3 t = base::Vec3::Zero();  // p_C = p + t
  std::vector<bool> inlier;
  int inliers = 0;
};

/// RANSAC (Fischler and Bolles 1981) for the camera's translation alone: with the rotation known, two points give four
/// linear equations (x z − ... = 0) for three unknowns. `gate`: in normalised units. `guess` is tried first, so that
/// a good prediction is never worse than chance. Deterministic for a given stream.
TranslationResult FindTranslation(const std::vector<TurnedPoint>& points, const base::Vec3& guess, double gate,
                                  int trials, base::RandomStream& random);

}  // namespace alula::stack::features

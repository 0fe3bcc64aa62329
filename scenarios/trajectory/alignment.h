#pragma once

#include <cstdint>
#include <vector>

#include "scenarios/trajectory/error_statistics.h"
#include "scenarios/trajectory/pose_pairs.h"

namespace alula::scenarios::trajectory {

/// What may be chosen so that an estimate fits the truth best.
enum class Freedom : std::uint8_t {
  kNone,        // nothing: as published
  kYaw,         // shift and turn about the vertical: what vision with an IMU cannot know (4-DoF)
  kRigid,       // shift and turn (SE(3)): without gravity
  kSimilarity,  // shift, turn and scale (Sim(3)): one camera alone
};

/// p_T = scale · (X_TE.q p_E) + X_TE.p.
struct Similarity {
  base::Transform X_TE;
  double scale = 1.0;

  base::Vec3 operator*(const base::Vec3& p_E) const { return scale * (X_TE.q * p_E) + X_TE.p; }
};

/// The alignment of least squared distance over all pairs (Umeyama 1991). Where positions do not determine the turn
/// (all in one place: none; along a line: about it) any of the best is taken; scale is 1 for positions in one place.
Similarity Align(const std::vector<PosePair>& pairs, Freedom freedom);

/// The pairs with their estimates aligned.
std::vector<PosePair> Aligned(std::vector<PosePair> pairs, const Similarity& alignment);

/// Absolute trajectory error (Sturm et al. 2012) after alignment.
struct AbsoluteError {
  Similarity alignment;
  Statistics position;  // m
  Statistics rotation;  // deg
};
AbsoluteError AbsoluteErrorOf(const std::vector<PosePair>& pairs, Freedom freedom);

}  // namespace alula::scenarios::trajectory

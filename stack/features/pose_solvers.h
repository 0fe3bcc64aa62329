#pragma once

#include <array>
#include <vector>

#include "base/frames.h"

namespace alula::stack::features {

/// A point known in one camera's frame, and where another camera sees it (normalised).
struct PointAndRay {
  base::Vec3 p = base::Vec3::Zero();
  base::Vec2 seen = base::Vec2::Zero();
};

/// Poses X_TS, T the camera that sees and S that of the points, from three of them: at most four (P3P; Ke and
/// Roumeliotis 2017, as OpenCV has it).
std::vector<base::Transform> SolveThreePoints(const std::array<PointAndRay, 3>& points);

/// The same from two points where both cameras know which way is up (unit vectors in their frames): at most two. About
/// the vertical, with c, s of the heading, both points' rays give two linear equations each in c, s and the two depths'
/// differences; one line in (c, s) remains, which meets the unit circle (cf. Kukelova et al. 2010).
std::vector<base::Transform> SolveTwoPoints(const std::array<PointAndRay, 2>& points, const base::Vec3& up_S,
                                            const base::Vec3& up_T);

}  // namespace alula::stack::features

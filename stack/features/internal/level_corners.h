#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "base/frames.h"
#include "stack/features/internal/quadtree.h"
#include "stack/features/orb_config.h"

namespace alula::stack::features::internal {

/// px kept free at the edge of each level: the disc of a turned patch and what its kernels read beyond.
inline constexpr int kOrbBorder = 16;

/// FAST corners (Rosten and Drummond 2006, 9 of 16, without those beside a stronger one) of a level, each cell with the
/// threshold that suits it: the low one where the high one finds nothing. In no particular order, but always the same.
std::vector<LevelCorner> FindLevelCorners(const cv::Mat& level, const OrbConfig& config);

/// The place p that the gradients g of the 7×7 px around a corner agree on: p = (Σ g gᵀ)⁻¹ Σ g gᵀ x (Förstner and Gülch
/// 1987), one step from whole pixels. The corner itself where they do not agree, or on a place beyond 1 px.
base::Vec2 RefineCorner(const cv::Mat& level, int x, int y);

}  // namespace alula::stack::features::internal

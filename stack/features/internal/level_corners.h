#pragma once

#include <vector>

#include "stack/features/internal/octave.h"
#include "stack/features/internal/quadtree.h"

namespace alula::stack::features::internal {

/// FAST corners (Rosten and Drummond 2006: 9 of 16, local maxima of the score) of a level in reading order, each cell
/// with the threshold that suits it: the low one where the high one finds nothing. Places between pixels are those of
/// the tops of parabolas through the scores. `scratch` is no smaller than the level.
std::vector<LevelCorner> FindLevelCorners(const Octave& level, const OrbConfig& config, Octave& scratch);

}  // namespace alula::stack::features::internal

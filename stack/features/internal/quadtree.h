#pragma once

#include <span>
#include <vector>

namespace alula::stack::features::internal {

/// A corner of one pyramid level.
struct LevelCorner {
  int x = 0, y = 0;            // px of the level
  float response = 0.0F;       // what decides who stays
  float dx = 0.0F, dy = 0.0F;  // from the whole pixel to its place, within ±½ px
};

/// At most `wanted` corners spread over the box [0, width) × [0, height): square roots are divided into four, largest
/// leaves first and of equal ones the fullest, until there are as many leaves as corners wanted, each holds one, or
/// they are no larger than `smallest` px; of each leaf the strongest stays (P1, section 3; Mur-Artal et al. 2015). In
/// the order of y, then x.
std::vector<LevelCorner> Distribute(std::span<const LevelCorner> corners, int width, int height, int wanted,
                                    int smallest);

}  // namespace alula::stack::features::internal

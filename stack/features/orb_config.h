#pragma once

#include <cstdint>

#include "base/describe.h"

namespace alula::stack::features {

/// What decides which corner of a quadtree's leaf stays.
enum class OrbRanking : std::uint8_t {
  kScore,     // FAST's own score: the largest threshold at which it is a corner
  kSaliency,  // P1, eq. 1: C = Σ |I_p − I_i| over the circle's 16 pixels
};

/// How ORB keypoints are found.
struct OrbConfig {
  int keypoints = 500;    // an image; more make recognition surer and everything after it slower
  int levels = 8;         // 8 at 1.2 bridge a factor of 3.6 in distance
  double scale = 1.2;     // between levels
  int cell = 32;          // px: side of the cells that choose their own threshold
  int threshold = 20;     // grey levels of FAST
  int low_threshold = 7;  // where a cell has none; pixel noise is about 1
  int smallest_leaf = 5;  // px of the level: a quadtree's leaf is not divided below; P1 has 10
  OrbRanking ranking = OrbRanking::kScore;
  bool sub_pixel = true;  // refine to a fraction of a pixel
};

void Describe(base::Description& d, OrbConfig& c);

}  // namespace alula::stack::features

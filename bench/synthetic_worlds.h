#pragma once

#include <cstdint>

#include "worlds/world.h"

namespace alula::bench {

/// Worlds made for the rendering benchmark, each of about 90 k triangles: 40 m × 24 m about the origin, ground at
/// z = 0; the ellipse of half-axes 9 m × 5 m, on which the benchmark's camera flies, is free.

/// A hall: floor, walls and ceiling, pillars, shelves full of boxes, drums, pipes, balls.
worlds::World SyntheticHall(std::uint64_t seed);
/// A forest: ground, trunks with crowns, bushes, stones.
worlds::World SyntheticForest(std::uint64_t seed);

/// Triangles that the renderer draws of a world.
double TrianglesOf(const worlds::World& world);

/// A texture of grey noise, 512² texels.
geometry::Material NoisyMaterial(const char* name, std::uint64_t seed);

}  // namespace alula::bench

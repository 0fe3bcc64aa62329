#pragma once

#include <vector>

#include "geometry/shape.h"

namespace alula::render::internal {

/// A shape with fewer triangles, for eyes that are far away.
struct DetailLevel {
  geometry::Mesh mesh;
  double error = 0.0;  // m: a bound on how far the surface lies from that of the full level
};

/// The full level (error 0), then coarser ones, each with a larger error and fewer triangles; at most `kMostLevels`.
/// Round shapes: circles of 24, 12 and 8 segments, as much outside the full level's surface as inside. Meshes of many
/// triangles: vertices clustered in cells. A wire of radius `wire` (m; 0: none): the same mesh, each level 1.6 times as
/// thick as the one before. What is thinner than a pixel is hit by some pixels' centres and missed by others, a row of
/// dots; a level that is chosen as any other is (LevelFor) is no more than half a pixel too thick to each side, and
/// about a pixel wide.
inline constexpr int kMostLevels = 6;
std::vector<DetailLevel> DetailLevels(const geometry::Shape& shape, double texture_scale, double wire = 0.0);

/// Vertex clustering (Rossignac and Borrel 1993): the vertices in each cell of a grid of `cell` metres move to the one
/// nearest to their mean; triangles that lose their area go. Vertices of one place that differ in normal or texture
/// coordinates (creases, seams) stay apart. The error is the longest move: every point of the surface is a convex
/// combination of corners and moves no farther.
DetailLevel Clustered(const geometry::Mesh& mesh, double cell);

}  // namespace alula::render::internal

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace alula::geometry::internal {

/// A polygon of more corners that is not convex is refused: cutting it takes the cube of their number.
inline constexpr std::size_t kMostConcaveCorners = 256;

/// Triangles of a polygon whose corners lie about in one plane, as indices of its corners, with its winding. A convex
/// one is cut into a fan about corner 0, any other by its ears (Meisters 1975). A polygon without area gives a fan too.
/// Empty: its outline crosses itself, or it has too many corners.
std::vector<std::array<std::uint32_t, 3>> Triangulate(const std::vector<Eigen::Vector3f>& corners);

}  // namespace alula::geometry::internal

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace alula::geometry::internal {

/// Nothing that a vehicle meets lies further from a mesh's origin; floats resolve 1 mm there.
inline constexpr float kFarthest = 1e4F;  // m
/// Texture coordinates beyond have less than a texel's resolution left.
inline constexpr float kFarthestUv = 1e4F;

/// What a reader of a format gathers: vertices as they stand in the file, turned to z up.
struct RawMesh {
  struct Vertex {
    Eigen::Vector3f position{0.0F, 0.0F, 0.0F};  // m
    std::optional<Eigen::Vector3f> normal;       // of any length
    std::optional<Eigen::Vector2f> uv;
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The nearest float; infinity beyond their range (where C++ leaves the conversion undefined).
float ToFloat(double value);

/// What is wrong with a vertex (not finite, absurdly far); empty when nothing is.
std::string WhatIsWrong(const RawMesh::Vertex& vertex);

/// "N triangles are more than the M allowed" when they are.
void CheckTriangles(std::size_t triangles, std::size_t max_triangles, const std::filesystem::path& file);

/// The mesh that the renderer and Bullet take: without triangles that have no area, with unit normals (where the file
/// gives none, the mean of the unit normals of the faces that meet at the place) and texture coordinates (where there
/// are none, metres on the plane that the normal is most square to). Throws base::InputError when nothing is left.
Mesh Finish(const RawMesh& raw, const std::filesystem::path& file);

}  // namespace alula::geometry::internal

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/frames.h"

namespace alula::geometry {

/// A triangle mesh in its own frame: counter-clockwise triangles seen from outside, metres.
struct Mesh {
  struct Vertex {
    Eigen::Vector3f position;  // m
    Eigen::Vector3f normal;    // unit
    Eigen::Vector2f uv;        // texture coordinates; textures repeat every 1.0
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Reads a glTF, GLB or OBJ file (z up after loading, metres), triangulated, with normals.
/// Throws base::InputError when the file is missing, broken, empty, not finite or has more than `max_triangles`.
Mesh LoadMesh(const std::filesystem::path& file, std::size_t max_triangles = 200'000);

}  // namespace alula::geometry

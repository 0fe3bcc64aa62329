#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "geometry/internal/raw_mesh.h"

namespace alula::geometry::internal {

/// Reads glTF 2.0 (Khronos Group, "glTF 2.0 Specification", 2.0.1) as .gltf or .glb: the triangles of the scene that
/// the file shows, placed by their nodes, turned from y up to z up; flat normals where it gives none (section 3.7.2.1).
/// Materials, cameras, animations and morph targets are passed over; compressed meshes and skins are refused.
/// `file` is for messages, its folder holds buffers. Throws base::InputError.
RawMesh ReadGltf(std::string_view bytes, bool is_glb, const std::filesystem::path& file, std::size_t max_triangles);

}  // namespace alula::geometry::internal

#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "geometry/mesh.h"

namespace alula::geometry::internal {

/// What LoadMesh makes of the bytes of `file`, whose extension says the format.
Mesh ParseMesh(std::string_view bytes, const std::filesystem::path& file, std::size_t max_triangles);

}  // namespace alula::geometry::internal

#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "geometry/internal/raw_mesh.h"

namespace alula::geometry::internal {

/// Reads Wavefront OBJ (Wavefront Technologies, "Object Files", appendix B1): v, vt, vn and f with polygons and
/// relative indices; groups, materials, points and lines are passed over, free-form surfaces refused. As it stands:
/// z up, metres. `file` is for messages. Throws base::InputError with line and column.
RawMesh ReadObj(std::string_view text, const std::filesystem::path& file, std::size_t max_triangles);

}  // namespace alula::geometry::internal

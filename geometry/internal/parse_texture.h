#pragma once

#include <filesystem>
#include <string_view>

#include "geometry/material.h"

namespace alula::geometry::internal {

/// What LoadTexture makes of the bytes of `file`.
Texture ParseTexture(std::string_view bytes, const std::filesystem::path& file);

}  // namespace alula::geometry::internal

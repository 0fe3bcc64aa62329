#pragma once

#include <filesystem>

#include "geometry/material.h"

namespace alula::geometry {

/// A side of more texels shows nothing that a camera at flight distance resolves, and costs 64 MB and more.
inline constexpr int kMostTexels = 4096;

/// Reads a PNG file of at most kMostTexels a side; one whose alpha is below half somewhere has holes there. Sides that
/// are no powers of two are resampled up to the next one (bilinear; the picture repeats across its rims, as textures
/// do). Throws base::InputError when the file is missing, no PNG, broken or too large.
Texture LoadTexture(const std::filesystem::path& file);

}  // namespace alula::geometry

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/scenario.h"

namespace alula::scenarios::gallery {

/// What a grey picture offers a tracker. Counts are for 752 × 480 px: others are scaled by their area (corners) and by
/// its root (lines).
struct PictureTexture {
  double corners = 0.0;   // the best of each 8 × 8 px whose smaller eigenvalue of the mean gradient matrix over
                          // 7 × 7 px is above 4² (grey level/px)² (Shi and Tomasi 1994)
  double lines = 0.0;     // segments of ≥ 40 px by LSD (von Gioi et al. 2010)
  double bare = 0.0;      // share of cells of 32 × 32 px with neither
  double mean = 0.0;      // grey levels
  double contrast = 0.0;  // standard deviation, grey levels
};
/// `bytes`: `width` · `height` grey values, rows from the top.
PictureTexture TextureOf(const std::vector<std::uint8_t>& bytes, int width, int height);

/// Median and quartiles over pictures.
struct Spread {
  double low = 0.0, median = 0.0, high = 0.0;
};
struct TextureRow {
  std::string name;
  std::size_t pictures = 0;
  Spread corners, lines, bare, mean, contrast;
};

/// `count` views of the world from random places, as a camera with the default noise takes them.
TextureRow TextureOfWorld(const WorldConfig& config, const std::string& name, std::uint64_t seed, int count,
                          const std::string& maker);
/// All PNG files of a folder. Throws base::InputError where there is none or one cannot be read.
TextureRow TextureOfFolder(const std::filesystem::path& folder);

std::string ToTable(const std::vector<TextureRow>& rows);
std::string ToJson(const std::vector<TextureRow>& rows);

}  // namespace alula::scenarios::gallery

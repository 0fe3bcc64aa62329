#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenarios/scenario.h"

namespace alula::scenarios::gallery {

/// A world in one picture: a row for each viewpoint; by day colour, grey, depth and ids; by night colour as a camera
/// that opens up to 8 times shows it, and infrared with an illuminator on the camera.
struct ContactSheet {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
  double load_ms = 0.0;  // wall time that the world by day took to make
  std::size_t objects = 0;
  std::size_t triangles = 0;
};

/// `maker`: as render::MakeRenderer has it. `title`: the world's name.
ContactSheet MakeContactSheet(const WorldConfig& config, const std::string& title, std::uint64_t seed,
                              const std::string& maker);

}  // namespace alula::scenarios::gallery

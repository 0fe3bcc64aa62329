#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace alula::geometry {

/// An RGB texture, rows from v = 0 upwards, side lengths powers of two, repeating; sRGB-like values as displayed.
struct Texture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;    // 3 bytes a texel
  std::vector<std::uint8_t> alpha;  // 1 byte a texel: where it is below half, nothing is there; empty: all is there
};

/// How a surface looks: diffuse colour times texture.
struct Material {
  std::string name;
  Eigen::Vector3f colour = Eigen::Vector3f::Ones();
  std::shared_ptr<const Texture> texture;  // null: plain colour
  float infrared = 1.0F;                   // factor on the albedo as an infrared camera sees it: leaves some 2
};

inline bool HasHoles(const Material& material) { return material.texture && !material.texture->alpha.empty(); }

}  // namespace alula::geometry

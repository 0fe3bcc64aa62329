#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "base/frames.h"
#include "geometry/material.h"

namespace alula::worlds {

/// What a texture looks like. All but kPaint are irregular at every scale from two texels to a third of the texture, so
/// that corners can be tracked from 0.3 m to 20 m, and all repeat seamlessly.
enum class Pattern {
  kBrick,
  kPlaster,
  kConcrete,
  kRubble,
  kPaving,
  kGravel,
  kWood,
  kBark,
  kFoliage,
  kSignal,
  kPad,
  kGrass,
  kAsphalt,
  kLitter,  // fallen leaves and twigs
  kSoil,
  kTiles,  // of a floor
  kMetal,  // sheets
  kCarpet,
  kPaint  // a white wall: all but bare
};

/// Two colours that the pattern's tone runs between, in [0, 1].
struct Palette {
  Eigen::Vector3f dark{0.1F, 0.1F, 0.1F};
  Eigen::Vector3f light{0.9F, 0.9F, 0.9F};
};

/// Standard deviation of a texture's tones, of full scale: all that a picture can hold with little of it clipped. Real
/// ground and walls have a third to a half of it.
inline constexpr double kFullContrast = 0.27;

/// A texture of `size`² texels (a power of two ≥ 16) from the stream "world/texture/<name>" of `seed`.
std::shared_ptr<const geometry::Texture> MakeTexture(Pattern pattern, const Palette& palette, int size,
                                                     std::uint64_t seed, std::string_view name,
                                                     double contrast = kFullContrast);

/// Textures of one pattern that are equal along the lines u = ½ and v = ½ and differ between them: cells cut there
/// (a whole number of periods about the middle of a cell's texture) fit side by side in any order, and no period shows.
std::vector<std::shared_ptr<const geometry::Texture>> MakeTextureVariants(Pattern pattern, const Palette& palette,
                                                                          int size, std::uint64_t seed,
                                                                          std::string_view name, int count,
                                                                          double contrast = kFullContrast);

/// A spray of leaves inside the unit square, with holes between them (alpha): foliage of the palette whose tone differs
/// from leaf to leaf. From the stream "world/leaves/<name>" of `seed`.
std::shared_ptr<const geometry::Texture> MakeLeafTexture(const Palette& palette, int size, std::uint64_t seed,
                                                         std::string_view name);

/// The key `texture_size` of a world.
void DescribeTextureSize(base::Description& d, int& size);

}  // namespace alula::worlds

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/random.h"
#include "worlds/textures.h"

namespace alula::worlds {
namespace {

/// A pointed leaf: two arcs that meet at its ends.
struct Leaf {
  base::Vec2 middle;  // of the unit square
  base::Vec2 along;   // unit
  double half_length = 0.0;
  double half_width = 0.0;
  float tone = 1.0F;  // factor on the colour
};

/// How far inside the leaf a point lies, in its half widths (negative outside); `side` of its middle rib.
double Inside(const Leaf& leaf, const base::Vec2& p, double& side) {
  const base::Vec2 d = p - leaf.middle;
  const double along = d.dot(leaf.along) / leaf.half_length;
  side = (d.y() * leaf.along.x() - d.x() * leaf.along.y()) / leaf.half_width;
  return (1.0 - along * along) - std::abs(side);
}

std::vector<Leaf> DrawLeaves(base::RandomStream& random) {
  constexpr int kLeaves = 60;
  constexpr double kLongest = 0.13;  // half, of the square's side
  std::vector<Leaf> leaves;
  for (int i = 0; i < kLeaves; ++i) {
    Leaf leaf;
    leaf.half_length = random.Uniform(0.08, kLongest);
    leaf.half_width = leaf.half_length * random.Uniform(0.35, 0.5);
    const double place = 2.0 * std::numbers::pi * random.Uniform();
    const double reach = (0.5 - kLongest) * std::sqrt(random.Uniform());  // so that no leaf is cut by the border
    leaf.middle = base::Vec2(0.5, 0.5) + reach * base::Vec2(std::cos(place), std::sin(place));
    const double direction = place + random.Uniform(-0.9, 0.9);  // outwards, about
    leaf.along = {std::cos(direction), std::sin(direction)};
    leaf.tone = static_cast<float>(random.Uniform(0.6, 1.25));
    leaves.push_back(leaf);
  }
  return leaves;
}

}  // namespace

std::shared_ptr<const geometry::Texture> MakeLeafTexture(const Palette& palette, int size, std::uint64_t seed,
                                                         std::string_view name) {
  auto texture = std::make_shared<geometry::Texture>(*MakeTexture(Pattern::kFoliage, palette, size, seed, name));
  base::RandomStream random(seed, "world/leaves/" + std::string(name));
  const std::vector<Leaf> leaves = DrawLeaves(random);
  texture->alpha.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 0);
  for (std::size_t i = 0; i < texture->alpha.size(); ++i) {
    const base::Vec2 p((static_cast<double>(i % static_cast<std::size_t>(size)) + 0.5) / size,
                       (static_cast<double>(i / static_cast<std::size_t>(size)) + 0.5) / size);
    float tone = 1.0F;
    for (const Leaf& leaf : leaves) {
      double side = 0.0;
      const double inside = Inside(leaf, p, side);
      if (inside < -1.0) continue;
      // One texel of ramp, so that the border of a sampled leaf is smooth.
      const double alpha = std::clamp(0.5 + inside * leaf.half_width * size, 0.0, 1.0);
      texture->alpha[i] = std::max(texture->alpha[i], static_cast<std::uint8_t>(255.0 * alpha + 0.5));
      if (inside > 0.0) tone = leaf.tone * (std::abs(side) < 0.08 ? 1.2F : side > 0.0 ? 1.0F : 0.85F);
    }
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint8_t& value = texture->rgb[3 * i + c];
      value = static_cast<std::uint8_t>(std::min(tone * static_cast<float>(value), 255.0F));
    }
  }
  return texture;
}

}  // namespace alula::worlds

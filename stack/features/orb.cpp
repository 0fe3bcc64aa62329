#include "stack/features/orb.h"

#include <cmath>

#include "stack/features/internal/level_corners.h"
#include "stack/features/internal/orb_kernels.h"

namespace alula::stack::features {
namespace {

using base::Vec2;
using internal::kOrbBorder;
using internal::Octave;

/// How many keypoints the octaves should give: as their scale is, so that they are alike dense in each.
std::vector<int> Quotas(std::size_t octaves, const OrbConfig& config) {
  double all = 0.0;
  for (std::size_t l = 0; l < octaves; ++l) all += 1.0 / OctaveScale(config, static_cast<int>(l));
  std::vector<int> quotas;
  for (std::size_t l = 0; l < octaves; ++l) {
    quotas.push_back(
        static_cast<int>(std::lround(config.keypoints / (all * OctaveScale(config, static_cast<int>(l))))));
  }
  return quotas;
}

/// Orientation and tests of the patch around a pixel of a level.
void DescribePatch(const Octave& level, const Octave& smooth, int x, int y, Keypoint& keypoint) {
  const internal::OrbKernels& kernels = internal::ChooseOrbKernels();
  std::int32_t m10 = 0, m01 = 0;
  kernels.moments(level.Row(y) + x, level.stride, &m10, &m01);
  const double length = std::sqrt(static_cast<double>(m10) * m10 + static_cast<double>(m01) * m01);
  const double c = length > 0 ? m10 / length : 1.0, s = length > 0 ? m01 / length : 0.0;
  keypoint.angle = std::atan2(s, c);
  kernels.describe(smooth.Row(y) + x, smooth.stride, static_cast<float>(c), static_cast<float>(s), internal::Pattern(),
                   keypoint.descriptor.data());
}

bool PatchFits(const Octave& level, int x, int y) {
  return x >= kOrbBorder && y >= kOrbBorder && x < level.width - kOrbBorder && y < level.height - kOrbBorder;
}

/// Keypoints of one octave, at most `quota`. `shrink`: px of the image a px of the level, along and down.
std::vector<Keypoint> DetectOctave(const Octave& level, int octave, int quota, const Vec2& shrink,
                                   const OrbConfig& config, Octave& scratch) {
  const std::vector<internal::LevelCorner> corners = internal::Distribute(
      internal::FindLevelCorners(level, config, scratch), level.width, level.height, quota, config.smallest_leaf);
  std::vector<Keypoint> keypoints;
  if (corners.empty()) return keypoints;
  Octave& smooth = scratch;
  internal::Smooth(level, smooth);
  keypoints.reserve(corners.size());
  for (const internal::LevelCorner& corner : corners) {
    Vec2 place(corner.x, corner.y);
    if (config.sub_pixel) place += Vec2(corner.dx, corner.dy);
    Keypoint keypoint;
    keypoint.pixel = (place + Vec2::Constant(0.5)).cwiseProduct(shrink) - Vec2::Constant(0.5);  // centres are whole
    keypoint.octave = octave;
    keypoint.response = corner.response;
    DescribePatch(level, smooth, corner.x, corner.y, keypoint);
    keypoints.push_back(keypoint);
  }
  return keypoints;
}

}  // namespace

double OctaveScale(const OrbConfig& config, int octave) { return std::pow(config.scale, octave); }

std::vector<Keypoint> DetectOrb(const Image& image, const OrbConfig& config) {
  const std::vector<Octave> octaves = internal::BuildOctaves(image, config);
  const std::vector<int> quotas = Quotas(octaves.size(), config);
  std::vector<std::vector<Keypoint>> found(octaves.size());
  Octave scratch(image.width, image.height);
  int missing = 0;  // what coarser octaves could not give, finer ones may
  for (std::size_t l = octaves.size(); l-- > 0;) {
    const Vec2 shrink(static_cast<double>(image.width) / octaves[l].width,
                      static_cast<double>(image.height) / octaves[l].height);
    const int quota = quotas[l] + missing;
    found[l] = DetectOctave(octaves[l], static_cast<int>(l), quota, shrink, config, scratch);
    missing = quota - static_cast<int>(found[l].size());
  }
  std::vector<Keypoint> keypoints;
  for (const std::vector<Keypoint>& octave : found) keypoints.insert(keypoints.end(), octave.begin(), octave.end());
  return keypoints;
}

std::vector<std::optional<Keypoint>> DescribeOrb(const Image& image, std::span<const Vec2> pixels) {
  std::vector<std::optional<Keypoint>> answers(pixels.size());
  const Octave level = internal::FirstOctave(image);
  if (pixels.empty()) return answers;
  Octave smooth(level.width, level.height);
  internal::Smooth(level, smooth);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const int x = static_cast<int>(std::lround(pixels[i].x())), y = static_cast<int>(std::lround(pixels[i].y()));
    if (!PatchFits(level, x, y)) continue;
    Keypoint keypoint;
    keypoint.pixel = pixels[i];
    DescribePatch(level, smooth, x, y, keypoint);
    answers[i] = keypoint;
  }
  return answers;
}

}  // namespace alula::stack::features

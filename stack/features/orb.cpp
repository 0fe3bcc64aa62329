#include "stack/features/orb.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "stack/features/internal/level_corners.h"
#include "stack/features/internal/orb_kernels.h"

namespace alula::stack::features {
namespace {

using base::Vec2;
using internal::kOrbBorder;

/// A view of the image's pixels; nothing here writes to them.
cv::Mat ViewOf(const Image& image) {
  if (image.format != PixelFormat::kGrey8 || !image.bytes || image.width <= 0 || image.height <= 0) {
    throw base::InputError("ORB: expected an 8-bit grey image");
  }
  return {image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.Row(0)),
          static_cast<std::size_t>(image.stride)};
}

/// The image and its coarser octaves, each made from the one before, as far as a patch fits in.
std::vector<cv::Mat> BuildOctaves(const cv::Mat& image, const OrbConfig& config) {
  std::vector<cv::Mat> octaves{image};
  for (int l = 1; l < config.levels; ++l) {
    const double scale = OctaveScale(config, l);
    const cv::Size size(static_cast<int>(std::lround(image.cols / scale)),
                        static_cast<int>(std::lround(image.rows / scale)));
    if (std::min(size.width, size.height) <= 2 * kOrbBorder) break;
    cv::Mat smaller;
    cv::resize(octaves.back(), smaller, size, 0, 0, cv::INTER_LINEAR);
    octaves.push_back(smaller);
  }
  return octaves;
}

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

/// BRIEF compares single pixels: they must stand for their surroundings (Calonder et al. 2010).
cv::Mat Smoothed(const cv::Mat& level) {
  cv::Mat smooth;
  cv::GaussianBlur(level, smooth, cv::Size(7, 7), 2.0, 2.0, cv::BORDER_REFLECT_101);
  return smooth;
}

/// Orientation and tests of the patch around a pixel of a level.
void DescribePatch(const cv::Mat& level, const cv::Mat& smooth, int x, int y, Keypoint& keypoint) {
  const internal::OrbKernels& kernels = internal::ChooseOrbKernels();
  std::int32_t m10 = 0, m01 = 0;
  kernels.moments(level.ptr<std::uint8_t>(y) + x, static_cast<std::ptrdiff_t>(level.step), &m10, &m01);
  const double length = std::sqrt(static_cast<double>(m10) * m10 + static_cast<double>(m01) * m01);
  const double c = length > 0 ? m10 / length : 1.0, s = length > 0 ? m01 / length : 0.0;
  keypoint.angle = std::atan2(s, c);
  kernels.describe(smooth.ptr<std::uint8_t>(y) + x, static_cast<std::ptrdiff_t>(smooth.step), static_cast<float>(c),
                   static_cast<float>(s), internal::Pattern(), keypoint.descriptor.data());
}

bool PatchFits(const cv::Mat& level, int x, int y) {
  return x >= kOrbBorder && y >= kOrbBorder && x < level.cols - kOrbBorder && y < level.rows - kOrbBorder;
}

/// Keypoints of one octave, at most `quota`. `shrink`: px of the image a px of the level, along and down.
std::vector<Keypoint> DetectOctave(const cv::Mat& level, int octave, int quota, const Vec2& shrink,
                                   const OrbConfig& config) {
  const std::vector<internal::LevelCorner> corners = internal::Distribute(
      internal::FindLevelCorners(level, config), level.cols, level.rows, quota, config.smallest_leaf);
  std::vector<Keypoint> keypoints;
  if (corners.empty()) return keypoints;
  const cv::Mat smooth = Smoothed(level);
  keypoints.reserve(corners.size());
  for (const internal::LevelCorner& corner : corners) {
    const Vec2 place = config.sub_pixel ? internal::RefineCorner(level, corner.x, corner.y) : Vec2(corner.x, corner.y);
    int x = static_cast<int>(std::lround(place.x())), y = static_cast<int>(std::lround(place.y()));
    if (!PatchFits(level, x, y)) x = corner.x, y = corner.y;
    Keypoint keypoint;
    keypoint.pixel = (place + Vec2::Constant(0.5)).cwiseProduct(shrink) - Vec2::Constant(0.5);  // centres are whole
    keypoint.octave = octave;
    keypoint.response = corner.response;
    DescribePatch(level, smooth, x, y, keypoint);
    keypoints.push_back(keypoint);
  }
  return keypoints;
}

}  // namespace

double OctaveScale(const OrbConfig& config, int octave) { return std::pow(config.scale, octave); }

std::vector<Keypoint> DetectOrb(const Image& image, const OrbConfig& config) {
  const cv::Mat view = ViewOf(image);
  const std::vector<cv::Mat> octaves = BuildOctaves(view, config);
  const std::vector<int> quotas = Quotas(octaves.size(), config);
  std::vector<std::vector<Keypoint>> found(octaves.size());
  int missing = 0;  // what coarser octaves could not give, finer ones may
  for (std::size_t l = octaves.size(); l-- > 0;) {
    const Vec2 shrink(static_cast<double>(view.cols) / octaves[l].cols,
                      static_cast<double>(view.rows) / octaves[l].rows);
    const int quota = quotas[l] + missing;
    found[l] = DetectOctave(octaves[l], static_cast<int>(l), quota, shrink, config);
    missing = quota - static_cast<int>(found[l].size());
  }
  std::vector<Keypoint> keypoints;
  for (const std::vector<Keypoint>& octave : found) keypoints.insert(keypoints.end(), octave.begin(), octave.end());
  return keypoints;
}

std::vector<std::optional<Keypoint>> DescribeOrb(const Image& image, std::span<const Vec2> pixels) {
  const cv::Mat level = ViewOf(image);
  std::vector<std::optional<Keypoint>> answers(pixels.size());
  if (pixels.empty()) return answers;
  const cv::Mat smooth = Smoothed(level);
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

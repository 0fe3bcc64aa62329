#include "stack/features/internal/octave.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "stack/features/internal/orb_kernels.h"

namespace alula::stack::features::internal {
namespace {

/// Where the centre of pixel i of a smaller image lies between pixels `first` and `first + 1` of the larger one.
struct Between {
  int first = 0;
  int weight = 0;  // of the second, 1/64
};

Between Place(int i, int small, int large) {
  const double at = (i + 0.5) * large / small - 0.5;
  const int first = std::clamp(static_cast<int>(std::floor(at)), 0, large - 2);
  return {first, std::clamp(static_cast<int>(std::lround(64.0 * (at - first))), 0, 64)};
}

std::vector<ColumnBlend> Columns(int small, int large) {
  std::vector<ColumnBlend> columns(static_cast<std::size_t>((small + 7) / 8));
  for (std::size_t g = 0; g < columns.size(); ++g) {
    const int begin = 8 * static_cast<int>(g);
    columns[g].first = Place(begin, small, large).first;
    for (int k = 0; k < 8; ++k) {
      const Between p = Place(std::min(begin + k, small - 1), small, large);
      const auto step = static_cast<std::uint8_t>(p.first - columns[g].first);
      columns[g].pair[2 * k] = step;
      columns[g].pair[2 * k + 1] = static_cast<std::uint8_t>(step + 1);
      columns[g].weight[2 * k] = static_cast<std::int8_t>(64 - p.weight);
      columns[g].weight[2 * k + 1] = static_cast<std::int8_t>(p.weight);
    }
  }
  return columns;
}

Octave Shrink(const Octave& large, int width, int height) {
  const OrbKernels& kernels = ChooseOrbKernels();
  Octave small(width, height);
  const std::vector<ColumnBlend> columns = Columns(width, large.width);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(large.stride));
  for (int v = 0; v < height; ++v) {
    const Between p = Place(v, height, large.height);
    kernels.blend_rows(large.Row(p.first), large.Row(p.first + 1), p.weight, large.width, row.data());
    kernels.blend_columns(row.data(), columns.data(), static_cast<int>(columns.size()), small.Row(v));
  }
  return small;
}

}  // namespace

Octave FirstOctave(const Image& image) {
  if (image.format != PixelFormat::kGrey8 || !image.bytes || image.width <= 0 || image.height <= 0) {
    throw base::InputError("ORB: expected an 8-bit grey image");
  }
  Octave octave(image.width, image.height);
  for (int v = 0; v < image.height; ++v) std::copy_n(image.Row(v), image.width, octave.Row(v));
  return octave;
}

std::vector<Octave> BuildOctaves(const Image& image, const OrbConfig& config) {
  std::vector<Octave> octaves;
  octaves.push_back(FirstOctave(image));
  for (int l = 1; l < config.levels; ++l) {
    const double scale = std::pow(config.scale, l);
    const int width = static_cast<int>(std::lround(image.width / scale));
    const int height = static_cast<int>(std::lround(image.height / scale));
    if (std::min(width, height) <= 2 * kOrbBorder) break;
    octaves.push_back(Shrink(octaves.back(), width, height));
  }
  return octaves;
}

void Smooth(const Octave& octave, Octave& smooth) {
  std::vector<std::uint16_t> scratch(static_cast<std::size_t>(octave.stride));
  for (int v = 3; v < octave.height - 3; ++v) {
    ChooseOrbKernels().smooth(octave.Row(v) + 3, octave.stride, octave.width - 6, scratch.data(), smooth.Row(v) + 3);
  }
}

}  // namespace alula::stack::features::internal

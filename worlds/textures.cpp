#include "worlds/textures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "worlds/texture_canvas.h"

namespace alula::worlds {
namespace {

using base::RandomStream;

/// Joints and cell tones: `joint` texels of a 1024 texture wide.
void PaintCells(Canvas& canvas, int columns, int rows, double jitter, float joint_tone, float joint,
                RandomStream& random) {
  const Cells cells = MakeCells(canvas.size, columns, rows, jitter, random);
  std::vector<float> tones(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (float& t : tones) t = static_cast<float>(random.Uniform(0.15, 0.9));
  const float width = std::max(joint * static_cast<float>(canvas.size) / 1024.0F, 0.5F);
  for (std::size_t i = 0; i < canvas.tone.size(); ++i) {
    canvas.tone[i] = cells.edge[i] < width ? joint_tone : tones[cells.id[i]];
  }
}

/// Courses of bricks (or planks when there are few, long ones) of irregular length and tone.
void PaintCourses(Canvas& canvas, int courses, double length_min, double length_max, float joint_tone,
                  RandomStream& random) {
  const int size = canvas.size;
  const int joint = std::max(1, size / 256);
  for (int course = 0; course < courses; ++course) {
    const int y0 = course * size / courses;
    const int y1 = (course + 1) * size / courses;
    const int shift = static_cast<int>(random.Index(static_cast<std::uint64_t>(size)));
    for (int x = 0; x < size;) {
      int length = static_cast<int>(random.Uniform(length_min, length_max) * size);
      if (size - x - length < static_cast<int>(length_min * size)) length = size - x;  // the last one closes the row
      const auto tone = static_cast<float>(random.Uniform(0.1, 0.85));
      for (int y = y0; y < y1; ++y) {
        for (int i = x; i < x + length; ++i) {
          canvas.At(i + shift, y) = (y < y0 + joint || i < x + joint) ? joint_tone : tone;
        }
      }
      x += length;
    }
  }
}

/// Rings and sectors about the corner (0, 0), where a cap's centre lies.
void PaintTarget(Canvas& canvas) {
  const int half = canvas.size / 2;
  for (int y = -half; y < half; ++y) {
    for (int x = -half; x < half; ++x) {
      const double r = std::hypot(x, y) / half;
      const double sector = std::atan2(y, x) / (2.0 * std::numbers::pi) * 10.0;
      const int parity = static_cast<int>(r * 4.0) + static_cast<int>(std::floor(sector));
      canvas.At(x, y) = (parity & 1) != 0 ? 0.85F : 0.15F;
    }
  }
}

void AddNoise(Canvas& canvas, float amplitude, RandomStream& random) {
  const Canvas noise = PinkNoise(canvas.size, random);
  for (std::size_t i = 0; i < canvas.tone.size(); ++i) canvas.tone[i] += amplitude * noise.tone[i];
}

/// Where coarse noise is above `threshold`, the coat has fallen off and a darker ground shows.
void PaintFallenCoat(Canvas& canvas, float threshold, float change, RandomStream& random) {
  const Canvas noise = PinkNoise(canvas.size, random);
  for (std::size_t i = 0; i < canvas.tone.size(); ++i) {
    if (noise.tone[i] > threshold) canvas.tone[i] += change;
  }
}

/// Tones of mean 0.5 and deviation 0.27: all the contrast that a picture can hold with little of it clipped.
void Stretch(Canvas& canvas) {
  double sum = 0.0;
  double squares = 0.0;
  for (const float t : canvas.tone) {
    sum += t;
    squares += static_cast<double>(t) * t;
  }
  const double count = static_cast<double>(canvas.tone.size());
  const double mean = sum / count;
  const auto gain = static_cast<float>(0.27 / std::sqrt(std::max(squares / count - mean * mean, 1e-6)));
  for (float& t : canvas.tone) t = 0.5F + gain * (t - static_cast<float>(mean));
}

void Paint(Canvas& canvas, Pattern pattern, RandomStream& random) {
  switch (pattern) {
    case Pattern::kBrick:
      PaintCourses(canvas, 22, 0.05, 0.13, 0.95F, random);
      PaintLeaves(canvas, {.coverage = 0.7, .opacity = 0.5F}, random);
      break;
    case Pattern::kPlaster:
      PaintLeaves(canvas, {.coverage = 1.6, .radius_max = 0.16, .opacity = 0.6F}, random);
      PaintFallenCoat(canvas, 0.9F, -0.35F, random);
      break;
    case Pattern::kConcrete:
      PaintCourses(canvas, 5, 0.15, 0.4, 0.1F, random);
      PaintLeaves(canvas, {.coverage = 1.2, .opacity = 0.6F}, random);
      PaintFallenCoat(canvas, 1.3F, 0.3F, random);
      break;
    case Pattern::kRubble:
      PaintCells(canvas, 18, 22, 0.95, 0.02F, 4.0F, random);
      PaintLeaves(canvas, {.coverage = 0.6, .radius_max = 0.05, .opacity = 0.5F}, random);
      break;
    case Pattern::kPaving:
      PaintCells(canvas, 20, 20, 0.7, 0.05F, 3.0F, random);
      PaintLeaves(canvas, {.coverage = 0.8, .opacity = 0.5F}, random);
      break;
    case Pattern::kGravel:
      PaintLeaves(canvas, {.coverage = 2.5, .radius_max = 0.04}, random);
      PaintLeaves(canvas, {.coverage = 0.5, .radius_min = 0.03, .radius_max = 0.15, .opacity = 0.45F}, random);
      break;
    case Pattern::kWood:
      PaintCourses(canvas, 9, 0.3, 0.7, 0.0F, random);
      PaintLeaves(canvas, {.coverage = 0.9, .radius_max = 0.08, .opacity = 0.55F}, random);
      break;
    case Pattern::kBark:
      PaintCells(canvas, 26, 9, 0.95, 0.0F, 5.0F, random);
      PaintLeaves(canvas, {.coverage = 0.6, .radius_max = 0.05, .opacity = 0.6F}, random);
      break;
    case Pattern::kFoliage:
      PaintLeaves(canvas, {.coverage = 3.0, .radius_min = 3.0 / 512, .radius_max = 0.07}, random);
      break;
    case Pattern::kSignal:
      PaintLeaves(canvas, {.coverage = 3.0, .radius_min = 4.0 / 512, .radius_max = 0.14}, random);
      for (float& t : canvas.tone)
        t = t < 0.5F ? 0.6F * t * t : 1.0F - 0.6F * (1.0F - t) * (1.0F - t);  // black or white
      break;
    case Pattern::kPad:
      PaintTarget(canvas);
      PaintLeaves(canvas, {.coverage = 0.6, .radius_max = 0.06, .opacity = 0.6F}, random);
      break;
  }
  AddNoise(canvas, pattern == Pattern::kSignal ? 0.06F : 0.12F, random);
}

}  // namespace

std::shared_ptr<const geometry::Texture> MakeTexture(Pattern pattern, const Palette& palette, int size,
                                                     std::uint64_t seed, std::string_view name) {
  if (size < 16 || (size & (size - 1)) != 0) {
    throw base::InputError("texture size " + std::to_string(size) + " must be a power of two of at least 16");
  }
  RandomStream random(seed, "world/texture/" + std::string(name));
  Canvas canvas(size);
  Paint(canvas, pattern, random);
  if (pattern != Pattern::kSignal && pattern != Pattern::kPad) Stretch(canvas);
  Canvas warmth = PinkNoise(size / 4, random);  // colours vary from reddish to bluish, whatever the tone

  auto texture = std::make_shared<geometry::Texture>();
  texture->width = texture->height = size;
  texture->rgb.resize(3 * canvas.tone.size());
  for (int c = 0; c < 3; ++c) {
    const float dark = 255.0F * palette.dark[c];
    const float range = 255.0F * palette.light[c] - dark;
    const float shift = 0.05F * static_cast<float>(1 - c);
    for (int y = 0; y < size; ++y) {
      const float* tones = &canvas.At(0, y);
      const float* warm = &warmth.At(0, y / 4);
      std::uint8_t* out = texture->rgb.data() + 3 * canvas.Index(0, y) + c;
      for (int x = 0; x < size; ++x) {
        const float t = std::clamp(tones[x], 0.0F, 1.0F);
        const float value = (dark + t * range) * (1.0F + shift * warm[x / 4]);
        out[3 * x] = static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
      }
    }
  }
  return texture;
}

}  // namespace alula::worlds

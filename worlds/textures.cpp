#include "worlds/textures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
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

/// Square tiles of slightly different tones with joints between them.
void PaintTiles(Canvas& canvas, int columns, float joint_tone, RandomStream& random) {
  std::vector<float> tones(static_cast<std::size_t>(columns) * static_cast<std::size_t>(columns));
  for (float& t : tones) t = static_cast<float>(random.Uniform(0.45, 0.75));
  const int joint = std::max(1, canvas.size / 340);
  for (int y = 0; y < canvas.size; ++y) {
    for (int x = 0; x < canvas.size; ++x) {
      const int column = x * columns / canvas.size;
      const int row = y * columns / canvas.size;
      const bool in_joint = x - column * canvas.size / columns < joint || y - row * canvas.size / columns < joint;
      canvas.At(x, y) = in_joint ? joint_tone : tones[static_cast<std::size_t>(row * columns + column)];
    }
  }
}

/// Dark lines along the borders of a few large cells.
void PaintCracks(Canvas& canvas, int columns, float tone, RandomStream& random) {
  const Cells cells = MakeCells(canvas.size, columns, columns, 0.95, random);
  const Canvas gaps = PinkNoise(canvas.size, random);
  const float width = std::max(1.5F * static_cast<float>(canvas.size) / 1024.0F, 0.5F);
  for (std::size_t i = 0; i < canvas.tone.size(); ++i) {
    if (cells.edge[i] < width && gaps.tone[i] > -0.2F) canvas.tone[i] = tone;
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

/// Tones of mean 0.5 and this deviation; 0.27 is all the contrast that a picture can hold with little of it clipped.
void Stretch(Canvas& canvas, double deviation) {
  double sum = 0.0;
  double squares = 0.0;
  for (const float t : canvas.tone) {
    sum += t;
    squares += static_cast<double>(t) * t;
  }
  const double count = static_cast<double>(canvas.tone.size());
  const double mean = sum / count;
  const auto gain = static_cast<float>(deviation / std::sqrt(std::max(squares / count - mean * mean, 1e-6)));
  for (float& t : canvas.tone) t = 0.5F + gain * (t - static_cast<float>(mean));
}

/// What a pattern is made of: its shapes, and the noise over them.
struct Recipe {
  void (*paint)(Canvas&, RandomStream&);
  float noise = 0.12F;
  bool stretch = true;  // to the contrast asked for; a pattern of given tones keeps them
};

/// In the order of Pattern.
constexpr Recipe kRecipes[] = {
    {[](Canvas& canvas, RandomStream& random) {  // brick
      PaintCourses(canvas, 22, 0.05, 0.13, 0.95F, random);
      PaintLeaves(canvas, {.coverage = 0.7, .opacity = 0.5F}, random);
    }},
    {[](Canvas& canvas, RandomStream& random) {  // plaster
      PaintLeaves(canvas, {.coverage = 1.6, .radius_max = 0.16, .opacity = 0.6F}, random);
      PaintFallenCoat(canvas, 0.9F, -0.35F, random);
    }},
    {[](Canvas& canvas, RandomStream& random) {  // concrete
      PaintCourses(canvas, 5, 0.15, 0.4, 0.1F, random);
      PaintLeaves(canvas, {.coverage = 1.2, .opacity = 0.6F}, random);
      PaintFallenCoat(canvas, 1.3F, 0.3F, random);
    }},
    {[](Canvas& canvas, RandomStream& random) {  // rubble
      PaintCells(canvas, 18, 22, 0.95, 0.02F, 4.0F, random);
      PaintLeaves(canvas, {.coverage = 0.6, .radius_max = 0.05, .opacity = 0.5F}, random);
    }},
    {[](Canvas& canvas, RandomStream& random) {  // paving
      PaintCells(canvas, 20, 20, 0.7, 0.05F, 3.0F, random);
      PaintLeaves(canvas, {.coverage = 0.8, .opacity = 0.5F}, random);
    }},
    {[](Canvas& canvas, RandomStream& random) {  // gravel
      PaintLeaves(canvas, {.coverage = 2.5, .radius_max = 0.04}, random);
      PaintLeaves(canvas, {.coverage = 0.5, .radius_min = 0.03, .radius_max = 0.15, .opacity = 0.45F}, random);
    }},
    {[](Canvas& canvas, RandomStream& random) {  // wood
      PaintCourses(canvas, 9, 0.3, 0.7, 0.0F, random);
      PaintLeaves(canvas, {.coverage = 0.9, .radius_max = 0.08, .opacity = 0.55F}, random);
    }},
    {[](Canvas& canvas, RandomStream& random) {  // bark
      PaintCells(canvas, 26, 9, 0.95, 0.0F, 5.0F, random);
      PaintLeaves(canvas, {.coverage = 0.6, .radius_max = 0.05, .opacity = 0.6F}, random);
    }},
    {[](Canvas& canvas, RandomStream& random) {  // foliage
      PaintLeaves(canvas, {.coverage = 3.0, .radius_min = 3.0 / 512, .radius_max = 0.07}, random);
    }},
    {[](Canvas& canvas, RandomStream& random) {  // signal: black or white
       PaintLeaves(canvas, {.coverage = 3.0, .radius_min = 4.0 / 512, .radius_max = 0.14}, random);
       for (float& t : canvas.tone) t = t < 0.5F ? 0.6F * t * t : 1.0F - 0.6F * (1.0F - t) * (1.0F - t);
     },
     0.06F, false},
    {[](Canvas& canvas, RandomStream& random) {  // pad
       PaintTarget(canvas);
       PaintLeaves(canvas, {.coverage = 0.6, .radius_max = 0.06, .opacity = 0.6F}, random);
     },
     0.12F, false},
    {[](Canvas& canvas, RandomStream& random) {  // grass: blades over patches of moss and dry stalks
      PaintLeaves(canvas, {.coverage = 0.8, .radius_min = 0.03, .radius_max = 0.2, .opacity = 0.35F}, random);
      PaintLeaves(canvas,
                  {.coverage = 5.0,
                   .radius_min = 4.0 / 512,
                   .radius_max = 0.03,
                   .opacity = 0.7F,
                   .narrowest = 0.06,
                   .widest = 0.18},
                  random);
    }},
    {[](Canvas& canvas, RandomStream& random) {  // asphalt: grit, worn patches, cracks
      PaintLeaves(canvas, {.coverage = 2.0, .radius_min = 1.2 / 1024, .radius_max = 0.006}, random);
      PaintLeaves(canvas, {.coverage = 0.6, .radius_min = 0.05, .radius_max = 0.25, .opacity = 0.2F}, random);
      PaintCracks(canvas, 5, 0.05F, random);
    }},
    {[](Canvas& canvas, RandomStream& random) {  // litter: fallen leaves and twigs
      PaintLeaves(canvas, {.coverage = 3.0, .radius_min = 0.006, .radius_max = 0.03, .narrowest = 0.4, .widest = 0.8},
                  random);
      PaintLeaves(canvas,
                  {.coverage = 0.15,
                   .radius_min = 0.02,
                   .radius_max = 0.08,
                   .tone_max = 0.3F,
                   .narrowest = 0.03,
                   .widest = 0.06},
                  random);
    }},
    {[](Canvas& canvas, RandomStream& random) {  // soil: clods and pebbles
       PaintLeaves(canvas, {.coverage = 1.0, .radius_max = 0.12, .opacity = 0.3F}, random);
       PaintLeaves(canvas, {.coverage = 0.25, .radius_min = 2.0 / 1024, .radius_max = 0.015, .opacity = 0.8F}, random);
     },
     0.2F},
    {[](Canvas& canvas, RandomStream& random) {  // tiles
       PaintTiles(canvas, 8, 0.15F, random);
       PaintLeaves(canvas, {.coverage = 0.5, .radius_max = 0.02, .opacity = 0.15F}, random);
     },
     0.06F},
    {[](Canvas& canvas, RandomStream& random) {  // metal: sheets with seams, scratches and stains
       PaintCourses(canvas, 4, 0.25, 0.5, 0.05F, random);
       PaintLeaves(canvas,
                   {.coverage = 0.5,
                    .radius_min = 0.01,
                    .radius_max = 0.1,
                    .opacity = 0.35F,
                    .narrowest = 0.02,
                    .widest = 0.06},
                   random);
       PaintLeaves(canvas, {.coverage = 0.5, .radius_min = 0.02, .radius_max = 0.2, .opacity = 0.2F}, random);
     },
     0.06F},
    {[](Canvas& canvas, RandomStream& random) {  // carpet: short pile, worn paths
       PaintLeaves(canvas, {.coverage = 2.0, .radius_min = 1.5 / 1024, .radius_max = 0.008, .opacity = 0.8F}, random);
       PaintLeaves(canvas, {.coverage = 0.5, .radius_min = 0.1, .radius_max = 0.3, .opacity = 0.2F}, random);
     },
     0.10F},
    {[](Canvas& canvas, RandomStream& random) {  // paint: a white wall, all but bare
       for (float& t : canvas.tone) t = 0.9F;
       PaintLeaves(canvas, {.coverage = 0.3, .radius_min = 0.05, .radius_max = 0.3, .tone_min = 0.8F, .opacity = 0.06F},
                   random);
     },
     0.012F, false},
};
static_assert(std::size(kRecipes) == static_cast<std::size_t>(Pattern::kPaint) + 1);

Canvas Paint(Pattern pattern, int size, double contrast, RandomStream& random) {
  if (size < 16 || (size & (size - 1)) != 0) {
    throw base::InputError("texture size " + std::to_string(size) + " must be a power of two of at least 16");
  }
  const Recipe& recipe = kRecipes[static_cast<std::size_t>(pattern)];
  Canvas canvas(size);
  recipe.paint(canvas, random);
  AddNoise(canvas, recipe.noise, random);
  if (recipe.stretch) Stretch(canvas, contrast);
  return canvas;
}

/// Tones as colours; these vary from reddish to bluish, whatever the tone, the less the fainter the pattern is.
std::shared_ptr<geometry::Texture> Coloured(const Canvas& canvas, const Palette& palette, double contrast,
                                            RandomStream& random) {
  const auto warm_share = static_cast<float>(0.05 * std::min(1.0, contrast / kFullContrast));
  const int size = canvas.size;
  const Canvas warmth = PinkNoise(size / 4, random);
  auto texture = std::make_shared<geometry::Texture>();
  texture->width = texture->height = size;
  texture->rgb.resize(3 * canvas.tone.size());
  for (int c = 0; c < 3; ++c) {
    const float dark = 255.0F * palette.dark[c];
    const float range = 255.0F * palette.light[c] - dark;
    const float shift = warm_share * static_cast<float>(1 - c);
    for (int y = 0; y < size; ++y) {
      const float* tones = canvas.tone.data() + canvas.Index(0, y);
      const float* warm = warmth.tone.data() + warmth.Index(0, y / 4);
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

/// Takes over `inner` away from the lines u = ½ and v = ½, along which the canvas stays as it is; the border between
/// them wanders, so that it is no line itself.
void FillBetweenRims(Canvas& canvas, const Canvas& inner, RandomStream& random) {
  constexpr float kRim = 0.07F;     // mean distance of the border from the lines, of the canvas's side
  constexpr float kWander = 0.02F;  // its deviation
  const Canvas wander = PinkNoise(canvas.size, random);
  const float scale = 1.0F / static_cast<float>(canvas.size);
  for (int y = 0; y < canvas.size; ++y) {
    for (int x = 0; x < canvas.size; ++x) {
      const float off_u = std::abs(static_cast<float>(x) * scale - 0.5F);
      const float off_v = std::abs(static_cast<float>(y) * scale - 0.5F);
      const float border = kRim + kWander * std::clamp(wander.At(x, y), -2.5F, 2.5F);
      if (std::min(off_u, off_v) > border) canvas.At(x, y) = inner.At(x, y);
    }
  }
}

}  // namespace

std::shared_ptr<const geometry::Texture> MakeTexture(Pattern pattern, const Palette& palette, int size,
                                                     std::uint64_t seed, std::string_view name, double contrast) {
  RandomStream random(seed, "world/texture/" + std::string(name));
  const Canvas canvas = Paint(pattern, size, contrast, random);
  return Coloured(canvas, palette, contrast, random);
}

std::vector<std::shared_ptr<const geometry::Texture>> MakeTextureVariants(Pattern pattern, const Palette& palette,
                                                                          int size, std::uint64_t seed,
                                                                          std::string_view name, int count,
                                                                          double contrast) {
  RandomStream rim_stream(seed, "world/texture/" + std::string(name));
  const Canvas rim = Paint(pattern, size, contrast, rim_stream);
  std::vector<std::shared_ptr<const geometry::Texture>> variants;
  for (int i = 0; i < count; ++i) {
    RandomStream random(seed, "world/texture/" + std::string(name) + "/" + std::to_string(i));
    Canvas canvas = rim;
    FillBetweenRims(canvas, Paint(pattern, size, contrast, random), random);
    RandomStream tint(seed, "world/texture/" + std::string(name) + "/tint");  // one for all: it crosses the rims
    variants.push_back(Coloured(canvas, palette, contrast, tint));
  }
  return variants;
}

void DescribeTextureSize(base::Description& d, int& size) {
  d.Field("texture_size", size, {.meaning = "texels a side of large surfaces, a power of two", .min = 32, .max = 4096});
  d.Check("texture_size", [&size] {
    return std::has_single_bit(static_cast<unsigned>(size)) ? std::string() : std::string("must be a power of two");
  });
}

}  // namespace alula::worlds

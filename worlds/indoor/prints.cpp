#include "worlds/indoor/prints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/random.h"
#include "worlds/texture_canvas.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Vec2;
using base::Vec3;
using Colour = Eigen::Vector3f;

constexpr double kPi = std::numbers::pi;

/// A picture in the unit square; colours from 0 to 1.
class Picture {
 public:
  Picture(int size, const Colour& ground) : Picture(size, size, ground) {}
  Picture(int width, int height, const Colour& ground)
      : width_(width),
        height_(height),
        texel_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), ground) {}

  /// Paints where `inside(u, v)` holds.
  template <typename Inside>
  void Paint(const Vec2& low, const Vec2& high, const Colour& colour, const Inside& inside) {
    const auto texel = [](double x, int count) {
      return std::clamp(static_cast<int>(std::floor(x * count)), 0, count - 1);
    };
    for (int y = texel(low.y(), height_); y <= texel(high.y(), height_); ++y) {
      for (int x = texel(low.x(), width_); x <= texel(high.x(), width_); ++x) {
        if (inside(Vec2((x + 0.5) / width_, (y + 0.5) / height_))) At(x, y) = colour;
      }
    }
  }
  void Box(const Vec2& middle, const Vec2& half, double angle, const Colour& colour) {
    const Vec2 reach = Vec2::Constant(half.norm());
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    Paint(middle - reach, middle + reach, colour, [&](const Vec2& p) {
      const Vec2 d = p - middle;
      return std::abs(c * d.x() + s * d.y()) <= half.x() && std::abs(c * d.y() - s * d.x()) <= half.y();
    });
  }
  void Disc(const Vec2& middle, double radius, const Colour& colour) {
    const Vec2 reach = Vec2::Constant(radius);
    Paint(middle - reach, middle + reach, colour, [&](const Vec2& p) { return (p - middle).norm() <= radius; });
  }
  /// A ring about `middle`.
  void Ring(const Vec2& middle, double radius, double half_width, const Colour& colour) {
    const Vec2 reach = Vec2::Constant(radius + half_width);
    Paint(middle - reach, middle + reach, colour,
          [&](const Vec2& p) { return std::abs((p - middle).norm() - radius) <= half_width; });
  }

  Colour& At(int x, int y) {
    return texel_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }
  int size() const { return width_; }

  int AddTo(World& world, std::string_view name) const {
    auto texture = std::make_shared<geometry::Texture>();
    texture->width = width_;
    texture->height = height_;
    texture->rgb.reserve(3 * texel_.size());
    for (const Colour& colour : texel_) {
      for (int c = 0; c < 3; ++c) {
        texture->rgb.push_back(static_cast<std::uint8_t>(std::clamp(255.0F * colour[c] + 0.5F, 0.0F, 255.0F)));
      }
    }
    world.materials.push_back({std::string(name), Colour::Ones(), std::move(texture)});
    return static_cast<int>(world.materials.size()) - 1;
  }

 private:
  int width_;
  int height_;
  std::vector<Colour> texel_;
};

RandomStream StreamOf(std::string_view name, std::uint64_t seed) { return {seed, "world/print/" + std::string(name)}; }

Colour Grey(double value) { return Colour::Constant(static_cast<float>(value)); }

/// Cloth is never of one tone: a little noise over all.
void AddGrain(Picture& picture, float amplitude, RandomStream& random) {
  const Canvas noise = PinkNoise(picture.size(), random);
  for (int y = 0; y < picture.size(); ++y) {
    for (int x = 0; x < picture.size(); ++x) picture.At(x, y) *= 1.0F + amplitude * noise.At(x, y);
  }
}

struct RugColours {
  Colour lawn{0.58F, 0.72F, 0.46F}, wood{0.36F, 0.52F, 0.30F}, street{0.62F, 0.62F, 0.64F}, line{0.97F, 0.97F, 0.93F},
      pond{0.52F, 0.70F, 0.86F}, sand{0.95F, 0.90F, 0.74F}, roof{0.74F, 0.32F, 0.24F}, dark{0.16F, 0.17F, 0.20F};
};

/// What stands on one block between streets.
void PaintBlock(Picture& picture, const RugColours& c, const Vec2& p, double half, RandomStream& random) {
  const std::array grounds{c.lawn, c.sand, c.wood, Colour(0.82F, 0.85F, 0.70F)};
  picture.Box(p, Vec2(half * random.Uniform(0.8, 1.0), half * random.Uniform(0.8, 1.0)), 0.0, grounds[random.Index(4)]);
  const std::uint64_t kind = random.Index(4);
  if (kind == 0) {  // a pond
    for (int i = 0; i < 4; ++i) {
      picture.Disc(p + 0.35 * half * Vec2(random.Uniform(-1, 1), random.Uniform(-1, 1)),
                   half * random.Uniform(0.3, 0.5), c.pond);
    }
    picture.Disc(p + 0.2 * half * Vec2(random.Uniform(-1, 1), random.Uniform(-1, 1)), 0.12 * half, c.line);
  }
  for (int i = 0; kind == 1 && i < 5; ++i) {  // houses
    const Vec2 at = p + 0.6 * half * Vec2(random.Uniform(-1, 1), random.Uniform(-1, 1));
    const Vec2 size(half * random.Uniform(0.14, 0.3), half * random.Uniform(0.12, 0.24));
    picture.Box(at, size, 0.0, random.Index(2) == 0 ? c.roof : c.line);
    picture.Box(at, {size.x(), 0.08 * half}, 0.0, c.dark);
    picture.Box(at + Vec2(0.5 * size.x(), -0.6 * size.y()), {0.05 * half, 0.05 * half}, 0.0, c.sand);
  }
  for (int i = 0; kind == 2 && i < 14; ++i) {  // trees
    const Vec2 at = p + 0.75 * half * Vec2(random.Uniform(-1, 1), random.Uniform(-1, 1));
    const double radius = half * random.Uniform(0.07, 0.16);
    picture.Disc(at, radius, c.wood * 0.7F);
    picture.Disc(at + Vec2(-0.25, 0.25) * radius, 0.55 * radius, c.lawn);
  }
  for (int i = 0; kind == 3 && i < 6; ++i) {  // a car park
    const Vec2 at = p + Vec2(half * (0.24 * i - 0.6), 0.0);
    picture.Box(at, {0.015 * half, 0.5 * half}, 0.0, c.line);
    if (random.Index(3) != 0) {
      picture.Box(at + Vec2(0.12 * half, half * random.Uniform(-0.3, 0.3)), {0.07 * half, 0.15 * half}, 0.0,
                  random.Index(2) == 0 ? c.dark : c.roof);
    }
  }
}

/// A tag: black with 6 × 6 cells of code within.
void PaintTag(Picture& picture, const Vec2& p, double half, RandomStream& random) {
  picture.Box(p, Vec2::Constant(half), 0.0, Grey(0.05));
  const double cell = half / 4.0;
  for (int i = 0; i < 36; ++i) {
    if (random.Index(2) == 0) continue;
    picture.Box(p + cell * Vec2(i % 6 - 2.5, i / 6 - 2.5), Vec2::Constant(0.5 * cell), 0.0, Grey(0.96));
  }
}

}  // namespace

int AddPlayRug(World& world, std::string_view name, int size, std::uint64_t seed) {
  RandomStream random = StreamOf(name, seed);
  const RugColours c;
  Picture picture(size, c.sand);
  picture.Box({0.5, 0.5}, {0.465, 0.465}, 0.0, c.lawn);
  const int columns = 3 + static_cast<int>(random.Index(2));
  const double pitch = 0.93 / columns;
  const double street = 0.16 * pitch;  // half its width
  const auto line = [&](int i) { return 0.035 + pitch * i; };
  for (int j = 0; j < columns; ++j) {
    for (int i = 0; i < columns; ++i) {
      PaintBlock(picture, c, {line(i) + 0.5 * pitch, line(j) + 0.5 * pitch}, 0.5 * pitch - street, random);
    }
  }
  for (int i = 0; i <= columns; ++i) {
    for (int j = 0; j < columns; ++j) {
      const double middle = line(j) + 0.5 * pitch;
      const bool rim = i == 0 || i == columns;
      for (const bool across : {false, true}) {
        if (!rim && random.Index(4) == 0) continue;  // a street that ends
        const Vec2 p = across ? Vec2(middle, line(i)) : Vec2(line(i), middle);
        picture.Box(p, across ? Vec2(0.5 * pitch + street, street) : Vec2(street, 0.5 * pitch + street), 0.0, c.street);
        for (int dash = -2; dash <= 2; ++dash) {
          const Vec2 off = 0.19 * pitch * dash * (across ? Vec2::UnitX() : Vec2::UnitY());
          picture.Box(p + off, across ? Vec2(0.045 * pitch, 0.018 * pitch) : Vec2(0.018 * pitch, 0.045 * pitch), 0.0,
                      c.line);
        }
      }
    }
  }
  const Vec2 roundabout(line(1 + static_cast<int>(random.Index(static_cast<std::uint64_t>(columns - 1)))), line(1));
  picture.Disc(roundabout, 0.42 * pitch, c.street);
  picture.Ring(roundabout, 0.31 * pitch, 0.012 * pitch, c.line);
  picture.Disc(roundabout, 0.2 * pitch, c.wood);
  picture.Disc(roundabout, 0.09 * pitch, c.line);
  AddGrain(picture, 0.03F, random);
  return picture.AddTo(world, name);
}

int AddSpeckTape(World& world, std::string_view name, int size, double aspect, std::uint64_t seed) {
  RandomStream random = StreamOf(name, seed);
  Picture picture(size, std::max(4, size / 16), Grey(0.06));
  const int columns = static_cast<int>(std::lround(2.1 * aspect));
  for (int i = 0; i < columns; ++i) {
    for (int row = 0; row < 2; ++row) {
      if (random.Index(7) == 0) continue;
      // In lengths of the tape's width: x along it, y across.
      const Vec2 p((i + 0.5 + random.Uniform(-0.25, 0.25)) * aspect / columns,
                   0.28 + 0.44 * row + random.Uniform(-0.1, 0.1));
      const Vec2 half(random.Uniform(0.06, 0.17), random.Uniform(0.04, 0.09));
      const double angle = random.Uniform(-kPi, kPi);
      const double cos = std::cos(angle);
      const double sin = std::sin(angle);
      const double taper = random.Uniform(-0.5, 0.5);
      picture.Paint({(p.x() - 0.2) / aspect, p.y() - 0.2}, {(p.x() + 0.2) / aspect, p.y() + 0.2}, Grey(0.93),
                    [&](const Vec2& at) {
                      const Vec2 d(at.x() * aspect - p.x(), at.y() - p.y());
                      const double x = cos * d.x() + sin * d.y();
                      const double y = cos * d.y() - sin * d.x();
                      return std::abs(x) <= half.x() && std::abs(y) <= half.y() * (1.0 + taper * x / half.x());
                    });
    }
  }
  return picture.AddTo(world, name);
}

int AddTagGrid(World& world, std::string_view name, int size, std::uint64_t seed) {
  constexpr int kTags = 6;
  constexpr double kGap = 0.3;  // between tags, of their side
  constexpr double kRim = 0.06;
  RandomStream random = StreamOf(name, seed);
  Picture picture(size, Grey(0.95));
  const double side = (1.0 - 2.0 * kRim) / (kTags + kGap * (kTags + 1));
  for (int j = 0; j <= kTags; ++j) {
    for (int i = 0; i <= kTags; ++i) {
      const Vec2 corner = Vec2::Constant(kRim) + (1.0 + kGap) * side * Vec2(i, j);
      picture.Box(corner + Vec2::Constant(0.5 * kGap * side), Vec2::Constant(0.5 * kGap * side), 0.0, Grey(0.05));
      if (i < kTags && j < kTags) PaintTag(picture, corner + Vec2::Constant((kGap + 0.5) * side), 0.5 * side, random);
    }
  }
  return picture.AddTo(world, name);
}

int AddCheckerboard(World& world, std::string_view name, int size, int columns, int rows) {
  constexpr double kRim = 0.05;
  Picture picture(size, Grey(0.95));
  const Vec2 cell((1.0 - 2.0 * kRim) / columns, (1.0 - 2.0 * kRim) / rows);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      if ((i + j) % 2 != 0) continue;
      picture.Box(Vec2::Constant(kRim) + Vec2((i + 0.5) * cell.x(), (j + 0.5) * cell.y()), 0.5 * cell, 0.0, Grey(0.05));
    }
  }
  return picture.AddTo(world, name);
}

int AddQuilt(World& world, std::string_view name, int size, std::uint64_t seed) {
  RandomStream random = StreamOf(name, seed);
  Picture picture(size, {0.50F, 0.54F, 0.56F});
  constexpr int kFolds = 26;
  for (int fold = 0; fold < kFolds; ++fold) {
    const Vec2 p(random.Uniform(), random.Uniform());
    const double length = random.Uniform(0.12, 0.5);
    const double width = random.Uniform(0.008, 0.022);
    const double slope = random.Uniform(-0.35, 0.35);
    const double bow = random.Uniform(-0.5, 0.5);
    const float depth = static_cast<float>(random.Uniform(0.06, 0.2));
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {  // wraps along both sides
        const double along = std::remainder((x + 0.5) / size - p.x(), 1.0);
        if (std::abs(along) > 0.5 * length) continue;
        const double off = std::remainder((y + 0.5) / size - p.y() - slope * along - bow * along * along, 1.0) / width;
        if (std::abs(off) > 3.0) continue;
        const double end = std::cos(kPi * along / length);  // shallow at its ends
        picture.At(x, y) *= 1.0F + depth * static_cast<float>(end * off * std::exp(0.5 - 0.5 * off * off));
      }
    }
  }
  AddGrain(picture, 0.035F, random);
  return picture.AddTo(world, name);
}

std::size_t AddPrintedBox(World& world, const std::string& name, const Vec3& size, const base::Transform& X_WO,
                          int axis, int material, SemanticClass semantic) {
  auto mesh = std::make_shared<geometry::Mesh>();
  const Vec3 half = 0.5 * size;
  for (int a = 0; a < 3; ++a) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 n = Vec3::Zero();
      n[a] = side;
      const Vec3 up = a == 2 ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitZ());
      const Vec3 right = up.cross(n);
      const bool shows = a == axis && side == (axis == 2 ? 1.0 : -1.0);
      const auto first = static_cast<std::uint32_t>(mesh->vertices.size());
      constexpr std::array<std::array<float, 2>, 4> kCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
      for (const auto& [x, y] : kCorners) {
        const Vec3 p = (n + x * right + y * up).cwiseProduct(half);
        constexpr float kInset = 0.004F;  // so that no filter reaches the other rim
        const float u = shows ? 0.5F + (0.5F - kInset) * x : 0.01F;
        const float v = shows ? 0.5F + (0.5F - kInset) * y : 0.01F;
        mesh->vertices.push_back({p.cast<float>(), n.cast<float>(), Eigen::Vector2f(u, v)});
      }
      mesh->triangles.push_back({first, first + 1, first + 2});
      mesh->triangles.push_back({first, first + 2, first + 3});
    }
  }
  world.objects.push_back({name, geometry::MeshShape{mesh}, X_WO, material, 1.0, true, semantic});
  return world.objects.size() - 1;
}

}  // namespace alula::worlds

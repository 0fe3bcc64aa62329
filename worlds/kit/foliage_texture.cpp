#include "worlds/kit/foliage_texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/random.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Vec2;

constexpr double kPi = std::numbers::pi;

Vec2 Direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// Paints shapes one over another onto the texture; what nothing covers is a hole.
class Painter {
 public:
  Painter(geometry::Texture& texture, const Palette& ground) : out_(texture) {
    const auto texels = static_cast<std::size_t>(out_.width) * static_cast<std::size_t>(out_.height);
    out_.alpha.assign(texels, 0);
    for (std::size_t i = 0; i < texels; ++i) {  // coarse levels mix the holes' colour in: let it be the leaves'
      const Eigen::Vector3f rgb = 255.0F * (0.6F * ground.dark + 0.4F * ground.light);
      for (int c = 0; c < 3; ++c) out_.rgb.push_back(static_cast<std::uint8_t>(rgb[c]));
    }
  }

  /// A pointed leaf of two arcs; its sides differ a little, as they face the light differently.
  void Leaf(const Vec2& middle, const Vec2& along, double half_length, double half_width, const Palette& palette,
            double tone) {
    Cover(
        middle, half_length,
        [&](const Vec2& d) {
          const double s = d.dot(along) / half_length;
          const double side = (d.y() * along.x() - d.x() * along.y()) / half_width;
          const double inside = ((1.0 - s * s) - std::abs(side)) * half_width;
          return Texel{inside, std::abs(side) < 0.08 ? 1.15 * tone : side > 0.0 ? tone : 0.82 * tone};
        },
        palette);
  }

  /// A stroke from a to b, `width` wide at a and a third of it at b.
  void Stroke(const Vec2& a, const Vec2& b, double width, const Palette& palette, double tone) {
    const Vec2 along = b - a;
    const double length = along.norm();
    Cover(
        0.5 * (a + b), 0.5 * length + width,
        [&](const Vec2& d) {
          const Vec2 p = d + 0.5 * along;
          const double s = std::clamp(p.dot(along) / (length * length), 0.0, 1.0);
          const double off = (p - s * along).norm();
          const double half = 0.5 * width * (1.0 - 0.67 * s);
          return Texel{half - off, tone * (1.0 + 0.25 * (p.x() * along.y() - p.y() * along.x()) / (length * width))};
        },
        palette);
  }

  void Disc(const Vec2& middle, double radius, const Palette& palette, double tone) {
    Cover(
        middle, radius,
        [&](const Vec2& d) {
          return Texel{radius - d.norm(), tone};
        },
        palette);
  }

 private:
  struct Texel {
    double inside;  // distance inside of the border, of the square's side
    double tone;    // between the palette's dark (0) and light (1)
  };

  template <typename Shape>
  void Cover(const Vec2& middle, double reach, const Shape& shape, const Palette& palette) {
    const auto bound = [this](double at, double extra) {
      return std::clamp(static_cast<int>(std::floor((at + extra) * out_.width)), 0, out_.width - 1);
    };
    for (int y = bound(middle.y(), -reach); y <= bound(middle.y(), reach); ++y) {
      for (int x = bound(middle.x(), -reach); x <= bound(middle.x(), reach); ++x) {
        const Vec2 p((x + 0.5) / out_.width, (y + 0.5) / out_.height);
        const Texel texel = shape(Vec2(p - middle));
        const double alpha = std::clamp(0.5 + texel.inside * out_.width, 0.0, 1.0);
        if (alpha <= 0.0) continue;
        const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(out_.width) + static_cast<std::size_t>(x);
        out_.alpha[i] = std::max(out_.alpha[i], static_cast<std::uint8_t>(255.0 * alpha + 0.5));
        if (texel.inside < 0.0) continue;
        const auto t = static_cast<float>(std::clamp(texel.tone, 0.0, 1.2));
        for (int c = 0; c < 3; ++c) {
          const float value = 255.0F * (palette.dark[c] + t * (palette.light[c] - palette.dark[c]));
          out_.rgb[3 * i + static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F));
        }
      }
    }
  }

  geometry::Texture& out_;
};

void PaintSpray(Painter& painter, const FoliageConfig& c, RandomStream& random) {
  constexpr double kReach = 0.45;
  for (int i = 0; i < 7; ++i) {
    const Vec2 tip =
        Vec2(0.5, 0.5) + kReach * random.Uniform(0.6, 0.9) * Direction(2.0 * kPi * (i + random.Uniform()) / 7.0);
    painter.Stroke({0.5, 0.5}, tip, 0.018, c.wood, random.Uniform(0.2, 0.6));
  }
  constexpr int kLeaves = 480;
  for (int i = 0; i < kLeaves; ++i) {
    const double depth = static_cast<double>(i) / kLeaves;  // what is painted later lies in front, in the light
    const double around = 2.0 * kPi * random.Uniform();
    const double edge = kReach * (0.78 + 0.12 * std::sin(3.0 * around) + 0.10 * std::sin(5.0 * around + 1.0));
    const double half = random.Uniform(0.020, 0.034);
    const Vec2 middle =
        Vec2(0.5, 0.5) + std::max(0.0, edge - half) * std::sqrt(random.Uniform(0.02, 1.0)) * Direction(around);
    painter.Leaf(middle, Direction(around + random.Uniform(-1.3, 1.3)), half, half * random.Uniform(0.38, 0.55),
                 c.leaves, std::clamp(0.15 + 0.55 * depth + 0.18 * random.Gaussian(), 0.0, 1.1));
  }
}

void PaintNeedles(Painter& painter, const FoliageConfig& c, RandomStream& random) {
  for (int i = 0; i < 44; ++i) {
    const double at = (i + random.Uniform()) / 44.0;
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const Vec2 root(0.02 + 0.93 * at, 0.5);
    const double length = 0.44 * std::pow(std::sin(kPi * (0.16 + 0.80 * at)), 0.8) * random.Uniform(0.75, 1.05);
    const Vec2 along = Direction(side * random.Uniform(0.65, 0.95));
    const double tone = random.Uniform(0.2, 0.9);
    painter.Stroke(root, root + length * along, 0.012, c.wood, 0.3);
    const int needles = 5 + static_cast<int>(36.0 * length);
    for (int k = 0; k < needles; ++k) {
      const Vec2 foot = root + length * ((k + 0.5) / needles) * along;
      for (const double turn : {-0.6, 0.6}) {
        const Vec2 d(std::cos(turn) * along.x() - std::sin(turn) * along.y(),
                     std::sin(turn) * along.x() + std::cos(turn) * along.y());
        const double reach = std::min({random.Uniform(0.03, 0.05), foot.y() - 0.01, 0.99 - foot.y(), 0.99 - foot.x()});
        if (reach < 0.01) continue;
        painter.Stroke(foot, foot + reach * d, 0.011, c.leaves, tone + 0.15 * random.Gaussian());
      }
    }
  }
  painter.Stroke({0.0, 0.5}, {0.95, 0.5}, 0.02, c.wood, 0.4);
}

void PaintTuft(Painter& painter, const FoliageConfig& c, RandomStream& random) {
  for (int i = 0; i < 90; ++i) {
    const double depth = i / 90.0;
    const double lean = 0.35 * random.Gaussian();
    const double height = random.Uniform(0.35, 0.95) * (1.0 - 0.5 * std::min(std::abs(lean), 1.0));
    const double x = std::clamp(0.5 + 0.2 * random.Gaussian(), 0.12, 0.88);
    const Vec2 knee(x + 0.35 * lean * height, 0.6 * height);
    const Vec2 tip(std::clamp(x + lean * height, 0.02, 0.98), height);
    const double tone = std::clamp(0.1 + 0.6 * depth + 0.2 * random.Gaussian(), 0.0, 1.1);
    painter.Stroke({x, 0.0}, knee, 0.022, c.leaves, 0.8 * tone);
    painter.Stroke(knee, tip, 0.015, c.leaves, tone);
  }
}

void PaintFlowers(Painter& painter, const FoliageConfig& c, RandomStream& random) {
  for (int i = 0; i < 26; ++i) {
    const double x = random.Uniform(0.08, 0.92);
    const double height = random.Uniform(0.5, 0.88);
    const Vec2 top(std::clamp(x + 0.06 * random.Gaussian(), 0.08, 0.92), height);
    painter.Stroke({x, 0.0}, top, 0.014, c.leaves, 0.4);
    for (int k = 0; k < 6; ++k) {
      const Vec2 at = Vec2(x, 0.0) + random.Uniform(0.05, 0.8) * (top - Vec2(x, 0.0));
      const double turn = random.Uniform(0.1, kPi - 0.1);
      painter.Leaf(at + 0.05 * Direction(turn), Direction(turn), 0.055, 0.022, c.leaves, random.Uniform(0.2, 1.0));
    }
    const double tone = random.Uniform(0.3, 1.0);
    for (int k = 0; k < 6; ++k) {
      const double turn = 2.0 * kPi * k / 6.0 + random.Uniform(-0.2, 0.2);
      painter.Leaf(top + 0.028 * Direction(turn), Direction(turn), 0.03, 0.018, c.blossom,
                   tone + 0.1 * random.Gaussian());
    }
    painter.Disc(top, 0.012, {{0.5F, 0.38F, 0.05F}, {0.9F, 0.75F, 0.2F}}, 0.6);
  }
}

void PaintTree(Painter& painter, const FoliageConfig& c, RandomStream& random) {
  painter.Stroke({0.5, 0.0}, {0.5, 0.5}, 0.06, c.wood, 0.35);
  for (int i = 0; i < 6; ++i) {
    painter.Stroke({0.5, random.Uniform(0.2, 0.4)}, {random.Uniform(0.25, 0.75), random.Uniform(0.5, 0.8)}, 0.025,
                   c.wood, 0.3);
  }
  for (int i = 0; i < 900; ++i) {
    const double depth = i / 900.0;
    const double around = 2.0 * kPi * random.Uniform();
    const double edge = 0.84 + 0.10 * std::sin(4.0 * around + 0.7) + 0.06 * std::sin(9.0 * around);
    const double r = edge * std::sqrt(random.Uniform());
    const Vec2 at(0.5 + 0.44 * r * std::cos(around), 0.60 + 0.37 * r * std::sin(around));
    const double light = 0.45 + 0.45 * (at.y() - 0.6) / 0.37;  // the sky lights the top
    painter.Leaf(at, Direction(random.Uniform(0.0, kPi)), random.Uniform(0.012, 0.028), random.Uniform(0.008, 0.018),
                 c.leaves, std::clamp(light * (0.35 + 0.75 * depth) + 0.16 * random.Gaussian(), 0.0, 1.1));
  }
}

void PaintFir(Painter& painter, const FoliageConfig& c, RandomStream& random) {
  painter.Stroke({0.5, 0.0}, {0.5, 0.97}, 0.04, c.wood, 0.3);
  constexpr int kRows = 26;
  for (int row = 0; row < kRows; ++row) {
    const double up = 0.10 + 0.86 * row / kRows;
    const double reach = 0.36 * (1.0 - (up - 0.08) / 0.92) + 0.02;
    for (int i = 0; i < 26; ++i) {
      const double x = reach * random.Uniform(-1.0, 1.0) * random.Uniform(0.7, 1.1);
      const Vec2 root(0.5 + 0.4 * x, up + 0.02);
      const Vec2 tip(std::clamp(0.5 + x, 0.02, 0.98), up - 0.35 * std::abs(x) * random.Uniform(0.3, 1.0));
      painter.Stroke(
          root, tip, 0.016, c.leaves,
          std::clamp(0.2 + 0.3 * up + 0.6 * std::abs(x) / (reach + 0.01) * 0.5 + 0.18 * random.Gaussian(), 0.0, 1.1));
    }
  }
}

}  // namespace

std::shared_ptr<const geometry::Texture> MakeFoliageTexture(const FoliageConfig& config, std::uint64_t seed,
                                                            std::string_view name) {
  auto texture = std::make_shared<geometry::Texture>();
  texture->width = texture->height = config.size;
  RandomStream random(seed, "world/foliage/" + std::string(name));
  Painter painter(*texture, config.leaves);
  switch (config.kind) {
    case Foliage::kSpray:
      PaintSpray(painter, config, random);
      break;
    case Foliage::kNeedles:
      PaintNeedles(painter, config, random);
      break;
    case Foliage::kTuft:
      PaintTuft(painter, config, random);
      break;
    case Foliage::kFlowers:
      PaintFlowers(painter, config, random);
      break;
    case Foliage::kTree:
      PaintTree(painter, config, random);
      break;
    case Foliage::kFir:
      PaintFir(painter, config, random);
      break;
  }
  return texture;
}

}  // namespace alula::worlds

#include "scenarios/check/check_worlds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace alula::scenarios::check {
namespace {

/// Light that is the same from everywhere: the renderers show an upright face at its texture's values under it
/// (ambient · 0.6 · 0.75 = 1 with the sun put out).
worlds::Light EvenLight() { return {.to_sun_W = base::Vec3::UnitZ(), .sun = 0.0F, .ambient = 1.0F / 0.45F}; }

std::shared_ptr<const geometry::Texture> Paint(int width, int height, const std::function<double(int, int)>& value) {
  auto texture = std::make_shared<geometry::Texture>();
  texture->width = width;
  texture->height = height;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const auto byte = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value(u, v), 0.0, 1.0)));
      texture->rgb.insert(texture->rgb.end(), 3, byte);
    }
  }
  return texture;
}

/// A rectangle of the chart's plane that shows the texture between two points of its coordinates.
worlds::Object Sheet(const base::Vec2& low, const base::Vec2& high, const base::Vec2& uv_low, const base::Vec2& uv_high,
                     int material) {
  auto mesh = std::make_shared<geometry::Mesh>();
  const Eigen::Vector3f towards(0.0F, 0.0F, -1.0F);
  const auto add = [&](double x, double y, double u, double v) {
    mesh->vertices.push_back({base::Vec3(x, y, 0.0).cast<float>(), towards, base::Vec2(u, v).cast<float>()});
  };
  add(low.x(), low.y(), uv_low.x(), uv_low.y());
  add(high.x(), low.y(), uv_high.x(), uv_low.y());
  add(high.x(), high.y(), uv_high.x(), uv_high.y());
  add(low.x(), high.y(), uv_low.x(), uv_high.y());
  mesh->triangles = {{0, 2, 1}, {0, 3, 2}};  // counter-clockwise as seen against z
  worlds::Object object;
  object.name = "chart";
  object.shape = geometry::MeshShape{std::move(mesh)};
  object.X_WO = ChartPose();
  object.material = material;
  return object;
}

worlds::World Studio(std::vector<std::shared_ptr<const geometry::Texture>> textures,
                     std::vector<worlds::Object> sheets) {
  worlds::World world;
  world.name = "check";
  for (auto& texture : textures) {
    world.materials.push_back({.name = "chart", .colour = Eigen::Vector3f::Ones(), .texture = std::move(texture)});
  }
  world.objects = std::move(sheets);
  world.light = EvenLight();
  return world;
}

/// One sheet of 2 · half × 2 · half metres whose texture repeats every `period` metres along x, with x = 0 at its
/// start.
worlds::World Wall(std::shared_ptr<const geometry::Texture> texture, double half, double period) {
  return Studio({std::move(texture)},
                {Sheet({-half, -half}, {half, half}, {-half / period, 0.0}, {half / period, 1.0}, 0)});
}

/// Along one direction of the board: +1 and −1 by turns from square to square, with soft edges. `at`: in squares.
double SoftWave(double at) {
  constexpr double kSoft = 0.15;  // squares from an edge to full contrast: some pixels, or corners would jump between
                                  // the points that a renderer samples
  const double cell = std::floor(at), along = at - cell;
  const double edge = std::min(1.0, std::min(along, 1.0 - along) / kSoft);
  return (static_cast<int>(cell) % 2 == 0 ? 1.0 : -1.0) * std::sin(0.5 * std::numbers::pi * edge);
}

}  // namespace

base::Transform ChartPose() { return {base::ForwardCameraRotation(), base::Vec3::Zero()}; }

worlds::World BoardWorld() {
  constexpr int kTexels = 64, kCells = 16;  // texels a square, squares along the canvas
  const auto value = [](int u, int v) {
    const double column = (u + 0.5) / kTexels, row = (v + 0.5) / kTexels;
    const bool inside = column > 1.0 && column < 13.0 && row > 1.0 && row < 10.0;
    return inside ? 0.475 - 0.375 * SoftWave(column) * SoftWave(row) : 0.85;
  };
  const base::Vec2 half(Board::kHalfWidth, Board::kHalfHeight);
  return Studio({Paint(kTexels * kCells, kTexels * kCells, value)},
                {Sheet(-half, half, {0.0, 0.0}, {14.0 / kCells, 11.0 / kCells}, 0)});
}

worlds::World GreyWall(double period) {
  constexpr int kTexels = 1024;
  const auto value = [](int u, int) { return 1.0 - std::abs((u + 0.5) / (kTexels / 2) - 1.0); };
  return Wall(Paint(kTexels, 1, value), 20.0 * period, period);
}

worlds::World StripedWall(double width) {
  constexpr int kTexels = 512;
  const auto value = [](int u, int) { return u < kTexels / 2 ? 0.85 : 0.1; };
  return Wall(Paint(kTexels, 1, value), 10.0 * width, 2.0 * width);
}

worlds::World SheetBeforeWall(double width, double gap, double grey) {
  constexpr double kHalf = 100.0;
  worlds::World world = TwoGreys(grey / 3.0, grey / 3.0);
  for (worlds::Object& sheet : world.objects) sheet.X_WO.p += ChartPose().q * base::Vec3(0.0, 0.0, gap);
  world.materials.push_back(
      {.name = "sheet", .colour = Eigen::Vector3f::Constant(static_cast<float>(grey)), .texture = nullptr});
  world.objects.push_back(Sheet({-0.5 * width, -kHalf}, {0.5 * width, kHalf}, {0, 0}, {1, 1}, 2));
  return world;
}

worlds::World TwoGreys(double left, double right) {
  const auto plain = [](double grey) { return Paint(1, 1, [grey](int, int) { return grey; }); };
  constexpr double kHalf = 100.0;
  return Studio({plain(left), plain(right)}, {Sheet({-kHalf, -kHalf}, {0, kHalf}, {0, 0}, {1, 1}, 0),
                                              Sheet({0, -kHalf}, {kHalf, kHalf}, {0, 0}, {1, 1}, 1)});
}

}  // namespace alula::scenarios::check

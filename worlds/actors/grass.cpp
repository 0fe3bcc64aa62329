#include "worlds/actors/grass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "worlds/kit/terrain.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Vec2;
using base::Vec3;

struct Blade {
  double foot = 0.5, tip = 0.5;  // of the picture's width
  double height = 0.8;           // of its height
  double width = 0.05;
  double tone = 1.0;
};

/// Blades from the lower rim, bent sideways as parabolas, narrow towards their tips.
std::shared_ptr<const geometry::Texture> MakeBlades(int size, const Eigen::Vector3f& green, RandomStream& random) {
  constexpr int kBlades = 13;
  std::vector<Blade> blades;
  for (int i = 0; i < kBlades; ++i) {
    const double foot = random.Uniform(0.25, 0.75);
    const double tip = std::clamp(foot + random.Uniform(-0.3, 0.3), 0.06, 0.94);
    blades.push_back({foot, tip, random.Uniform(0.45, 0.95), random.Uniform(0.035, 0.07), random.Uniform(0.65, 1.25)});
  }
  auto texture = std::make_shared<geometry::Texture>();
  texture->width = texture->height = size;
  for (int v = 0; v < size; ++v) {
    for (int u = 0; u < size; ++u) {
      const double x = (u + 0.5) / size;
      const double y = (v + 0.5) / size;
      double tone = 0.7;
      double alpha = 0.0;
      for (const Blade& blade : blades) {
        const double s = y / blade.height;
        if (s > 1.0) continue;
        const double middle = blade.foot + (blade.tip - blade.foot) * s * s;
        const double inside = 0.5 * blade.width * std::sqrt(1.0 - s) - std::abs(x - middle);
        if (inside > 0.0) tone = blade.tone * (0.75 + 0.35 * s);
        alpha = std::max(alpha, std::clamp(0.5 + inside * size, 0.0, 1.0));
      }
      for (int c = 0; c < 3; ++c) {
        texture->rgb.push_back(static_cast<std::uint8_t>(std::clamp(255.0 * tone * double{green[c]}, 0.0, 255.0)));
      }
      texture->alpha.push_back(static_cast<std::uint8_t>(255.0 * alpha + 0.5));
    }
  }
  return texture;
}

/// Two upright cards that cross, seen from both sides; lit as the ground is, from above.
std::shared_ptr<const geometry::Mesh> MakeTuft(double width, double height) {
  auto mesh = std::make_shared<geometry::Mesh>();
  for (const double yaw : {0.0, 0.5 * std::numbers::pi}) {
    const Vec2 along(std::cos(yaw), std::sin(yaw));
    for (const double face : {1.0, -1.0}) {
      const auto first = static_cast<std::uint32_t>(mesh->vertices.size());
      for (const auto& [s, t] : {std::pair{-1.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        const Vec2 p = face * s * 0.5 * width * along;
        mesh->vertices.push_back({Vec3(p.x(), p.y(), height * t - 0.01).cast<float>(), Vec3::UnitZ().cast<float>(),
                                  Eigen::Vector2d(0.5 * (s + 1.0), 0.999 * t).cast<float>()});
      }
      mesh->triangles.push_back({first, first + 1, first + 2});
      mesh->triangles.push_back({first, first + 2, first + 3});
    }
  }
  return mesh;
}

}  // namespace

void AddGrass(World& world, const std::string& name, const GrassConfig& config, std::uint64_t seed) {
  RandomStream random(seed, "world/actors/" + name);
  constexpr std::size_t kKinds = 4;
  std::array<int, kKinds> materials{};
  std::array<std::shared_ptr<const geometry::Mesh>, kKinds> meshes;
  for (std::size_t i = 0; i < kKinds; ++i) {
    const auto dry = static_cast<float>(random.Uniform(0.0, 0.6));
    const Eigen::Vector3f green =
        (1.0F - dry) * Eigen::Vector3f(0.33F, 0.47F, 0.18F) + dry * Eigen::Vector3f(0.58F, 0.54F, 0.28F);
    materials[i] = static_cast<int>(world.materials.size());
    world.materials.push_back(
        {name + "/blades" + std::to_string(i), Eigen::Vector3f::Ones(), MakeBlades(128, green, random), 2.0F});
    const double height = config.height * random.Uniform(0.7, 1.3);
    meshes[i] = MakeTuft(height * random.Uniform(0.9, 1.3), height);
  }
  Sway sway;
  Actor actor{.name = name, .semantic = SemanticClass::kGrass, .links = {}, .motion = {}};
  for (int i = 0; i < config.tufts; ++i) {
    const Vec2 p(random.Uniform(config.low.x(), config.high.x()), random.Uniform(config.low.y(), config.high.y()));
    const double z = config.ground ? HeightAt(*config.ground, p) : 0.0;
    sway.X_WR.push_back({base::FromYaw(random.Uniform(0.0, std::numbers::pi)), {p.x(), p.y(), z}});
    const std::size_t kind = random.Index(kKinds);
    actor.links.push_back({.name = "tuft" + std::to_string(i),
                           .shape = geometry::MeshShape{meshes[kind]},
                           .joint = i,
                           .X_JL = {},
                           .material = materials[kind],
                           .collides = false,
                           .casts_shadow = false});
  }
  actor.motion = std::move(sway);
  world.actors.push_back(std::move(actor));
}

}  // namespace alula::worlds

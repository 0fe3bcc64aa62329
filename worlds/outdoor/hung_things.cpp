#include "worlds/outdoor/hung_things.h"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "worlds/furniture.h"
#include "worlds/kit/mesh_parts.h"
#include "worlds/kit/surface.h"
#include "worlds/kit/vegetation.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Transform;
using base::Vec3;
using geometry::Mesh;

constexpr double kPi = std::numbers::pi;

void Put(World& world, const std::string& name, std::shared_ptr<Mesh> mesh, const Transform& X, int material) {
  AddObject(world, name, geometry::MeshShape{std::move(mesh)}, X, material, 1.0);
}

/// A line that sways a little from `from` down by `length`.
std::vector<TubePoint> Dangling(const Vec3& from, double length, double radius, RandomStream& random) {
  std::vector<TubePoint> line;
  const double phase = random.Uniform(0.0, 2.0 * kPi);
  constexpr int kSteps = 7;
  for (int i = 0; i <= kSteps; ++i) {
    const double down = length * i / kSteps;
    const double sway = 0.10 * length * (std::sin(phase + 3.5 * i / kSteps) - std::sin(phase));
    line.push_back({from + Vec3(sway, 0.5 * sway, -down), radius});
  }
  return line;
}

}  // namespace

HungLooks AddHungLooks(World& world, std::uint64_t seed) {
  HungLooks looks;
  looks.kite = AddMaterial(
      world, "kite",
      {.pattern = Pattern::kSignal, .palette = {{0.80F, 0.10F, 0.10F}, {0.98F, 0.85F, 0.20F}}, .size = 64}, seed);
  looks.spar = AddPlainMaterial(world, "spar", {0.45F, 0.36F, 0.25F});
  looks.balloon = AddPlainMaterial(world, "balloon", {0.85F, 0.12F, 0.18F});
  looks.bag = AddMaterial(world, "bag",
                          {.pattern = Pattern::kPlaster,
                           .palette = {{0.55F, 0.57F, 0.60F}, {0.95F, 0.95F, 0.95F}},
                           .size = 64,
                           .contrast = 0.12},
                          seed);
  looks.bark = AddMaterial(world, "branch",
                           {.pattern = Pattern::kBark,
                            .palette = {{0.18F, 0.14F, 0.11F}, {0.60F, 0.52F, 0.44F}},
                            .size = 64,
                            .contrast = 0.2},
                           seed);
  looks.leaves = AddFoliageMaterial(world, "branch/leaves",
                                    {.leaves = {{0.16F, 0.18F, 0.06F}, {0.62F, 0.60F, 0.28F}}, .size = 256}, seed);
  looks.string = AddPlainMaterial(world, "string", {0.75F, 0.73F, 0.68F});
  return looks;
}

void HangKite(World& world, const HungLooks& looks, const std::string& name, const Transform& X_WL, double radius,
              RandomStream& random) {
  const double tall = random.Uniform(0.9, 1.2);
  const double wide = 0.8 * tall;
  // Caught at the crossing of its spars; it leans over the wire.
  const Transform X_LK{
      base::FromYawPitchRoll(random.Uniform(-0.5, 0.5), random.Uniform(-0.3, 0.3), random.Uniform(-0.5, 0.5)),
      {0.0, radius + 0.012, -0.15 * tall}};
  auto sail = std::make_shared<Mesh>();
  const double top = 0.35 * tall;
  const double bottom = -0.65 * tall;
  const Vec3 belly(0.0, 0.02, 0.0);
  const std::array<Vec3, 4> rim{Vec3(0, 0, bottom), Vec3(0.5 * wide, -0.03, 0), Vec3(0, 0, top),
                                Vec3(-0.5 * wide, -0.03, 0)};
  for (std::size_t i = 0; i < 4; ++i) {  // four triangles about the crossing, from both sides
    const Vec3& a = rim[i];
    const Vec3& b = rim[(i + 1) % 4];
    for (const bool front : {true, false}) {
      const auto first = static_cast<std::uint32_t>(sail->vertices.size());
      const Vec3 n = (a - belly).cross(b - belly).normalized() * (front ? 1.0 : -1.0);
      for (const Vec3& p : {belly, a, b}) {
        sail->vertices.push_back({p.cast<float>(), n.cast<float>(),
                                  Eigen::Vector2f(static_cast<float>(0.5 + p.x()), static_cast<float>(0.5 + p.z()))});
      }
      front ? sail->triangles.push_back({first, first + 1, first + 2})
            : sail->triangles.push_back({first, first + 2, first + 1});
    }
  }
  Put(world, name + "/sail", std::move(sail), X_WL * X_LK, looks.kite);
  auto spars = std::make_shared<Mesh>();
  const std::array<TubePoint, 2> spine{{{Vec3(0, 0.028, bottom), 0.006}, {Vec3(0, 0.028, top), 0.006}}};
  const std::array<TubePoint, 2> cross{{{Vec3(-0.5 * wide, -0.022, 0), 0.006}, {Vec3(0.5 * wide, -0.022, 0), 0.006}}};
  AddTube(*spars, spine, 5, 0.5);
  AddTube(*spars, cross, 5, 0.5);
  Put(world, name + "/spars", std::move(spars), X_WL * X_LK, looks.spar);
  auto tail = std::make_shared<Mesh>();
  const auto line = Dangling({0, 0, bottom}, random.Uniform(1.4, 2.4), 0.006, random);
  AddTube(*tail, line, 4, 0.5);
  for (std::size_t i = 1; i < line.size(); ++i) {
    AddSheet(*tail, line[i].p, Vec3(0.09, 0.02, 0.03), Vec3(-0.01, 0.015, 0.035));
  }
  Put(world, name + "/tail", std::move(tail), X_WL * X_LK, looks.kite);
}

void HangBalloon(World& world, const HungLooks& looks, const std::string& name, const Transform& X_WL, double radius,
                 RandomStream& random) {
  // Its string is wound about the wire; it has lost its lift and hangs below.
  const double size = random.Uniform(0.14, 0.2);
  auto string = std::make_shared<Mesh>();
  std::vector<TubePoint> coil;
  for (int i = 0; i <= 18; ++i) {
    const double angle = 2.0 * kPi * i / 6.0;
    const double r = radius + 0.005;
    coil.push_back({Vec3(0.01 * (i - 9), r * std::sin(angle), r * std::cos(angle)), 0.004});
  }
  AddTube(*string, coil, 4, 0.5);
  const double drop = random.Uniform(0.35, 0.7);
  const std::vector<TubePoint> line{
      {coil.back().p, 0.003}, {Vec3(0.1, 0.02, -0.5 * drop), 0.003}, {Vec3(0.11, 0.03, -drop), 0.003}};
  AddTube(*string, line, 4, 0.5);
  Put(world, name + "/string", std::move(string), X_WL, looks.string);
  auto knot = std::make_shared<Mesh>();
  const Transform X_knot{base::Quat::Identity(), Vec3(0.11, 0.03, -drop - 0.06)};
  AddLathe(*knot, std::array<base::Vec2, 3>{{{0.35 * size, -0.10}, {0.02, 0.03}, {0.03, 0.06}}}, 10, X_knot, 0.5);
  Put(world, name + "/neck", std::move(knot), X_WL, looks.balloon);
  AddObject(world, name + "/ball", geometry::Sphere{size},
            X_WL * Transform{base::Quat::Identity(), Vec3(0.11, 0.03, -drop - 0.10 - size)}, looks.balloon, 1.0);
}

void HangBag(World& world, const HungLooks& looks, const std::string& name, const Transform& X_WL, double radius,
             RandomStream& random) {
  // A sheet of film over the wire: it falls down on both sides, blown to one, crumpled; two faces.
  constexpr int kColumns = 8;
  constexpr int kRows = 10;
  const double wide = random.Uniform(0.4, 0.65);
  const double front = random.Uniform(0.5, 0.9);
  const double back = random.Uniform(0.25, 0.5);
  const double blown = random.Uniform(0.15, 0.35);
  std::array<std::array<Vec3, kColumns + 1>, kRows + 1> grid;
  for (int row = 0; row <= kRows; ++row) {
    for (int column = 0; column <= kColumns; ++column) {
      const double along = -back + (front + back) * row / kRows;  // of the film, from the wire
      const double down = std::max(0.0, std::abs(along) - 0.03);
      const double hang = down / (along < 0.0 ? back : front);
      const double narrow = 1.0 - 0.35 * hang;
      const double x = wide * narrow * (static_cast<double>(column) / kColumns - 0.5);
      const double fold =
          0.05 * hang * std::sin(9.0 * column / kColumns + 2.0 * hang) + 0.012 * hang * random.Gaussian();
      const double y =
          (along < 0.0 ? -1.0 : 1.0) * std::min(radius + 0.006, 0.5 * std::abs(along)) + blown * hang * hang + fold;
      const double z = radius + 0.008 - down;
      grid[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = {x, y, z};
    }
  }
  auto film = std::make_shared<Mesh>();
  for (std::size_t row = 0; row < kRows; ++row) {
    for (std::size_t column = 0; column < kColumns; ++column) {
      const Vec3& a = grid[row][column];
      const Vec3& b = grid[row][column + 1];
      const Vec3& c = grid[row + 1][column + 1];
      const Vec3& d = grid[row + 1][column];
      AddQuad(*film, {a, b, c, d}, 0.5);
      AddQuad(*film, {b, a, d, c}, 0.5);
    }
  }
  Put(world, name + "/film", std::move(film), X_WL, looks.bag);
}

void HangBranch(World& world, const HungLooks& looks, const std::string& name, const Transform& X_WL, double radius,
                RandomStream& random) {
  const double length = random.Uniform(1.1, 1.8);
  const double thick = random.Uniform(0.014, 0.022);
  // It lies over the wire, across it, its heavier end lower; a fork keeps it there.
  const double z = radius + thick;
  std::vector<TubePoint> stem{{Vec3(0.05, -0.42 * length, z - 0.20 * length), thick},
                              {Vec3(0.0, 0.0, z), 0.9 * thick},
                              {Vec3(-0.08, 0.30 * length, z - 0.02), 0.6 * thick},
                              {Vec3(-0.02, 0.58 * length, z - 0.16 * length), 0.25 * thick}};
  auto wood = std::make_shared<Mesh>();
  auto leaves = std::make_shared<Mesh>();
  AddTube(*wood, stem, 6, 0.5);
  const auto twig = [&](const Vec3& from, const Vec3& to) {
    const std::array<TubePoint, 2> line{{{from, 0.4 * thick}, {to, 0.15 * thick}}};
    AddTube(*wood, line, 4, 0.5);
    for (int i = 0; i < 2; ++i) {
      const base::Quat turn = base::Exp(random.GaussianVec3());
      const Vec3 n = (turn * Vec3(0, 0, 1) + Vec3(0, 0, 0.8)).normalized();
      AddCard(*leaves, to + 0.06 * random.GaussianVec3(), turn * Vec3(0.2, 0, 0), turn * Vec3(0, 0.2, 0), {n, n, n, n});
    }
  };
  twig({0.0, 0.02, z}, {0.22, 0.10, z - 0.30});  // the fork, down before the wire
  twig(stem[2].p, stem[2].p + Vec3(0.30, 0.12, 0.10));
  twig(stem[2].p, stem[2].p + Vec3(-0.28, 0.18, -0.12));
  twig(stem[3].p, stem[3].p + Vec3(0.10, 0.20, -0.10));
  Put(world, name + "/wood", std::move(wood), X_WL, looks.bark);
  const std::size_t crown =
      AddObject(world, name + "/leaves", geometry::MeshShape{std::move(leaves)}, X_WL, looks.leaves, 1.0);
  world.objects[crown].collides = false;
}

}  // namespace alula::worlds

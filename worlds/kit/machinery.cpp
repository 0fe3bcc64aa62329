#include "worlds/kit/machinery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "worlds/furniture.h"
#include "worlds/kit/room.h"

namespace alula::worlds {
namespace {

using base::Quat;
using base::RandomStream;
using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kPi = std::numbers::pi;

Transform At(const Vec3& p) { return {Quat::Identity(), p}; }
/// z along the given direction.
Quat Along(const Vec3& direction) { return Quat::FromTwoVectors(Vec3::UnitZ(), direction); }

/// Shapes of one thing, in its axes.
struct Builder {
  World& world;
  const std::string& name;
  const Transform& X_WT;

  void Box(const std::string& part, const Vec3& size, const Vec3& middle, int material, double scale = 1.5) const {
    AddBox(world, name + "/" + part, size, X_WT * At(middle), material, scale);
  }
  /// A cylinder about `middle`, its axis along `axis`.
  void Round(const std::string& part, double radius, double length, const Vec3& middle, const Vec3& axis, int material,
             double scale = 1.5) const {
    AddObject(world, name + "/" + part, geometry::Cylinder{radius, 0.5 * length}, X_WT * Transform{Along(axis), middle},
              material, scale);
  }
};

/// The twelve triangles of an upright box, appended.
void AppendBox(geometry::Mesh& mesh, const Vec3& middle, const Vec3& half) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 n = Vec3::Zero();
      n[axis] = side;
      const Vec3 up = axis == 2 ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitZ());
      const Vec3 right = up.cross(n);
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      constexpr std::array<std::array<double, 2>, 4> kCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
      for (const auto& [x, y] : kCorners) {
        const Vec3 p = middle + (n + x * right + y * up).cwiseProduct(half);
        mesh.vertices.push_back(
            {p.cast<float>(), n.cast<float>(), Eigen::Vector2d(p.x(), p.y() + p.z()).cast<float>()});
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }
}

}  // namespace

MachineLooks AddMachineMaterials(World& world, int texture_size, std::uint64_t seed) {
  const int size = std::max(16, texture_size / 2);
  const auto add = [&](const char* name, Pattern pattern, const Palette& palette, double contrast) {
    return AddMaterial(world, name, {.pattern = pattern, .palette = palette, .size = size, .contrast = contrast}, seed);
  };
  MachineLooks l;
  l.casing = add("casing", Pattern::kMetal, {{0.24F, 0.32F, 0.40F}, {0.56F, 0.64F, 0.70F}}, 0.14);
  l.green = add("machine green", Pattern::kMetal, {{0.18F, 0.30F, 0.24F}, {0.50F, 0.60F, 0.52F}}, 0.14);
  l.steel = add("steel", Pattern::kMetal, {{0.34F, 0.35F, 0.36F}, {0.76F, 0.77F, 0.78F}}, 0.13);
  l.rust = add("rust", Pattern::kPlaster, {{0.20F, 0.12F, 0.08F}, {0.58F, 0.44F, 0.34F}}, 0.16);
  l.pipe = add("pipe", Pattern::kMetal, {{0.42F, 0.43F, 0.42F}, {0.84F, 0.84F, 0.80F}}, 0.11);
  l.lagging = add("lagging", Pattern::kPlaster, {{0.56F, 0.56F, 0.54F}, {0.92F, 0.91F, 0.88F}}, 0.11);
  l.panel = add("switch panel", Pattern::kPaving, {{0.30F, 0.32F, 0.33F}, {0.72F, 0.74F, 0.74F}}, 0.10);
  l.hazard = add("hazard stripes", Pattern::kSignal, {{0.06F, 0.06F, 0.05F}, {0.92F, 0.78F, 0.16F}}, 0.3);
  l.drum = add("drum", Pattern::kMetal, {{0.14F, 0.22F, 0.36F}, {0.46F, 0.56F, 0.70F}}, 0.13);
  l.crate = add("crate", Pattern::kWood, {{0.34F, 0.24F, 0.15F}, {0.78F, 0.65F, 0.47F}}, 0.17);
  l.dark = AddPlainMaterial(world, "black", {0.09F, 0.09F, 0.09F});
  l.white = AddPlainMaterial(world, "white", {0.93F, 0.93F, 0.91F});
  return l;
}

void AddMachine(World& world, const MachineLooks& looks, const std::string& name, const Transform& X_WT, double length,
                RandomStream& random) {
  const Builder b{world, name, X_WT};
  const Vec3 x = Vec3::UnitX();
  const double bed = random.Uniform(0.3, 0.45);
  const double radius = random.Uniform(0.5, 0.68);
  const double axis = bed + radius + 0.15;  // height of the shaft
  const int paint = random.Index(2) == 0 ? looks.casing : looks.green;
  b.Box("bed", {length, 2.0 * radius + 0.3, bed}, {0.0, 0.0, 0.5 * bed}, looks.lagging, 2.2);
  const double casing = 0.46 * length;
  const double at = -0.5 * length + 0.25 + 0.5 * casing;
  b.Round("casing", radius, casing, {at, 0.0, axis}, x, paint, 1.9);
  for (int i = 0; i < 4; ++i) {  // flanges where the casing's rings are bolted
    b.Round("flange" + std::to_string(i), radius + 0.06, 0.05, {at + casing * (i / 3.0 - 0.5) * 0.98, 0.0, axis}, x,
            looks.steel);
  }
  b.Box("saddle0", {0.22, 1.6 * radius, axis - bed}, {at - 0.3 * casing, 0.0, 0.5 * (axis + bed)}, looks.steel);
  b.Box("saddle1", {0.22, 1.6 * radius, axis - bed}, {at + 0.3 * casing, 0.0, 0.5 * (axis + bed)}, looks.steel);
  b.Round("shaft", 0.09, length - 0.6, {0.0, 0.0, axis}, x, looks.steel);
  const double gap = at + 0.5 * casing + 0.35;
  b.Box("bearing", {0.34, 0.5, axis - bed + 0.2}, {gap, 0.0, bed + 0.5 * (axis - bed + 0.2)}, looks.rust);
  const double motor = 0.5 * length - 0.15 - (gap + 0.3);
  const double middle = gap + 0.3 + 0.5 * motor;
  b.Round("motor", 0.78 * radius, motor, {middle, 0.0, axis}, x, looks.green == paint ? looks.casing : looks.green,
          1.3);
  b.Box("motor_foot", {0.8 * motor, 1.1 * radius, axis - bed - 0.3 * radius},
        {middle, 0.0, bed + 0.5 * (axis - bed - 0.3 * radius)}, looks.rust);
  b.Box("terminals", {0.3, 0.26, 0.24}, {middle, 0.0, axis + 0.78 * radius + 0.1}, looks.panel, 0.7);
  // A pipe out of the casing's top with a hand wheel.
  b.Round("neck", 0.17, 0.6, {at, 0.0, axis + radius + 0.25}, Vec3::UnitZ(), looks.pipe);
  b.Round("neck_flange", 0.25, 0.05, {at, 0.0, axis + radius + 0.55}, Vec3::UnitZ(), looks.steel);
  b.Round("spindle", 0.025, 0.36, {at, radius + 0.05, axis + 0.35}, Vec3::UnitY(), looks.steel);
  b.Round("hand_wheel", 0.17, 0.03, {at, radius + 0.22, axis + 0.35}, Vec3::UnitY(), looks.hazard, 0.6);
}

void AddTank(World& world, const MachineLooks& looks, const std::string& name, const Transform& X_WT, double radius,
             double height, RandomStream& random) {
  const Builder b{world, name, X_WT};
  const double foot = random.Uniform(0.5, 0.8);
  const double shell = height - foot - 0.8 * radius;
  const int paint = std::array{looks.lagging, looks.steel, looks.pipe, looks.rust}[random.Index(4)];
  const Vec3 z = Vec3::UnitZ();
  AddObject(world, name + "/bottom", geometry::Cone{radius, 0.2 * radius},
            X_WT * Transform{base::Exp(Vec3(kPi, 0.0, 0.0)), {0.0, 0.0, foot + 0.2 * radius}}, paint, 2.0);
  b.Round("shell", radius, shell, {0.0, 0.0, foot + 0.4 * radius + 0.5 * shell}, z, paint, 2.4);
  AddObject(world, name + "/dome", geometry::Cone{radius, 0.2 * radius},
            X_WT * At({0.0, 0.0, foot + 0.4 * radius + shell + 0.2 * radius}), paint, 2.0);
  for (int i = 0; i < 2; ++i) {
    b.Round("ring" + std::to_string(i), radius + 0.025, 0.07,
            {0.0, 0.0, foot + 0.4 * radius + shell * (0.12 + 0.76 * i)}, z, looks.steel);
  }
  for (int i = 0; i < 4; ++i) {
    const double angle = 0.25 * kPi + 0.5 * kPi * i;
    const double reach = radius + 0.02;
    b.Box("leg" + std::to_string(i), {0.12, 0.12, foot + 0.8 * radius},
          {reach * std::cos(angle), reach * std::sin(angle), 0.5 * (foot + 0.8 * radius)}, looks.rust);
  }
  b.Round("manhole", 0.26, 0.14, {radius + 0.03, 0.0, foot + 0.4 * radius + 0.35 * shell}, Vec3::UnitX(), looks.steel);
  b.Round("drain", 0.06, foot + 0.04, {0.0, 0.0, 0.5 * foot + 0.02}, z, looks.pipe);
  b.Round("gauge", 0.09, 0.06, {radius * 0.72, radius * 0.72, foot + 0.4 * radius + 0.6 * shell}, Vec3(1.0, 1.0, 0.0),
          looks.white);
}

void AddCabinets(World& world, const MachineLooks& looks, const std::string& name, const Transform& X_WT, int count,
                 RandomStream& random) {
  const Builder b{world, name, X_WT};
  constexpr double kWidth = 0.8;
  constexpr double kDepth = 0.5;
  const double height = random.Uniform(1.8, 2.1);
  for (int i = 0; i < count; ++i) {
    const std::string n = std::to_string(i);
    const double y = (i - 0.5 * (count - 1)) * kWidth;
    b.Box("body" + n, {kDepth, kWidth - 0.01, height}, {0.5 * kDepth + 0.01, y, 0.5 * height}, looks.panel, 1.7);
    b.Box("door" + n, {0.02, kWidth - 0.07, height - 0.2}, {kDepth + 0.02, y, 0.5 * height + 0.03}, looks.casing, 1.7);
    b.Box("plate" + n, {0.012, 0.22, 0.12}, {kDepth + 0.035, y, 0.8 * height}, looks.white);
    b.Box("grille" + n, {0.012, 0.4, 0.22}, {kDepth + 0.035, y, 0.2 * height}, looks.dark);
    b.Round("lamp" + n, 0.03, 0.03, {kDepth + 0.04, y + 0.15, 0.65 * height}, Vec3::UnitX(), looks.hazard, 0.3);
    b.Box("grip" + n, {0.04, 0.025, 0.16}, {kDepth + 0.05, y - 0.28, 0.5 * height}, looks.dark);
  }
}

void AddDrum(World& world, const MachineLooks& looks, const std::string& name, const Transform& X_WT,
             RandomStream& random) {
  const Builder b{world, name, X_WT};
  const Vec3 z = Vec3::UnitZ();
  b.Round("shell", 0.29, 0.88, {0.0, 0.0, 0.44}, z, random.Index(2) == 0 ? looks.drum : looks.rust, 1.1);
  for (int i = 0; i < 4; ++i) {
    b.Round("ring" + std::to_string(i), 0.302, 0.03, {0.0, 0.0, 0.015 + 0.283 * i + 0.001 * i}, z, looks.steel);
  }
}

void AddPipe(World& world, const std::string& name, const std::vector<Vec3>& points, double radius, int material,
             int flange) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 way = points[i + 1] - points[i];
    const double length = way.norm();
    const Quat turn = Along(way / length);
    const std::string n = std::to_string(i);
    AddObject(world, name + "/run" + n, geometry::Cylinder{radius, 0.5 * length},
              {turn, 0.5 * (points[i] + points[i + 1])}, material, 1.6);
    if (i > 0) AddObject(world, name + "/bend" + n, geometry::Sphere{1.04 * radius}, At(points[i]), material, 1.6);
    const int flanges = static_cast<int>(length / 2.5);
    for (int k = 1; k <= flanges; ++k) {
      AddObject(world, name + "/flange" + n + "_" + std::to_string(k), geometry::Cylinder{1.35 * radius, 0.03},
                {turn, points[i] + way * (static_cast<double>(k) / (flanges + 1))}, flange, 1.0);
    }
  }
}

void AddGirder(World& world, const std::string& name, const Vec3& a, const Vec3& b, double height, double width,
               int material) {
  const Vec3 way = b - a;
  const double length = way.norm();
  const Vec3 x = way / length;
  const Vec3 side = (std::abs(x.z()) > 0.9 ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitZ().cross(x))).normalized();
  base::Mat3 R;
  R << x, side, x.cross(side);
  const Transform X_WT{Quat(R), 0.5 * (a + b)};
  constexpr double kPlate = 0.025;  // m
  AddBox(world, name + "/web", {length, kPlate, height - 2.0 * kPlate}, X_WT, material, 1.8);
  for (const double end : {-1.0, 1.0}) {
    AddBox(world, name + (end < 0.0 ? "/lower" : "/upper"), {length, width, kPlate},
           X_WT * At({0.0, 0.0, end * 0.5 * (height - kPlate)}), material, 1.8);
  }
}

void AddGrating(World& world, const std::string& name, const Transform& X_WT, const Vec2& size, int material) {
  constexpr double kThick = 0.03;   // m, of the bars, and how high they are
  constexpr double kPitch = 0.125;  // m: wider than a real one's 3 cm, which no picture would resolve
  auto mesh = std::make_shared<geometry::Mesh>();
  const double z = -0.5 * kThick;
  const int bars = static_cast<int>(std::floor((size.y() - kThick) / kPitch));
  for (int i = 0; i <= bars; ++i) {
    const double y = -0.5 * (size.y() - kThick) + (size.y() - kThick) * i / bars;
    AppendBox(*mesh, {0.0, y, z}, {0.5 * size.x(), 0.5 * kThick, 0.5 * kThick});
  }
  const int ties = std::max(1, static_cast<int>(std::lround(size.x() / 0.5)));
  for (int i = 0; i <= ties; ++i) {  // a little lower than the bars they cross
    const double x = -0.5 * (size.x() - kThick) + (size.x() - kThick) * i / ties;
    AppendBox(*mesh, {x, 0.0, z - 0.004}, {0.5 * kThick, 0.5 * size.y() - 0.002, 0.5 * kThick});
  }
  AddObject(world, name, geometry::MeshShape{mesh}, X_WT, material, 1.0);
}

void AddRailing(World& world, const std::string& name, const Transform& X_WT, double length, int material) {
  const Builder b{world, name, X_WT};
  const int posts = std::max(1, static_cast<int>(std::lround(length / 1.6)));
  for (int i = 0; i <= posts; ++i) {
    b.Round("post" + std::to_string(i), 0.022, 1.08, {length * (static_cast<double>(i) / posts - 0.5), 0.0, 0.54},
            Vec3::UnitZ(), material);
  }
  b.Round("top_rail", 0.024, length + 0.05, {0.0, 0.0, 1.08}, Vec3::UnitX(), material);
  b.Round("knee_rail", 0.018, length, {0.0, 0.0, 0.56}, Vec3::UnitX(), material);
  b.Box("toe_board", {length, 0.012, 0.12}, {0.0, 0.0, 0.07}, material);
}

}  // namespace alula::worlds

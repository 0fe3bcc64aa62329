#include "worlds/kit/office_furniture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "worlds/furniture.h"
#include "worlds/kit/room.h"

namespace alula::worlds {
namespace {

using base::Quat;
using base::Transform;
using base::Vec3;

constexpr double kPi = std::numbers::pi;

Transform At(const Vec3& p) { return {Quat::Identity(), p}; }

/// Boxes of one thing.
struct Builder {
  World& world;
  const std::string& name;
  const Transform& X_WT;

  void Box(const std::string& part, const Vec3& size, const Vec3& middle, int material, double scale = 1.2,
           SemanticClass semantic = SemanticClass::kObstacle) const {
    AddBox(world, name + "/" + part, size, X_WT * At(middle), material, scale, semantic);
  }
  void Upright(const std::string& part, double radius, double low, double high, double x, double y,
               int material) const {
    AddObject(world, name + "/" + part, geometry::Cylinder{radius, 0.5 * (high - low)},
              X_WT * At({x, y, 0.5 * (low + high)}), material, 0.8);
  }
};

}  // namespace

OfficeLooks AddOfficeMaterials(World& world, int texture_size, std::uint64_t seed) {
  const int size = std::max(16, texture_size / 2);
  const auto add = [&](const char* name, Pattern pattern, const Palette& palette, double contrast) {
    return AddMaterial(world, name, {.pattern = pattern, .palette = palette, .size = size, .contrast = contrast}, seed);
  };
  OfficeLooks l;
  l.wood = add("desk top", Pattern::kWood, {{0.50F, 0.39F, 0.27F}, {0.84F, 0.74F, 0.58F}}, 0.10);
  l.steel = add("steel", Pattern::kMetal, {{0.48F, 0.50F, 0.52F}, {0.80F, 0.82F, 0.84F}}, 0.06);
  l.fabric = add("fabric", Pattern::kCarpet, {{0.10F, 0.14F, 0.22F}, {0.32F, 0.40F, 0.52F}}, 0.14);
  l.paper = add("paper", Pattern::kSignal, {{0.25F, 0.25F, 0.30F}, {0.96F, 0.95F, 0.93F}}, 0.2);
  l.screen = add("screen", Pattern::kPaving, {{0.05F, 0.07F, 0.12F}, {0.50F, 0.58F, 0.68F}}, 0.14);
  l.leaves = add("leaves", Pattern::kFoliage, {{0.05F, 0.12F, 0.04F}, {0.48F, 0.66F, 0.30F}}, kFullContrast);
  l.pot = add("pot", Pattern::kPlaster, {{0.46F, 0.44F, 0.42F}, {0.80F, 0.78F, 0.75F}}, 0.10);
  l.door = add("door", Pattern::kWood, {{0.56F, 0.44F, 0.31F}, {0.78F, 0.66F, 0.50F}}, 0.08);
  l.dark = AddPlainMaterial(world, "black plastic", {0.09F, 0.09F, 0.10F});
  l.white = AddPlainMaterial(world, "white", {0.93F, 0.93F, 0.92F});
  l.glass = AddPlainMaterial(world, "satin glass", {0.66F, 0.74F, 0.76F});
  l.pad = AddMaterial(world, "pad",
                      {.pattern = Pattern::kPad,
                       .palette = {{0.06F, 0.08F, 0.10F}, {0.95F, 0.93F, 0.85F}},
                       .size = std::max(16, texture_size / 4)},
                      seed);
  l.poster = add("poster", Pattern::kSignal, {{0.16F, 0.26F, 0.40F}, {0.96F, 0.90F, 0.72F}}, 0.25);
  return l;
}

void AddDesk(World& world, const OfficeLooks& looks, const std::string& name, const Transform& X_WT,
             base::RandomStream& random) {
  constexpr double kTop = 0.74;  // m
  const Builder b{world, name, X_WT};
  b.Box("top", {0.8, 1.6, 0.03}, {0.0, 0.0, kTop - 0.015}, looks.wood, 1.3);
  for (const double side : {-1.0, 1.0}) {
    const std::string which = side < 0.0 ? "right" : "left";
    b.Box(which + "_leg", {0.06, 0.04, kTop - 0.06}, {0.0, side * 0.74, 0.5 * (kTop - 0.06) + 0.03}, looks.steel);
    b.Box(which + "_foot", {0.68, 0.05, 0.03}, {0.0, side * 0.74, 0.015}, looks.steel);
  }
  b.Box("panel", {0.02, 1.4, 0.35}, {0.3, 0.0, kTop - 0.03 - 0.175}, looks.white);
  b.Box("drawers", {0.55, 0.4, 0.58}, {-0.02, random.Index(2) == 0 ? 0.48 : -0.48, 0.29}, looks.steel, 0.9);
  const double y = random.Uniform(-0.25, 0.25);
  b.Box("monitor", {0.03, 0.56, 0.34}, {0.18, y, kTop + 0.31}, looks.dark);
  b.Box("picture", {0.004, 0.53, 0.31}, {0.163, y, kTop + 0.31}, looks.screen, 0.5);
  b.Box("stand", {0.03, 0.06, 0.16}, {0.21, y, kTop + 0.09}, looks.dark);
  b.Box("base", {0.18, 0.22, 0.015}, {0.2, y, kTop + 0.0075}, looks.dark);
  b.Box("keyboard", {0.14, 0.42, 0.02}, {-0.16, y, kTop + 0.01}, looks.dark);
  for (int i = 0; i < 3; ++i) {
    const Vec3 p(random.Uniform(-0.25, 0.1), y + (i % 2 == 0 ? -1.0 : 1.0) * random.Uniform(0.36, 0.5),
                 kTop + 0.002 + 0.002 * i);
    AddBox(world, name + "/paper" + std::to_string(i), {0.297, 0.21, 0.003 + 0.002 * i},
           X_WT * Transform{base::FromYaw(random.Uniform(-0.5, 0.5)), p}, looks.paper, 0.4);
  }
}

void AddOfficeChair(World& world, const OfficeLooks& looks, const std::string& name, const Transform& X_WT) {
  const Builder b{world, name, X_WT};
  for (int i = 0; i < 5; ++i) {
    const double angle = 2.0 * kPi * i / 5.0;
    const Transform X_TF{base::FromYaw(angle), {0.14 * std::cos(angle), 0.14 * std::sin(angle), 0.075}};
    AddBox(world, name + "/foot" + std::to_string(i), {0.28, 0.035, 0.03}, X_WT * X_TF, looks.dark, 1.0);
    AddObject(world, name + "/castor" + std::to_string(i), geometry::Sphere{0.03},
              X_WT * At({0.27 * std::cos(angle), 0.27 * std::sin(angle), 0.03}), looks.dark, 1.0);
  }
  b.Upright("post", 0.025, 0.06, 0.43, 0.0, 0.0, looks.steel);
  b.Box("seat", {0.46, 0.46, 0.07}, {0.0, 0.0, 0.465}, looks.fabric, 0.8);
  b.Box("stay", {0.03, 0.06, 0.3}, {-0.235, 0.0, 0.58}, looks.dark);
  b.Box("back", {0.06, 0.43, 0.48}, {-0.25, 0.0, 0.82}, looks.fabric, 0.8);
}

void AddShelf(World& world, const OfficeLooks& looks, const std::string& name, const Transform& X_WT, const Vec3& size,
              base::RandomStream& random) {
  constexpr double kBoard = 0.022;  // m
  const Builder b{world, name, X_WT};
  const double x = 0.5 * size.x();
  b.Box("back", {0.01, size.y(), size.z()}, {0.006, 0.0, 0.5 * size.z()}, looks.white);
  for (const double side : {-1.0, 1.0}) {
    b.Box(side < 0.0 ? "right" : "left", {size.x(), kBoard, size.z()},
          {x, side * 0.5 * (size.y() - kBoard), 0.5 * size.z()}, looks.wood);
  }
  const int boards = std::max(2, static_cast<int>(std::lround(size.z() / 0.37)));
  for (int i = 0; i <= boards; ++i) {
    const double z = 0.5 * kBoard + (size.z() - kBoard) * i / boards;
    b.Box("board" + std::to_string(i), {size.x() - 0.02, size.y() - 2.0 * kBoard, kBoard}, {x + 0.01, 0.0, z},
          looks.wood);
    if (i == boards) break;
    double y = -0.5 * size.y() + kBoard + random.Uniform(0.0, 0.1);
    for (int k = 0; y < 0.5 * size.y() - 0.3; ++k) {  // folders in runs of one make
      const double run = random.Uniform(0.1, 0.28);
      const double height = random.Uniform(0.22, 0.31);
      const int look = random.Index(3) == 0 ? looks.dark : random.Index(2) == 0 ? looks.paper : looks.fabric;
      b.Box("folders" + std::to_string(i) + "_" + std::to_string(k), {size.x() - 0.06, run, height},
            {x, y + 0.5 * run, z + 0.5 * kBoard + 0.5 * height}, look, 0.5);
      y += run + random.Uniform(0.01, 0.12);
    }
  }
}

void AddCupboard(World& world, const OfficeLooks& looks, const std::string& name, const Transform& X_WT,
                 const Vec3& size) {
  const Builder b{world, name, X_WT};
  b.Box("body", {size.x() - 0.02, size.y(), size.z() - 0.06}, {0.5 * size.x() - 0.01, 0.0, 0.5 * size.z() + 0.03},
        looks.steel, 1.4);
  b.Box("plinth", {size.x() - 0.06, size.y() - 0.04, 0.06}, {0.5 * size.x() - 0.01, 0.0, 0.03}, looks.dark);
  for (const double side : {-1.0, 1.0}) {
    const std::string which = side < 0.0 ? "right" : "left";
    b.Box(which + "_door", {0.02, 0.5 * size.y() - 0.008, size.z() - 0.08},
          {size.x() - 0.01, side * 0.25 * size.y(), 0.5 * size.z() + 0.03}, looks.white, 1.4);
    b.Box(which + "_grip", {0.025, 0.015, 0.14}, {size.x() + 0.012, side * 0.05, 0.55 * size.z()}, looks.dark);
  }
}

void AddBin(World& world, const OfficeLooks& looks, const std::string& name, const Transform& X_WT) {
  const Builder b{world, name, X_WT};
  b.Upright("pail", 0.14, 0.0, 0.36, 0.0, 0.0, looks.steel);
  b.Upright("rim", 0.15, 0.36, 0.38, 0.0, 0.0, looks.dark);
}

void AddPottedPlant(World& world, const OfficeLooks& looks, const std::string& name, const Transform& X_WT,
                    base::RandomStream& random) {
  const Builder b{world, name, X_WT};
  b.Upright("pot", 0.16, 0.0, 0.32, 0.0, 0.0, looks.pot);
  b.Upright("soil", 0.14, 0.32, 0.325, 0.0, 0.0, looks.dark);
  b.Upright("stem", 0.012, 0.32, 0.7, 0.0, 0.0, looks.door);
  for (int i = 0; i < 6; ++i) {
    const double angle = 2.0 * kPi * (i + random.Uniform()) / 6.0;
    const double out = random.Uniform(0.05, 0.12);
    AddObject(world, name + "/leaves" + std::to_string(i), geometry::Sphere{random.Uniform(0.09, 0.13)},
              X_WT * Transform{base::FromYaw(angle),
                               {out * std::cos(angle), out * std::sin(angle), random.Uniform(0.6, 1.05)}},
              looks.leaves, 0.7, SemanticClass::kTree);
  }
}

void AddDoorLeaf(World& world, const OfficeLooks& looks, const std::string& name, const Transform& X_WH, double width,
                 double height, bool glass) {
  constexpr double kThick = 0.04;  // m
  constexpr double kRim = 0.07;    // m, of a glass door's frame
  const Builder b{world, name, X_WH};
  const double z = 0.006 + 0.5 * height;  // it swings clear of the floor
  const double x = 0.5 * width;
  if (glass) {
    b.Box("pane", {width - 2.0 * kRim, 0.012, height - 2.0 * kRim}, {x, 0.0, z}, looks.glass, 1.0,
          SemanticClass::kGlass);
    for (const double side : {-1.0, 1.0}) {
      b.Box(side < 0.0 ? "hinge_stile" : "lock_stile", {kRim, kThick, height},
            {x + side * 0.5 * (width - kRim), 0.0, z}, looks.steel);
      b.Box(side < 0.0 ? "bottom_rail" : "top_rail", {width - 2.0 * kRim, kThick, kRim},
            {x, 0.0, z + side * 0.5 * (height - kRim)}, looks.steel);
    }
  } else {
    b.Box("leaf", {width, kThick, height}, {x, 0.0, z}, looks.door, 1.9, SemanticClass::kWall);
  }
  for (const double side : {-1.0, 1.0}) {
    b.Box(side < 0.0 ? "grip_in" : "grip_out", {0.13, 0.02, 0.02}, {width - 0.1, side * 0.06, 1.05}, looks.steel);
    b.Box(side < 0.0 ? "boss_in" : "boss_out", {0.03, 0.06 - 0.5 * kThick, 0.03},
          {width - 0.05, side * (0.03 + 0.25 * kThick), 1.05}, looks.steel);
  }
}

}  // namespace alula::worlds

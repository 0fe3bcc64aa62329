#include "worlds/indoor/office.h"

#include <array>
#include <cmath>
#include <numbers>

#include "worlds/furniture.h"
#include "worlds/kit/office_furniture.h"
#include "worlds/kit/room.h"
#include "worlds/textures.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Vec3;

constexpr double kPi = std::numbers::pi;
const Vec3 kSize(6.0, 1.5, 2.6);  // m
constexpr double kStart = -2.45;
constexpr double kTarget = 2.6;
constexpr double kPadRadius = 0.3;

struct CorridorLooks {
  Surface floor, wall, ceiling;
  OfficeLooks office;
  int skirting = 0;
};

CorridorLooks AddLooks(World& world, const OfficeConfig& config, std::uint64_t seed) {
  const auto surface = [&](const char* name, Pattern pattern, const Palette& palette, double period, double contrast) {
    return AddSurface(world, name,
                      {.pattern = pattern,
                       .palette = palette,
                       .period = period,
                       .size = config.texture_size,
                       .variants = 2,
                       .contrast = contrast},
                      seed);
  };
  CorridorLooks l;
  l.floor = surface("office carpet", Pattern::kCarpet, {{0.20F, 0.24F, 0.30F}, {0.50F, 0.55F, 0.60F}}, 1.5, 0.12);
  l.wall = surface("office wall", Pattern::kPaint, {{0.70F, 0.69F, 0.66F}, {0.95F, 0.94F, 0.90F}}, 2.0, 0.05);
  l.ceiling = surface("ceiling tiles", Pattern::kTiles, {{0.52F, 0.52F, 0.51F}, {0.97F, 0.97F, 0.95F}}, 2.4, 0.09);
  l.office = AddOfficeMaterials(world, config.texture_size, seed);
  l.skirting = AddPlainMaterial(world, "skirting", {0.34F, 0.33F, 0.32F});
  return l;
}

/// A side of the corridor: y of its wall, and where into the corridor lies.
double WallOf(double side) { return side * 0.5 * kSize.y(); }

/// Doors, skirting, switches and posters: nothing here stands out by more than 8 cm.
void AddOnWalls(World& world, const CorridorLooks& looks, RandomStream& random) {
  constexpr double kDoor = 0.8;
  int number = 0;
  for (const double side : {-1.0, 1.0}) {
    const std::string which = side < 0.0 ? "south" : "north";
    const double shift = random.Uniform(-0.4, 0.4);
    for (const double x : {-1.5 + shift, 1.5 + shift}) {
      const std::string name = "door" + std::to_string(number);
      AddDoorFrame(world, name + "/frame", {x - 0.5 * kDoor, x + 0.5 * kDoor, 0.0, 2.06}, 0.06, 0.1,
                   Standing(0.0, WallOf(side), 0.0), looks.office.steel);
      AddDoorLeaf(world, looks.office, name, Standing(x - 0.5 * kDoor + 0.005, WallOf(side) - side * 0.01, 0.0),
                  kDoor - 0.01, 2.05, number == 2);
      AddBox(world, name + "/plate", {0.16, 0.008, 0.12}, Standing(x + 0.66, WallOf(side) - side * 0.005, 1.55),
             looks.office.paper, 0.3, SemanticClass::kWall);
      ++number;
    }
    const double picture = shift + random.Uniform(-0.3, 0.3);
    AddBox(world, "poster_" + which, {random.Uniform(0.5, 0.7), 0.012, random.Uniform(0.7, 0.9)},
           Standing(picture, WallOf(side) - side * 0.007, 1.5), looks.office.poster, 0.9, SemanticClass::kWall);
    // Skirting between the doors' frames.
    double from = -0.5 * kSize.x();
    for (const double to : {-1.5 + shift - 0.5 * kDoor - 0.06, 1.5 + shift - 0.5 * kDoor - 0.06, 0.5 * kSize.x()}) {
      AddBox(world, "skirting_" + which + std::to_string(number++), {to - from, 0.012, 0.08},
             Standing(0.5 * (from + to), WallOf(side) - side * 0.006, 0.04), looks.skirting, 1.0, SemanticClass::kWall);
      from = to + kDoor + 0.12;
    }
    number = 2;
  }
  AddBox(world, "notice_board", {0.02, 1.0, 0.7}, Standing(-0.5 * kSize.x() + 0.01, 0.1, 1.5), looks.office.door, 1.2,
         SemanticClass::kWall);
  for (int i = 0; i < 5; ++i) {
    AddBox(world, "notice" + std::to_string(i), {0.006, random.Uniform(0.12, 0.21), random.Uniform(0.15, 0.28)},
           Standing(-0.5 * kSize.x() + 0.023, -0.28 + 0.19 * i, 1.5 + random.Uniform(-0.15, 0.15)), looks.office.paper,
           0.3, SemanticClass::kWall);
  }
}

/// Things along the walls; what stands opposite keeps 0.75 m along the corridor.
void AddThings(World& world, const CorridorLooks& looks, const OfficeConfig& config, RandomStream& random) {
  std::vector<std::pair<double, double>> taken{{kStart, kPadRadius + 0.15}, {kTarget, 0.05}};
  const std::uint64_t first = random.Index(5);
  for (int i = 0; i < config.things; ++i) {
    const std::uint64_t kind = (first + static_cast<std::uint64_t>(i)) % 5;
    const double half = std::array{0.4, 0.16, 0.18, 0.32, 0.2}[kind];
    const double side = random.Index(2) == 0 ? -1.0 : 1.0;
    const double yaw = -side * 0.5 * kPi;  // looks into the corridor
    for (int k = 0; k < 60; ++k) {
      const double x = random.Uniform(-1.0, 1.0) * (0.5 * kSize.x() - half - 0.05);
      if (std::any_of(taken.begin(), taken.end(),
                      [&](const auto& t) { return std::abs(x - t.first) < half + t.second + kOfficePassage; })) {
        continue;
      }
      taken.emplace_back(x, half);
      const std::string name = "thing" + std::to_string(i);
      const auto from_wall = [&](double out) { return Standing(x, WallOf(side) - side * out, 0.0, yaw); };
      if (kind == 0) AddCupboard(world, looks.office, name, from_wall(0.08), {0.36, 0.8, random.Uniform(1.2, 1.9)});
      if (kind == 1) AddBin(world, looks.office, name, from_wall(0.26));
      if (kind == 2) AddPottedPlant(world, looks.office, name, from_wall(0.3), random);
      if (kind == 3) AddOfficeChair(world, looks.office, name, from_wall(0.42));
      if (kind == 4) {
        AddBox(world, name + "/0", {0.3, 0.38, 0.3}, from_wall(0.27) * Standing(0.0, 0.0, 0.15), looks.office.door,
               1.1);
        AddBox(world, name + "/1", {0.26, 0.3, 0.22}, from_wall(0.26) * Standing(0.0, 0.02, 0.41, 0.2),
               looks.office.paper, 0.8);
      }
      break;
    }
  }
}

RoomLight AddLamps(World& world, const CorridorLooks& looks) {
  for (int i = 0; i < 3; ++i) {
    const std::size_t panel = AddBox(world, "lamp" + std::to_string(i), {0.6, 0.6, 0.05},
                                     Standing(-2.0 + 2.0 * i, 0.0, kSize.z() - 0.025), looks.office.white, 1.0);
    world.objects[panel].casts_shadow = false;
  }
  RoomLight light;
  light.daylight = 0.12;
  light.overhead = 0.20;
  light.scattered = 0.78;
  light.to_overhead = {0.22, 0.12, 1.0};
  light.emergency = {{.position = {-0.5 * kSize.x() + kLampRadius, 0.0, 2.35},
                      .intensity = 0.12,
                      .colour = {0.5, 1.0, 0.6},
                      .range = 8.0}};
  return light;
}

}  // namespace

void Describe(base::Description& d, OfficeConfig& c) {
  d.Field("things", c.things, {.meaning = "cupboard, bin, plant, chair, boxes, at most", .min = 0, .max = 8});
  DescribeTextureSize(d, c.texture_size);
  d.Field("light", c.light, {.meaning = "hour and lamps"});
}

World MakeWorld(const OfficeConfig& config, std::uint64_t seed) {
  World world;
  world.name = "office";
  const CorridorLooks looks = AddLooks(world, config, seed);
  RandomStream office(seed, "world/office");
  RandomStream masonry(seed, "world/masonry");
  ShellConfig shell{.size = kSize, .thickness = 0.15};
  shell.east = {{-0.45, 0.45, 0.95, 2.15}};
  AddShell(world, shell, looks.floor, looks.wall, looks.ceiling, masonry);
  AddOnWalls(world, looks, office);
  AddPad(world, looks.office.pad, {kStart, 0.0}, kPadRadius);
  AddThings(world, looks, config, office);
  const RoomLight light = AddLamps(world, looks);
  AddEmergencyLamps(world, light, looks.office.white);
  world.light = MakeLight(config.light, light);
  world.X_WB_start = Standing(kStart, 0.0, kPadHeight, office.Uniform(-0.1, 0.1));
  world.target = {kTarget, 0.0, 1.0};
  world.bounds_low = {-0.5 * kSize.x(), -0.5 * kSize.y(), 0.0};
  world.bounds_high = {0.5 * kSize.x(), 0.5 * kSize.y(), kSize.z() - 0.05};
  return world;
}

}  // namespace alula::worlds

#include "worlds/indoor/machine_hall.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "worlds/furniture.h"
#include "worlds/kit/machinery.h"
#include "worlds/kit/room.h"
#include "worlds/textures.h"

namespace alula::worlds {
namespace {

using base::Quat;
using base::RandomStream;
using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kPi = std::numbers::pi;
const Vec3 kSize(26.0, 15.0, 8.5);  // m
constexpr double kBay = 5.2;        // m, between columns
constexpr double kGallery = 3.2;    // m, height of the gallery along the north wall
constexpr double kGalleryDepth = 2.0;
constexpr double kAisle = 1.6;  // m, half its width about y = 0, where nothing stands
const Vec2 kStart(-11.0, 0.0);
const Vec3 kTarget(10.5, 0.0, 1.6);

struct HallLooks {
  Surface floor, wall, ceiling;
  int pad = 0, yellow = 0;
  MachineLooks machine;
};

HallLooks AddLooks(World& world, const MachineHallConfig& config, std::uint64_t seed) {
  const auto surface = [&](const char* name, Pattern pattern, const Palette& palette, double period, double contrast) {
    return AddSurface(world, name,
                      {.pattern = pattern,
                       .palette = palette,
                       .period = period,
                       .size = config.texture_size,
                       .variants = 3,
                       .contrast = contrast},
                      seed);
  };
  HallLooks l;
  l.floor = surface("hall floor", Pattern::kAsphalt, {{0.30F, 0.31F, 0.30F}, {0.66F, 0.67F, 0.65F}}, 3.6, 0.15);
  l.wall = config.bare_walls
               ? surface("white wall", Pattern::kPaint, {{0.84F, 0.84F, 0.83F}, {0.97F, 0.97F, 0.96F}}, 4.2, 0.02)
               : surface("hall wall", Pattern::kConcrete, {{0.38F, 0.38F, 0.36F}, {0.82F, 0.81F, 0.77F}}, 4.2, 0.12);
  l.ceiling = surface("hall roof", Pattern::kMetal, {{0.22F, 0.23F, 0.24F}, {0.52F, 0.53F, 0.54F}}, 5.2, 0.10);
  l.pad = AddMaterial(world, "pad",
                      {.pattern = Pattern::kPad,
                       .palette = {{0.06F, 0.08F, 0.10F}, {0.95F, 0.93F, 0.85F}},
                       .size = std::max(16, config.texture_size / 2)},
                      seed);
  l.machine = AddMachineMaterials(world, config.texture_size, seed);
  l.yellow = AddMaterial(world, "floor marking",
                         {.pattern = Pattern::kPlaster,
                          .palette = {{0.52F, 0.44F, 0.12F}, {0.92F, 0.80F, 0.26F}},
                          .size = std::max(16, config.texture_size / 4),
                          .contrast = 0.14},
                         seed);
  return l;
}

std::vector<Opening> Windows() {
  std::vector<Opening> windows;
  for (double x = -2.0 * kBay; x < 2.5 * kBay; x += kBay) windows.push_back({x - 1.7, x + 1.7, 5.4, 7.0});
  return windows;
}

/// Columns along the long walls, girders from one to the other, crane rails and the crane.
void AddFrame(World& world, const HallLooks& looks, RandomStream& random) {
  const int steel = looks.machine.rust;
  const double y = 0.5 * kSize.y() - 0.22;
  const std::size_t first = world.objects.size();
  int bay = 0;
  for (double x = -2.5 * kBay + 0.4; x < 0.5 * kSize.x(); x += (5.0 * kBay - 0.8) / 5.0, ++bay) {
    const std::string n = std::to_string(bay);
    for (const double side : {-1.0, 1.0}) {
      AddGirder(world, (side < 0.0 ? "column_s" : "column_n") + n, {x, side * y, 0.0}, {x, side * y, kSize.z()}, 0.3,
                0.3, steel);
    }
    AddGirder(world, "girder" + n, {x, -y + 0.16, kSize.z() - 0.35}, {x, y - 0.16, kSize.z() - 0.35}, 0.6, 0.26, steel);
  }
  for (const double side : {-1.0, 1.0}) {
    AddGirder(world, side < 0.0 ? "rail_s" : "rail_n", {-0.5 * kSize.x() + 0.1, side * (y - 0.35), 7.2},
              {0.5 * kSize.x() - 0.1, side * (y - 0.35), 7.2}, 0.4, 0.22, looks.machine.steel);
  }
  const double x = random.Uniform(-7.0, 8.0);
  AddGirder(world, "crane", {x, -y + 0.2, 7.72}, {x, y - 0.2, 7.72}, 0.6, 0.4, looks.machine.hazard);
  const double trolley = random.Uniform(2.0, 4.5);
  AddBox(world, "trolley", {0.9, 1.0, 0.5}, Standing(x, trolley, 7.16), looks.machine.steel, 1.4);
  AddObject(world, "rope", geometry::Cylinder{0.02, 0.75}, Standing(x, trolley, 6.2), looks.machine.dark, 1.0);
  AddObject(world, "hook", geometry::Sphere{0.16}, Standing(x, trolley, 5.4), looks.machine.hazard, 0.6);
  // The lamps hang below all of this.
  for (std::size_t i = first; i < world.objects.size(); ++i) world.objects[i].casts_shadow = false;
}

/// A gallery of gratings on brackets along the north wall, with a railing and stairs down at its west end.
void AddGallery(World& world, const HallLooks& looks) {
  const MachineLooks& m = looks.machine;
  const double wall = 0.5 * kSize.y() - 0.5;  // in front of the columns
  const double y = wall - 0.5 * kGalleryDepth;
  const double west = -7.8;
  const double east = 0.5 * kSize.x() - 0.5;
  int panel = 0;
  constexpr double kPanel = 1.5;
  for (double x = west; x + kPanel <= east + 1e-9; x += kPanel, ++panel) {
    const std::string n = std::to_string(panel);
    AddGrating(world, "grating" + n, Standing(x + 0.5 * kPanel, y, kGallery), {kPanel - 0.02, kGalleryDepth}, m.steel);
    if (panel % 2 == 0) {
      AddGirder(world, "bracket" + n, {x + 0.02, wall + 0.5, kGallery - 0.14},
                {x + 0.02, wall - kGalleryDepth, kGallery - 0.14}, 0.2, 0.1, m.rust);
    }
  }
  const double end = west + panel * kPanel;
  AddGirder(world, "gallery_edge", {west, y - 0.5 * kGalleryDepth - 0.06, kGallery - 0.12},
            {end, y - 0.5 * kGalleryDepth - 0.06, kGallery - 0.12}, 0.24, 0.1, m.rust);
  AddRailing(world, "gallery_rail", Standing(0.5 * (west + end), y - 0.5 * kGalleryDepth - 0.05, kGallery), end - west,
             m.hazard);
  for (int post = 0; post < 4; ++post) {
    AddObject(
        world, "gallery_post" + std::to_string(post), geometry::Cylinder{0.07, 0.5 * (kGallery - 0.24)},
        Standing(west + 0.4 + (end - west - 0.8) * post / 3.0, y - 0.5 * kGalleryDepth - 0.06, 0.5 * (kGallery - 0.24)),
        m.rust, 1.4);
  }
  constexpr int kSteps = 14;  // up from the west
  for (int i = 0; i < kSteps; ++i) {
    const double z = kGallery * (i + 1) / (kSteps + 1);
    AddBox(world, "stair/step" + std::to_string(i), {0.26, 0.9, 0.03},
           Standing(west - 0.2 * (kSteps - i) - 0.02, y, z - 0.015), m.steel, 0.8);
  }
  const double run = 0.2 * kSteps + 0.3;
  for (const double side : {-0.47, 0.47}) {
    const double pitch = std::atan2(kGallery - 0.06, run);
    AddBox(world, side < 0.0 ? "stair/right" : "stair/left", {std::hypot(run, kGallery - 0.06), 0.03, 0.24},
           {base::Exp(Vec3(0.0, -pitch, 0.0)), {west - 0.5 * run, y + side, 0.5 * kGallery - 0.06}}, m.rust, 1.2);
  }
}

/// Pipe runs along the walls, each with a drop to the floor.
void AddPipes(World& world, const HallLooks& looks, const MachineHallConfig& config, RandomStream& random) {
  const MachineLooks& m = looks.machine;
  const std::array kinds{m.pipe, m.lagging, m.green, m.rust};
  for (int i = 0; i < config.pipe_runs; ++i) {
    const bool south = i % 2 == 0;
    const double radius = random.Uniform(0.06, 0.19);
    // Rows above each other, so that no two runs meet.
    const double z = (south ? 2.5 : 4.5) + 0.62 * (i / 2) + random.Uniform(0.0, 0.12);
    const double y = (south ? -1.0 : 1.0) * (0.5 * kSize.y() - 0.42 - 0.2);
    const double from = -0.5 * kSize.x() + 0.3 + radius + 0.45 * (i / 2);
    const double to = 0.5 * kSize.x() - 0.6 - random.Uniform(0.0, 6.0) - 0.45 * (i / 2);
    std::vector<Vec3> points;
    if (south) points.push_back({from, y, 0.0});
    points.push_back({from, y, z});
    points.push_back({to, y, z});
    points.push_back({to, y, south ? 0.0 : kSize.z()});
    if (!south) points.insert(points.begin(), {from, y, kSize.z()});
    AddPipe(world, "pipe" + std::to_string(i), points, radius, kinds[random.Index(kinds.size())], m.steel);
  }
}

void AddFloorMarkings(World& world, const HallLooks& looks) {
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 6; ++i) {
      AddBox(world, std::string(side < 0.0 ? "line_s" : "line_n") + std::to_string(i), {3.9, 0.1, 0.004},
             Standing(-0.5 * kSize.x() + 2.4 + 4.2 * i, side * (kAisle + 0.05), 0.002), looks.yellow, 1.3,
             SemanticClass::kGround);
    }
  }
}

/// Which stretches along x of one side of the aisle are taken.
class Side {
 public:
  bool Take(double x, double half) {
    if (std::abs(x) + half > 0.5 * kSize.x() - 1.0) return false;
    for (const auto& [other, other_half] : taken_) {
      if (std::abs(x - other) < half + other_half + 0.9) return false;
    }
    taken_.emplace_back(x, half);
    return true;
  }
  bool Draw(double half, RandomStream& random, double& x) {
    for (int i = 0; i < 60; ++i) {
      x = random.Uniform(-0.5, 0.5) * kSize.x();
      if (Take(x, half)) return true;
    }
    return false;
  }

 private:
  std::vector<std::pair<double, double>> taken_;
};

/// Machines, tanks, cabinets, drums and crates on both sides of the aisle. North of it, things stay below the gallery.
void AddThings(World& world, const HallLooks& looks, const MachineHallConfig& config, RandomStream& random) {
  const MachineLooks& m = looks.machine;
  std::array<Side, 2> machines;  // south, north of the aisle
  std::array<Side, 2> walls;     // along the walls
  double x = 0.0;
  walls[1].Take(-9.3, 1.8);  // the stairs
  for (int i = 0; i < config.machines; ++i) {
    const std::size_t side = static_cast<std::size_t>(i) % 2;
    const double length = random.Uniform(3.4, 4.8);
    if (!machines[side].Draw(0.5 * length, random, x)) continue;
    AddMachine(world, m, "machine" + std::to_string(i),
               Standing(x, (side == 0 ? -1.0 : 1.0) * (kAisle + 1.3), 0.0, random.Index(2) == 0 ? 0.0 : kPi), length,
               random);
  }
  for (int i = 0; i < config.tanks; ++i) {
    const std::size_t side = i % 3 == 2 ? 1 : 0;
    const double radius = random.Uniform(0.55, 0.9);
    if (!walls[side].Draw(1.2 * radius, random, x)) continue;
    const double height = side == 1 ? random.Uniform(2.2, 2.6) : random.Uniform(2.6, 4.6);
    const double y = (side == 0 ? -1.0 : 1.0) * (0.5 * kSize.y() - 1.95);
    AddTank(world, m, "tank" + std::to_string(i), Standing(x, y, 0.0, random.Uniform(-kPi, kPi)), radius, height,
            random);
  }
  for (int i = 0; i < config.clutter; ++i) {
    const std::string name = "clutter" + std::to_string(i);
    const std::size_t side = random.Index(2);
    const double yaw = random.Uniform(-kPi, kPi);
    const double out = side == 0 ? -1.0 : 1.0;
    if (i % 4 == 0) {
      const int count = 1 + static_cast<int>(random.Index(3));
      if (!walls[side].Draw(0.4 * count, random, x)) continue;
      AddCabinets(world, m, name, Standing(x, out * (0.5 * kSize.y() - 1.25), 0.0, -out * 0.5 * kPi), count, random);
    } else if (i % 4 == 1) {
      if (!walls[side].Draw(0.4, random, x)) continue;
      Looks crates;
      crates.wood = m.crate;
      AddCrates(world, crates, name, {{x, out * (0.5 * kSize.y() - 1.7)}, 0.5}, 2, random);
    } else {
      if (!machines[side].Draw(0.35, random, x)) continue;
      AddDrum(world, m, name, Standing(x, out * (kAisle + 0.9 + random.Uniform(0.0, 0.6)), 0.0, yaw), random);
    }
  }
}

/// Lamps under the girders, and what the hall's light is: it does not reach beneath the gallery and the tanks.
RoomLight AddLamps(World& world, const HallLooks& looks, const MachineHallConfig& config, RandomStream& random) {
  RoomLight light;
  light.daylight = 0.22;
  light.overhead = 0.26;
  light.scattered = config.bare_walls ? 0.50 : 0.36;
  light.to_overhead = {random.Uniform(-0.3, 0.3), -0.45, 1.0};
  const std::size_t first = world.objects.size();
  for (int i = 0; i < 8; ++i) {
    const Vec3 p(-9.0 + 6.0 * (i / 2), i % 2 == 0 ? -3.0 : 3.0, kSize.z() - 1.2);
    const std::string name = "lamp" + std::to_string(i);
    AddObject(world, name + "/shade", geometry::Cone{0.34, 0.14}, Standing(p.x(), p.y(), p.z() + 0.2),
              looks.machine.green, 1.0);
    AddObject(world, name + "/stem", geometry::Cylinder{0.02, 0.44}, Standing(p.x(), p.y(), p.z() + 0.76),
              looks.machine.dark, 1.0);
    AddObject(world, name + "/bulb", geometry::Sphere{0.11}, Standing(p.x(), p.y(), p.z() + 0.03), looks.machine.white,
              1.0);
  }
  for (std::size_t i = first; i < world.objects.size(); ++i) world.objects[i].casts_shadow = false;
  light.emergency = {{.position = {-0.5 * kSize.x() + kLampRadius, 2.0, 3.0}, .intensity = 0.7, .range = 14.0},
                     {.position = {0.5 * kSize.x() - kLampRadius, -2.0, 3.0}, .intensity = 0.7, .range = 14.0},
                     {.position = {0.0, -0.5 * kSize.y() + kLampRadius, 3.4}, .intensity = 0.5, .range = 12.0}};
  return light;
}

}  // namespace

void Describe(base::Description& d, MachineHallConfig& c) {
  d.Field("machines", c.machines, {.meaning = "large machines along the aisle, at most", .min = 0, .max = 8});
  d.Field("tanks", c.tanks, {.meaning = "tanks, at most", .min = 0, .max = 16});
  d.Field("pipe_runs", c.pipe_runs, {.meaning = "pipes along the walls", .min = 0, .max = 8});
  d.Field("clutter", c.clutter, {.meaning = "drums, crates and cabinets, at most", .min = 0, .max = 40});
  d.Field("bare_walls", c.bare_walls, {.meaning = "white walls without pipes"});
  DescribeTextureSize(d, c.texture_size);
  d.Field("light", c.light, {.meaning = "hour and lamps"});
}

World MakeWorld(const MachineHallConfig& config, std::uint64_t seed) {
  World world;
  world.name = "machine_hall";
  const HallLooks looks = AddLooks(world, config, seed);
  RandomStream hall(seed, "world/hall");
  RandomStream masonry(seed, "world/masonry");
  ShellConfig shell{.size = kSize, .thickness = 0.4};
  shell.south = Windows();
  AddShell(world, shell, looks.floor, looks.wall, looks.ceiling, masonry);
  AddFrame(world, looks, hall);
  AddGallery(world, looks);
  if (!config.bare_walls) AddPipes(world, looks, config, hall);
  AddFloorMarkings(world, looks);
  AddPad(world, looks.pad, kStart, 0.8);
  RandomStream things(seed, "world/things");
  AddThings(world, looks, config, things);
  const RoomLight light = AddLamps(world, looks, config, hall);
  AddEmergencyLamps(world, light, looks.machine.white);
  world.light = MakeLight(config.light, light);
  world.X_WB_start = Standing(kStart.x(), kStart.y(), kPadHeight, things.Uniform(-0.3, 0.3));
  world.target = kTarget;
  world.bounds_low = {-0.5 * kSize.x(), -0.5 * kSize.y(), 0.0};
  world.bounds_high = {0.5 * kSize.x(), 0.5 * kSize.y(), kSize.z() - 0.1};
  return world;
}

}  // namespace alula::worlds

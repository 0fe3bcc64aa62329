#include "worlds/indoor/vicon_room.h"

#include <array>
#include <cmath>
#include <numbers>

#include "worlds/furniture.h"
#include "worlds/indoor/prints.h"
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
const Vec3 kSize(8.4, 8.0, 4.0);  // m
const Vec2 kStart(-2.8, -2.6);
const Vec2 kTarget(2.7, 2.5);
constexpr double kPadRadius = 0.45;   // m
constexpr double kTapeLength = 1.36;  // m, of a strip
constexpr double kTapeWidth = 0.085;
constexpr double kWay = 1.0;  // m, between things that stand

struct RoomLooks {
  Surface carpet, wall, ceiling;
  int foam = 0, curtain = 0, cloth = 0, card = 0, board = 0, wood = 0, metal = 0, dark = 0, white = 0, pad = 0;
  std::array<int, 3> rugs{};
  int tape = 0, tags = 0, checkers = 0;
};

RoomLooks AddLooks(World& world, const ViconRoomConfig& config, std::uint64_t seed) {
  const int small = std::max(16, config.texture_size / 2);
  const auto surface = [&](const char* name, Pattern pattern, const Palette& palette, double period, double contrast,
                           int variants) {
    return AddSurface(world, name,
                      {.pattern = pattern,
                       .palette = palette,
                       .period = period,
                       .size = config.texture_size,
                       .variants = variants,
                       .contrast = contrast},
                      seed);
  };
  const auto material = [&](const char* name, Pattern pattern, const Palette& palette, double contrast) {
    return AddMaterial(world, name, {.pattern = pattern, .palette = palette, .size = small, .contrast = contrast},
                       seed);
  };
  RoomLooks l;
  l.carpet = surface("carpet", Pattern::kCarpet, {{0.22F, 0.23F, 0.24F}, {0.52F, 0.54F, 0.54F}}, 2.1, 0.13, 3);
  const Palette white = config.bare_walls ? Palette{{0.86F, 0.86F, 0.85F}, {0.97F, 0.97F, 0.96F}}
                                          : Palette{{0.74F, 0.74F, 0.72F}, {0.97F, 0.97F, 0.95F}};
  l.wall = surface("white wall", Pattern::kPaint, white, 2.7, 0.05, config.bare_walls ? 1 : 2);
  l.ceiling = surface("ceiling", Pattern::kTiles, {{0.62F, 0.62F, 0.60F}, {0.95F, 0.95F, 0.93F}}, 4.2, 0.04, 1);
  l.foam = AddQuilt(world, "mat", config.texture_size, seed);
  l.cloth = material("mat's top", Pattern::kCarpet, {{0.38F, 0.41F, 0.43F}, {0.66F, 0.69F, 0.70F}}, 0.12);
  l.curtain = material("curtain", Pattern::kCarpet, {{0.40F, 0.40F, 0.41F}, {0.72F, 0.72F, 0.72F}}, 0.10);
  l.card = material("cardboard", Pattern::kPlaster, {{0.46F, 0.36F, 0.25F}, {0.76F, 0.63F, 0.47F}}, 0.12);
  l.board = material("wood board", Pattern::kWood, {{0.22F, 0.19F, 0.16F}, {0.74F, 0.70F, 0.64F}}, 0.24);
  l.wood = material("wood", Pattern::kWood, {{0.42F, 0.31F, 0.20F}, {0.80F, 0.66F, 0.47F}}, 0.14);
  l.metal = material("metal", Pattern::kMetal, {{0.48F, 0.49F, 0.50F}, {0.86F, 0.87F, 0.88F}}, 0.10);
  l.tape = AddSpeckTape(world, "tape with specks", 2 * config.texture_size, kTapeLength / kTapeWidth, seed);
  l.tags = AddTagGrid(world, "tag grid", 2 * config.texture_size, seed);
  l.checkers = AddCheckerboard(world, "checkerboard", config.texture_size, 7, 10);
  l.pad = material("pad", Pattern::kPad, {{0.06F, 0.08F, 0.10F}, {0.95F, 0.93F, 0.85F}}, kFullContrast);
  for (std::size_t i = 0; i < l.rugs.size(); ++i) {
    l.rugs[i] = AddPlayRug(world, "rug" + std::to_string(i), 2 * config.texture_size, seed);
  }
  l.dark = AddPlainMaterial(world, "black", {0.06F, 0.06F, 0.07F});
  l.white = AddPlainMaterial(world, "white", {0.95F, 0.95F, 0.94F});
  return l;
}

struct Window {
  int wall;  // 0 east, 1 north, 2 west, 3 south
  Opening opening;
};

/// Two or three windows in the north wall and one in the east one.
std::vector<Window> DrawWindows(RandomStream& random) {
  std::vector<Window> windows;
  const double shift = random.Uniform(-0.35, 0.35);
  for (const double x : {-2.7, 0.0, 2.7}) {
    windows.push_back({1, {x + shift - 0.65, x + shift + 0.65, 1.25, 2.95}});
  }
  const double x = random.Uniform(-1.6, 1.6);
  windows.push_back({0, {x - 0.65, x + 0.65, 1.25, 2.95}});
  return windows;
}

/// Frame of a wall's inner face: x along it as its openings count, y into the room, z up.
Transform WallFrame(int wall) {
  const double out = wall % 2 == 0 ? 0.5 * kSize.x() : 0.5 * kSize.y();
  const double yaw = 0.5 * kPi * wall;  // where it lies
  const Vec3 p = base::FromYaw(yaw) * Vec3(out, 0.0, 0.0);
  return {base::FromYaw(yaw + 0.5 * kPi), p};
}
Transform At(const Vec3& p) { return {Quat::Identity(), p}; }

/// Sill, bars and a curtain on both sides.
void AddWindowParts(World& world, const RoomLooks& looks, const std::string& name, const Window& window,
                    RandomStream& random) {
  const Transform X_WL = WallFrame(window.wall);
  const Opening& o = window.opening;
  const double middle = 0.5 * (o.x_low + o.x_high);
  AddBox(world, name + "/bar", {0.05, 0.05, o.z_high - o.z_low}, X_WL * At({middle, -0.15, 0.5 * (o.z_low + o.z_high)}),
         looks.white, 1.0);
  AddBox(world, name + "/rail", {o.x_high - o.x_low, 0.05, 0.05}, X_WL * At({middle, -0.15, o.z_low + 0.62 * 1.7}),
         looks.white, 1.0);
  AddBox(world, name + "/sill", {o.x_high - o.x_low + 0.16, 0.14, 0.04}, X_WL * At({middle, 0.07, o.z_low - 0.02}),
         looks.white, 1.0);
  const double drawn = random.Uniform(0.25, 0.55);  // width of a curtain
  for (const double side : {-1.0, 1.0}) {
    const double x = side < 0.0 ? o.x_low - 0.08 : o.x_high + 0.08;
    for (int fold = 0; fold < 5; ++fold) {  // folds: half-sunk columns side by side
      const double along = x - side * (fold - 1.0) * drawn / 5.0;
      AddObject(world, name + (side < 0.0 ? "/left" : "/right") + std::to_string(fold),
                geometry::Cylinder{0.5 * drawn / 5.0 * 1.15, 1.25},
                X_WL * At({along, 0.17 + 0.02 * (fold % 2), 1.25 + 0.55}), looks.curtain, 1.3);
    }
  }
  AddObject(world, name + "/rod", geometry::Cylinder{0.02, 1.05},
            X_WL * Transform{base::Exp(Vec3(0.0, 0.5 * kPi, 0.0)), {middle, 0.15, 3.07}}, looks.metal, 1.0);
}

/// Gym mats that lean on a wall side by side, but not before windows' middles.
void AddLeaningMats(World& world, const RoomLooks& looks, const std::vector<Window>& windows, RandomStream& random) {
  constexpr double kThick = 0.09;
  int number = 0;
  for (int wall = 0; wall < 4; ++wall) {
    const Transform X_WL = WallFrame(wall);
    const double half = 0.5 * (wall % 2 == 0 ? kSize.y() : kSize.x()) - 0.35;
    double x = -half + random.Uniform(0.0, 0.5);
    while (x < half - 1.0) {
      const bool tall = random.Index(3) == 0;
      const double width = std::min(tall ? random.Uniform(0.9, 1.1) : random.Uniform(1.6, 2.1), half - x);
      bool lit = false;
      for (const Window& w : windows) {
        lit = lit || (w.wall == wall && x < w.opening.x_high + 0.5 && x + width > w.opening.x_low - 0.5);
      }
      const double length = lit ? 0.95 : tall ? random.Uniform(1.9, 2.3) : random.Uniform(0.95, 1.15);
      const double lean = random.Uniform(0.12, 0.22);  // rad
      // Its foot stands on the carpet and its upper edge touches the wall.
      const Vec3 middle(x + 0.5 * width, 0.5 * length * std::sin(lean) + 0.5 * kThick * std::cos(lean) + 0.002,
                        0.5 * length * std::cos(lean) + 0.5 * kThick * std::sin(lean));
      if (random.Index(4) != 0) {
        AddBox(world, "mat" + std::to_string(number++), {width - 0.03, kThick, length},
               X_WL * Transform{base::Exp(Vec3(lean, 0.0, 0.0)), middle}, looks.foam, random.Uniform(1.1, 1.5));
      }
      x += width + random.Uniform(0.0, 0.7);
    }
  }
}

/// What the seed strews over the room: circles that keep clear of start, target and each other.
class Floor {
 public:
  bool Take(const Vec2& p, double radius) {
    if (std::abs(p.x()) + radius > 0.5 * kSize.x() - 0.6 || std::abs(p.y()) + radius > 0.5 * kSize.y() - 0.6) {
      return false;
    }
    if ((p - kStart).norm() < radius + 1.0 || (p - kTarget).norm() < radius + 0.8) return false;
    for (const Footprint& other : taken_) {
      if ((other.centre - p).norm() < other.radius + radius + kWay) return false;
    }
    taken_.push_back({p, radius});
    return true;
  }
  bool Draw(double radius, RandomStream& random, Vec2& p) {
    for (int i = 0; i < 80; ++i) {
      p = {random.Uniform(-0.5, 0.5) * kSize.x(), random.Uniform(-0.5, 0.5) * kSize.y()};
      if (Take(p, radius)) return true;
    }
    return false;
  }

 private:
  std::vector<Footprint> taken_;
};

/// A stack of mats with a calibration target leaning on it, or two boards at an angle.
void AddScreen(World& world, const RoomLooks& looks, const std::string& name, const Vec2& p, int kind,
               RandomStream& random) {
  const Transform X_WS = Standing(p.x(), p.y(), 0.0, random.Uniform(-kPi, kPi));
  if (kind == 0) {
    const int mats = 4 + static_cast<int>(random.Index(3));
    double z = 0.0;
    for (int i = 0; i < mats; ++i) {
      const double thick = random.Uniform(0.13, 0.17);
      AddBox(world, name + "/mat" + std::to_string(i), {random.Uniform(1.02, 1.1), random.Uniform(0.64, 0.7), thick},
             X_WS * Standing(0.0, 0.0, z + 0.5 * thick, random.Uniform(-0.03, 0.03)),
             i + 1 == mats ? looks.cloth : looks.foam, 1.2);
      z += thick;
    }
    // Its foot stands off and its upper edge leans on the stack.
    const Transform X_SF{base::Exp(Vec3(-0.17, 0.0, 0.0)), {random.Uniform(-0.15, 0.15), -0.475, 0.003}};
    AddPrintedBox(world, name + "/target", {0.66, 0.012, 0.66}, X_WS * X_SF * At({0.0, 0.0, 0.33}), 1, looks.tags);
    return;
  }
  const double height = random.Uniform(1.3, 1.9);
  AddBox(world, name + "/board0", {1.0, 0.06, height}, X_WS * Standing(-0.02, 0.0, 0.5 * height, 0.0), looks.cloth,
         1.9);
  AddBox(world, name + "/board1", {0.6, 0.06, height}, X_WS * Standing(-0.55, -0.3, 0.5 * height, 0.5 * kPi),
         looks.foam, 1.9);
  AddBox(world, name + "/post", {0.07, 0.07, height + 0.03}, X_WS * Standing(-0.55, 0.035, 0.5 * height + 0.015),
         looks.dark, 1.0);
}

void AddBoxes(World& world, const RoomLooks& looks, const std::string& name, const Vec2& p, RandomStream& random) {
  const double side = random.Uniform(0.34, 0.5);
  const double low = random.Uniform(0.25, 0.4);
  const Transform X_WS = Standing(p.x(), p.y(), 0.0, random.Uniform(-kPi, kPi));
  AddBox(world, name + "/0", {side, 0.8 * side, low}, X_WS * Standing(0.0, 0.0, 0.5 * low), looks.card, 0.9);
  AddBox(world, name + "/tape", {0.06, 0.8 * side + 0.004, low + 0.002}, X_WS * Standing(0.0, 0.0, 0.5 * low + 0.001),
         looks.white, 0.35);
  if (random.Index(2) == 0) {  // a tool box on it
    AddBox(world, name + "/1", {0.3, 0.2, 0.18}, X_WS * Standing(0.0, 0.0, low + 0.092, 0.4), looks.metal, 0.8);
    AddBox(world, name + "/lid", {0.31, 0.21, 0.06}, X_WS * Standing(0.0, 0.0, low + 0.211, 0.4), looks.dark, 0.8);
    AddObject(world, name + "/grip", geometry::Capsule{0.012, 0.06},
              X_WS * Transform{base::FromYaw(0.4) * base::Exp(Vec3(0.0, 0.5 * kPi, 0.0)), {0.0, 0.0, low + 0.265}},
              looks.dark, 1.0);
  }
}

/// Rugs, strips of tape and sheets of paper: thin, each a little higher than the one before, so that none flickers.
void AddFlatThings(World& world, const RoomLooks& looks, const ViconRoomConfig& config, RandomStream& random) {
  double top = 0.004;
  // A picture fills a thing of its own; plain ones have their colour alone.
  const auto lay = [&](const std::string& name, double length, double width, const Vec2& p, double yaw, int material) {
    AddPrintedBox(world, name, {length, width, top}, Standing(p.x(), p.y(), 0.5 * top, yaw), 2, material,
                  SemanticClass::kGround);
    top += 0.0003;
  };
  const auto place = [&](double rim) {
    for (;;) {
      const Vec2 p(random.Uniform(-1.0, 1.0) * (0.5 * kSize.x() - rim),
                   random.Uniform(-1.0, 1.0) * (0.5 * kSize.y() - rim));
      if ((p - kStart).norm() > rim + kPadRadius) return p;
    }
  };
  for (int i = 0; i < config.rugs; ++i) {
    lay("rug" + std::to_string(i), random.Uniform(1.5, 2.0), random.Uniform(1.0, 1.35), place(1.25),
        random.Uniform(-kPi, kPi), looks.rugs[static_cast<std::size_t>(i) % looks.rugs.size()]);
  }
  for (int i = 0; i < config.strips; ++i) {
    lay("strip" + std::to_string(i), kTapeLength, kTapeWidth, place(1.1), random.Uniform(-kPi, kPi), looks.tape);
  }
  for (int i = 0; i < 2 * config.strips; ++i) {
    lay("paper" + std::to_string(i), random.Uniform(0.05, 0.16), random.Uniform(0.04, 0.1), place(0.3),
        random.Uniform(-kPi, kPi), random.Index(3) == 0 ? looks.dark : looks.white);
  }
}

/// A ladder of two legs and rungs that leans on a wall.
void AddLadder(World& world, const RoomLooks& looks, int wall, double x) {
  constexpr double kLength = 2.6;
  constexpr double kLean = 0.28;  // rad
  const Transform X_WA =
      WallFrame(wall) * Transform{base::Exp(Vec3(kLean, 0.0, 0.0)), {x, kLength * std::sin(kLean) + 0.05, 0.01}};
  for (const double side : {-0.2, 0.2}) {
    AddBox(world, side < 0.0 ? "ladder/left" : "ladder/right", {0.04, 0.06, kLength},
           X_WA * At({side, 0.0, 0.5 * kLength}), looks.metal, 1.0);
  }
  for (int rung = 0; rung < 8; ++rung) {
    AddBox(world, "ladder/rung" + std::to_string(rung), {0.36, 0.05, 0.03}, X_WA * At({0.0, 0.0, 0.3 + 0.28 * rung}),
           looks.metal, 1.0);
  }
}

/// On the walls: a wooden board, motion-capture cameras under the ceiling, a radiator, pictures.
void AddOnWalls(World& world, const RoomLooks& looks, RandomStream& random) {
  const Transform X_WS = WallFrame(3);
  AddBox(world, "board", {2.6, 0.04, 2.1}, X_WS * At({random.Uniform(-1.2, 1.2), 0.022, 1.1}), looks.board, 2.4,
         SemanticClass::kWall);
  const Transform X_WW = WallFrame(2);
  AddBox(world, "radiator", {1.2, 0.1, 0.6}, X_WW * At({random.Uniform(1.6, 2.4), 0.08, 0.45}), looks.curtain, 0.5);
  for (int i = 0; i < 5; ++i) {
    AddBox(world, "picture" + std::to_string(i), {random.Uniform(0.2, 0.6), 0.012, random.Uniform(0.25, 0.5)},
           WallFrame(2 + i % 2) * At({-3.2 + 1.5 * i + random.Uniform(-0.3, 0.3), 0.008, random.Uniform(2.5, 3.1)}),
           i % 2 == 0 ? looks.checkers : looks.dark, 0.7, SemanticClass::kWall);
  }
}

void AddUnderCeiling(World& world, const RoomLooks& looks) {
  for (int i = 0; i < 8; ++i) {  // the motion capture's cameras on a rail around the room
    const double along = (i % 2 == 0 ? -1.0 : 1.0) * 2.4;
    const Transform X_WL = WallFrame(i / 2);
    AddBox(world, "capture" + std::to_string(i), {0.12, 0.16, 0.12}, X_WL * At({along, 0.3, 3.45}), looks.dark, 1.0);
    AddBox(world, "arm" + std::to_string(i), {0.03, 0.3, 0.03}, X_WL * At({along, 0.15, 3.5}), looks.metal, 1.0);
  }
  for (int i = 0; i < 4; ++i) {
    const double x = i % 2 == 0 ? -2.0 : 2.0;
    const double y = i < 2 ? -1.9 : 1.9;
    const std::size_t panel = AddBox(world, "lamp" + std::to_string(i), {1.5, 0.35, 0.08},
                                     Standing(x, y, kSize.z() - 0.04), looks.white, 1.0);
    world.objects[panel].casts_shadow = false;
  }
}

RoomLight LightOf(const ViconRoomConfig& config, RandomStream& random) {
  RoomLight light;
  light.daylight = 0.40 * random.Uniform(0.8, 1.2);
  light.overhead = 0.15;
  light.scattered = config.bare_walls ? 0.85 : 0.75;
  light.to_overhead = {random.Uniform(0.15, 0.35), -random.Uniform(0.3, 0.5), 1.0};
  light.emergency = {{.position = {0.5 * kSize.x() - kLampRadius, -2.6, 2.9}, .intensity = 0.25, .range = 9.0},
                     {.position = {-0.5 * kSize.x() + kLampRadius, 1.5, 2.9}, .intensity = 0.15, .range = 9.0}};
  return light;
}

}  // namespace

void Describe(base::Description& d, ViconRoomConfig& c) {
  d.Field("screens", c.screens, {.meaning = "stacks of mats and upright boards, at most", .min = 0, .max = 8});
  d.Field("boxes", c.boxes, {.meaning = "boxes on the floor, at most", .min = 0, .max = 30});
  d.Field("rugs", c.rugs, {.meaning = "printed rugs", .min = 0, .max = 12});
  d.Field("strips", c.strips, {.meaning = "strips of tape with specks; twice as many papers", .min = 0, .max = 40});
  d.Field("bare_walls", c.bare_walls, {.meaning = "white walls without windows, curtains, mats and pictures"});
  DescribeTextureSize(d, c.texture_size);
  d.Field("light", c.light, {.meaning = "hour and lamps"});
}

World MakeWorld(const ViconRoomConfig& config, std::uint64_t seed) {
  World world;
  world.name = "vicon_room";
  const RoomLooks looks = AddLooks(world, config, seed);
  RandomStream room(seed, "world/room");
  RandomStream masonry(seed, "world/masonry");
  ShellConfig shell{.size = kSize, .thickness = 0.3};
  const std::vector<Window> windows = config.bare_walls ? std::vector<Window>{} : DrawWindows(room);
  for (const Window& w : windows) (w.wall == 0 ? shell.east : shell.north).push_back(w.opening);
  AddShell(world, shell, looks.carpet, looks.wall, looks.ceiling, masonry);
  for (std::size_t i = 0; i < windows.size(); ++i) {
    AddWindowParts(world, looks, "window" + std::to_string(i), windows[i], room);
  }
  AddUnderCeiling(world, looks);
  if (!config.bare_walls) {
    AddLeaningMats(world, looks, windows, room);
    AddOnWalls(world, looks, room);
    AddLadder(world, looks, 1, windows[0].opening.x_high + 0.7);
  }
  RandomStream things(seed, "world/things");
  AddPad(world, looks.pad, kStart, kPadRadius);
  AddFlatThings(world, looks, config, things);
  Floor floor;
  Vec2 p;
  for (int i = 0; i < config.screens; ++i) {
    if (floor.Draw(0.72, things, p)) AddScreen(world, looks, "screen" + std::to_string(i), p, i % 2, things);
  }
  for (int i = 0; i < config.boxes; ++i) {
    if (floor.Draw(0.33, things, p)) AddBoxes(world, looks, "box" + std::to_string(i), p, things);
  }
  const RoomLight light = LightOf(config, room);
  AddEmergencyLamps(world, light, looks.white);
  world.light = MakeLight(config.light, light);
  world.X_WB_start =
      Standing(kStart.x(), kStart.y(), kPadHeight,
               std::atan2(kTarget.y() - kStart.y(), kTarget.x() - kStart.x()) + things.Uniform(-0.3, 0.3));
  world.target = {kTarget.x(), kTarget.y(), 1.3};
  world.bounds_low = {-0.5 * kSize.x(), -0.5 * kSize.y(), 0.0};
  world.bounds_high = {0.5 * kSize.x(), 0.5 * kSize.y(), kSize.z() - 0.1};
  return world;
}

}  // namespace alula::worlds

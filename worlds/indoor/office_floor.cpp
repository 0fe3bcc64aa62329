#include "worlds/indoor/office_floor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "worlds/actors/person.h"
#include "worlds/furniture.h"
#include "worlds/kit/office_furniture.h"
#include "worlds/kit/room.h"
#include "worlds/textures.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kPi = std::numbers::pi;
const Vec3 kSize(20.0, 15.0, 2.8);    // m
constexpr double kCorridor = 0.95;    // m, half its width
constexpr double kPartition = 0.12;   // m
constexpr double kJamb = 0.05;        // m, of a door's frame
constexpr double kDoorHeight = 2.05;  // m
constexpr double kFreeStrip = 3.0;    // m from the corridor's middle: between doors and desks nothing stands
const Vec2 kStart(-9.0, 0.0);

struct FloorLooks {
  Surface carpet, wall, ceiling;
  OfficeLooks office;
};

/// From partition to partition, on the side of y > 0 (side 1) or y < 0 (side −1).
struct Room {
  double side, x_low, x_high;
  double door = 0.0;   // x of its middle
  double width = 0.8;  // clear
  bool glass = false;
  double Middle() const { return 0.5 * (x_low + x_high); }
};

FloorLooks AddLooks(World& world, const OfficeFloorConfig& config, std::uint64_t seed) {
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
  FloorLooks l;
  l.carpet = surface("office carpet", Pattern::kCarpet, {{0.24F, 0.26F, 0.28F}, {0.54F, 0.56F, 0.58F}}, 2.5, 0.12);
  l.wall = surface("office wall", Pattern::kPaint, {{0.70F, 0.69F, 0.66F}, {0.95F, 0.94F, 0.91F}}, 2.8, 0.05);
  l.ceiling = surface("ceiling tiles", Pattern::kTiles, {{0.52F, 0.52F, 0.51F}, {0.97F, 0.97F, 0.95F}}, 4.8, 0.09);
  l.office = AddOfficeMaterials(world, config.texture_size, seed);
  return l;
}

template <typename T>
void Shuffle(std::vector<T>& values, RandomStream& random) {
  for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[random.Index(i)]);
}

std::vector<Room> DrawRooms(const OfficeFloorConfig& config, RandomStream& random) {
  std::vector<Room> rooms;
  for (const double side : {-1.0, 1.0}) {
    const double pitch = kSize.x() / config.rooms;
    double from = -0.5 * kSize.x();
    for (int i = 1; i <= config.rooms; ++i) {
      const double to =
          i == config.rooms ? 0.5 * kSize.x() : -0.5 * kSize.x() + pitch * (i + random.Uniform(-0.1, 0.1));
      rooms.push_back({side, from, to});
      rooms.back().door = std::clamp(0.5 * (from + to) + random.Uniform(-0.3, 0.3) * (to - from), from + 1.2, to - 1.2);
      from = to;
    }
  }
  std::vector<double> widths;
  for (std::size_t i = 0; i < rooms.size(); ++i) widths.push_back(kDoorWidths[i % kDoorWidths.size()]);
  std::vector<std::size_t> order(rooms.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  Shuffle(widths, random);
  Shuffle(order, random);
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    rooms[i].width = widths[i];
    rooms[order[i]].glass = i < static_cast<std::size_t>(config.glass_doors);
  }
  return rooms;
}

/// The corridor's wall on one side, with frames in its doorways and leaves that stand open into the rooms.
void AddCorridorWall(World& world, const FloorLooks& looks, const std::vector<Room>& rooms, double side,
                     RandomStream& masonry, RandomStream& random) {
  const Transform X_WL = Standing(0.0, side * (kCorridor + 0.5 * kPartition), 0.0);
  WallConfig wall{kSize.x(), kSize.z(), kPartition, {}};
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    const Room& room = rooms[i];
    if (room.side != side) continue;
    const double low = room.door - 0.5 * room.width;
    const double high = room.door + 0.5 * room.width;
    wall.openings.push_back({low - kJamb, high + kJamb, 0.0, kDoorHeight + kJamb});
    const std::string name = "door" + std::to_string(i);
    AddDoorFrame(world, name, {low, high, 0.0, kDoorHeight}, kJamb, kPartition + 0.03, X_WL, looks.office.steel);
    const double swing = random.Uniform(1.75, 2.3);  // rad: open wide
    AddDoorLeaf(world, looks.office, name + "/leaf",
                X_WL * Standing(low - 0.03, side * (0.5 * kPartition + 0.05), 0.0, side * swing), room.width - 0.01,
                kDoorHeight - 0.015, room.glass);
    AddBox(world, name + "/plate", {0.2, 0.008, 0.12},
           X_WL * Standing(high + 0.3, -side * (0.5 * kPartition + 0.005), 1.6), looks.office.paper, 0.3,
           SemanticClass::kWall);
    const double left = low - kJamb - room.x_low;
    const double right = room.x_high - high - kJamb;
    const double x = left > right ? room.x_low + 0.5 * left : room.x_high - 0.5 * right;  // mid of the longer stretch
    AddBox(world, name + "/poster", {random.Uniform(0.6, 1.1), 0.014, random.Uniform(0.6, 0.9)},
           X_WL * Standing(x + random.Uniform(-0.2, 0.2), -side * (0.5 * kPartition + 0.008), 1.5), looks.office.poster,
           1.1, SemanticClass::kWall);
    const auto skirting = [&](const char* part, double from, double to) {
      AddBox(world, name + part, {to - from, 0.012, 0.08},
             X_WL * Standing(0.5 * (from + to), -side * (0.5 * kPartition + 0.006), 0.04), looks.office.dark, 1.0,
             SemanticClass::kWall);
    };
    skirting("/skirting0", room.x_low, low - kJamb);
    skirting("/skirting1", high + kJamb, room.x_high);
  }
  AddWall(world, side < 0.0 ? "corridor/south" : "corridor/north", wall, X_WL, looks.wall, masonry);
}

std::vector<Opening> WindowsOf(const std::vector<Room>& rooms, double side) {
  std::vector<Opening> windows;
  for (const Room& room : rooms) {
    if (room.side != side) continue;
    const double quarter = 0.25 * (room.x_high - room.x_low);
    for (const double x : {room.Middle() - quarter, room.Middle() + quarter}) {
      const double along = side > 0.0 ? -x : x;  // an opening's x runs to the left as seen from inside
      windows.push_back({along - 0.8, along + 0.8, 0.95, 2.25});
    }
  }
  return windows;
}

void AddWindowFrames(World& world, const FloorLooks& looks, const std::vector<Opening>& windows, double side) {
  const double y = side * (0.5 * kSize.y() + 0.12);
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const Opening& o = windows[i];
    const double x = (side > 0.0 ? -0.5 : 0.5) * (o.x_low + o.x_high);
    const std::string name = (side > 0.0 ? "window_n" : "window_s") + std::to_string(i);
    AddBox(world, name + "/post", {0.06, 0.06, o.z_high - o.z_low}, Standing(x, y, 0.5 * (o.z_low + o.z_high)),
           looks.office.white, 1.0);
    AddBox(world, name + "/sill", {1.7, 0.2, 0.03}, Standing(x, side * (0.5 * kSize.y() - 0.1), o.z_low - 0.015),
           looks.office.white, 1.0);
  }
}

/// Desks along the windows and an island of four, shelves and a cupboard on the partitions; the strip behind the door
/// stays free.
void Furnish(World& world, const FloorLooks& looks, const std::string& name, const Room& room, RandomStream& random) {
  const OfficeLooks& o = looks.office;
  const double out = room.side * 0.5 * kPi;  // heading to the windows
  const auto at = [&](double x, double from_corridor, double yaw) {
    return Standing(x, room.side * from_corridor, 0.0, yaw);
  };
  const double low = room.x_low + 0.5 * kPartition;
  const double high = room.x_high - 0.5 * kPartition;
  const double inner = 0.5 * kSize.y();
  const int desks = std::clamp(static_cast<int>((high - low - 1.0) / 1.9), 1, 4);
  for (int i = 0; i < desks; ++i) {
    const double x = room.Middle() + (i - 0.5 * (desks - 1)) * 1.9 + random.Uniform(-0.08, 0.08);
    const std::string n = name + "/desk" + std::to_string(i);
    AddDesk(world, o, n, at(x, inner - 0.62, out), random);
    if (random.Index(5) != 0) {
      AddOfficeChair(
          world, o, n + "/chair",
          at(x + random.Uniform(-0.25, 0.25), inner - 1.5 - random.Uniform(0.0, 0.2), out + random.Uniform(-0.9, 0.9)));
    }
  }
  if (high - low > 4.6) {  // an island: two desks face to face
    for (const double face : {-1.0, 1.0}) {
      const std::string n = name + (face < 0.0 ? "/island0" : "/island1");
      const Transform X_WT = at(room.Middle() + face * 0.41, 4.35, face < 0.0 ? 0.0 : kPi);
      AddDesk(world, o, n, X_WT, random);
      AddOfficeChair(world, o, n + "/chair",
                     X_WT * Standing(-0.85, random.Uniform(-0.2, 0.2), 0.0, random.Uniform(-0.6, 0.6)));
    }
  }
  const double shelf = random.Uniform(0.9, 1.6);
  AddShelf(world, o, name + "/shelf", at(low + 0.01, kFreeStrip + 0.5 * shelf + 0.3, 0.0),
           {0.32, shelf, random.Uniform(1.5, 2.1)}, random);
  AddCupboard(world, o, name + "/cupboard", at(high - 0.01, kFreeStrip + 0.75, kPi),
              {0.42, 0.9, random.Uniform(1.0, 1.9)});
  AddPottedPlant(world, o, name + "/plant", at(high - 0.32, kCorridor + kPartition + 0.35, 0.0), random);
  AddBin(world, o, name + "/bin", at(low + 0.3, inner - 2.1, 0.0));
  AddBox(world, name + "/board", {random.Uniform(1.2, 1.8), 0.02, 1.0},
         at(room.door < room.Middle() ? high - 1.5 : low + 1.5, kCorridor + kPartition + 0.012, 0.0) *
             Standing(0.0, 0.0, 1.45),
         random.Index(2) == 0 ? looks.office.poster : o.white, 1.4, SemanticClass::kWall);
}

void AddPartitions(World& world, const FloorLooks& looks, const std::vector<Room>& rooms, RandomStream& masonry) {
  const double length = 0.5 * kSize.y() - kCorridor - kPartition;
  for (std::size_t i = 0; i + 1 < rooms.size(); ++i) {
    if (rooms[i].side != rooms[i + 1].side) continue;
    AddWall(world, "partition" + std::to_string(i), {length, kSize.z(), kPartition, {}},
            Standing(rooms[i].x_high, rooms[i].side * (0.5 * kSize.y() - 0.5 * length), 0.0, 0.5 * kPi), looks.wall,
            masonry);
  }
}

RoomLight AddLamps(World& world, const FloorLooks& looks, const std::vector<Room>& rooms) {
  int number = 0;
  const auto panel = [&](double x, double y) {
    const std::size_t i = AddBox(world, "lamp" + std::to_string(number++), {1.2, 0.6, 0.04},
                                 Standing(x, y, kSize.z() - 0.02), looks.office.white, 1.0);
    world.objects[i].casts_shadow = false;
  };
  for (int i = 0; i < 6; ++i) panel(-8.3 + 3.3 * i, 0.0);
  for (const Room& room : rooms) {
    const double quarter = 0.25 * (room.x_high - room.x_low);
    for (const double y : {2.8, 5.6}) {
      panel(room.Middle() - quarter, room.side * y);
      panel(room.Middle() + quarter, room.side * y);
    }
  }
  RoomLight light;
  light.daylight = 0.30;
  light.overhead = 0.20;
  light.scattered = 0.65;
  light.to_overhead = {0.25, 0.18, 1.0};
  const auto exit_lamp = [](double x, double y) {
    return Lamp{.position = {x, y, kSize.z() - 3.0 * kLampRadius},
                .intensity = 0.18,
                .colour = {0.55, 1.0, 0.65},
                .range = 9.0};
  };
  light.emergency = {exit_lamp(-9.92, 0.0), exit_lamp(0.0, 0.0), exit_lamp(9.92, 0.0)};
  return light;
}

}  // namespace

void Describe(base::Description& d, OfficeFloorConfig& c) {
  d.Field("rooms", c.rooms, {.meaning = "on each side of the corridor", .min = 2, .max = 5});
  d.Field("glass_doors", c.glass_doors, {.meaning = "of the doors: panes of satin glass", .min = 0, .max = 10});
  d.Check("glass_doors", [&c] {
    return c.glass_doors <= 2 * c.rooms ? std::string()
                                        : "must be at most " + std::to_string(2 * c.rooms) + ", one for each room";
  });
  d.Field("people", c.people, {.meaning = "people who walk the corridor", .min = 0, .max = 12});
  d.Field("people_speed", c.people_speed, {.unit = "m/s", .meaning = "their mean speed", .min = 0.1, .max = 3.0});
  d.Field("reactive", c.reactive, {.meaning = "whether they heed the vehicle"});
  DescribeTextureSize(d, c.texture_size);
  d.Field("light", c.light, {.meaning = "hour and lamps"});
}

World MakeWorld(const OfficeFloorConfig& config, std::uint64_t seed) {
  World world;
  world.name = "office_floor";
  const FloorLooks looks = AddLooks(world, config, seed);
  RandomStream plan(seed, "world/floor");
  RandomStream masonry(seed, "world/masonry");
  const std::vector<Room> rooms = DrawRooms(config, plan);
  ShellConfig shell{.size = kSize, .thickness = 0.25};
  shell.north = WindowsOf(rooms, 1.0);
  shell.south = WindowsOf(rooms, -1.0);
  shell.east = {{-0.6, 0.6, 0.95, 2.25}};
  AddShell(world, shell, looks.carpet, looks.wall, looks.ceiling, masonry);
  for (const double side : {-1.0, 1.0}) {
    AddCorridorWall(world, looks, rooms, side, masonry, plan);
    AddWindowFrames(world, looks, WindowsOf(rooms, side), side);
  }
  AddPartitions(world, looks, rooms, masonry);
  RandomStream furniture(seed, "world/furniture");
  for (std::size_t i = 0; i < rooms.size(); ++i) Furnish(world, looks, "room" + std::to_string(i), rooms[i], furniture);
  AddPad(world, looks.office.pad, kStart, 0.4);
  const RoomLight light = AddLamps(world, looks, rooms);
  AddEmergencyLamps(world, light, looks.office.white);
  world.light = MakeLight(config.light, light);
  world.X_WB_start = Standing(kStart.x(), kStart.y(), kPadHeight, plan.Uniform(-0.15, 0.15));
  const Room& last = rooms[plan.Index(2) == 0 ? static_cast<std::size_t>(config.rooms) - 1 : rooms.size() - 1];
  world.target = {last.Middle(), last.side * 2.3, 1.2};
  world.bounds_low = {-0.5 * kSize.x(), -0.5 * kSize.y(), 0.0};
  world.bounds_high = {0.5 * kSize.x(), 0.5 * kSize.y(), kSize.z() - 0.05};
  if (config.people > 0) {
    AddCrowd(world, "person",
             {.count = config.people,
              .speed = config.people_speed,
              .reactive = config.reactive,
              .low = {-9.5, -kCorridor},
              .high = {9.5, kCorridor},
              .room = 0.4,
              .free = {{kStart, 1.2}}},
             seed);
  }
  return world;
}

}  // namespace alula::worlds

#include "worlds/outdoor/powerline.h"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "worlds/furniture.h"
#include "worlds/kit/catenary.h"
#include "worlds/kit/mesh_parts.h"
#include "worlds/kit/pylon.h"
#include "worlds/kit/street.h"
#include "worlds/outdoor/hung_things.h"
#include "worlds/outdoor/site.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kPi = std::numbers::pi;
constexpr int kTowers = 3;
constexpr double kCorridor = 11.0;    // m to each side of the line that is kept free of trees
constexpr double kInsulator = 1.35;   // m, of a string for 110 kV
constexpr double kEarthWire = 0.009;  // m, diameter of a 50 mm² steel wire

/// A wire from tower to tower, and what it is called.
struct Wire {
  std::string name;
  Catenary curve;
  double radius = 0.0;
};

/// In stretches: how thick one is drawn depends on how far it is from the eye.
void AddWire(World& world, int metal, const Wire& wire) {
  constexpr int kStretches = 10;
  constexpr int kPieces = 4;
  for (int stretch = 0; stretch < kStretches; ++stretch) {
    std::vector<TubePoint> line;
    for (int i = 0; i <= kPieces; ++i) {
      line.push_back({wire.curve.At(static_cast<double>(stretch * kPieces + i) / (kStretches * kPieces)), wire.radius});
    }
    auto mesh = std::make_shared<geometry::Mesh>();
    AddTube(*mesh, line, 6, 0.5);
    const std::size_t index = AddObject(world, wire.name + "/" + std::to_string(stretch),
                                        geometry::MeshShape{std::move(mesh)}, {}, metal, 1.0);
    world.objects[index].wire_radius = wire.radius;
  }
}

/// Towers with their insulators; gives the conductors' spans, then the earth wire's.
std::vector<Wire> AddLine(World& world, const PowerlineConfig& config, const Land& land, std::uint64_t seed) {
  const int steel = AddMaterial(world, "steel",
                                {.pattern = Pattern::kSoil,
                                 .palette = {{0.40F, 0.42F, 0.43F}, {0.76F, 0.78F, 0.79F}},
                                 .size = 64,
                                 .contrast = 0.12},
                                seed);
  const int concrete = AddMaterial(world, "concrete",
                                   {.pattern = Pattern::kConcrete,
                                    .palette = {{0.40F, 0.39F, 0.37F}, {0.82F, 0.80F, 0.77F}},
                                    .size = 128,
                                    .contrast = 0.14},
                                   seed);
  const int ceramic = AddPlainMaterial(world, "ceramic", {0.42F, 0.22F, 0.14F});
  const int aluminium = AddPlainMaterial(world, "aluminium", {0.62F, 0.63F, 0.64F});
  const PylonConfig pylon{.height = config.tower_height};
  std::vector<std::vector<Vec3>> ends;  // of the conductors, by tower; the earth wire's last
  for (int tower = 0; tower < kTowers; ++tower) {
    const Transform X{base::Quat::Identity(), land.On({config.span * (tower - 0.5 * (kTowers - 1)), 0.0})};
    const std::string name = "tower" + std::to_string(tower);
    AddPylon(world, steel, concrete, name, X, pylon);
    std::vector<Vec3> hooks;
    for (const Vec3& tip : ArmTips(pylon)) {
      const Vec3 top = X * tip - Vec3(0, 0, 0.03);
      AddInsulator(world, ceramic, name + "/insulator" + std::to_string(hooks.size()), top, kInsulator);
      hooks.push_back(top - Vec3(0, 0, kInsulator));
    }
    hooks.push_back(X * PeakOf(pylon));
    ends.push_back(std::move(hooks));
  }
  std::vector<Wire> wires;
  for (std::size_t phase = 0; phase < ends[0].size(); ++phase) {
    const bool earth = phase + 1 == ends[0].size();
    for (std::size_t span = 0; span + 1 < ends.size(); ++span) {
      // The earth wire is strung tighter: it hangs as far as 0.8 of the conductors' sag.
      const double a = config.tension / config.weight * (earth ? 1.25 : 1.0);
      wires.push_back({(earth ? "earth_wire/" : "conductor" + std::to_string(phase) + "/") + std::to_string(span),
                       Catenary(ends[span][phase], ends[span + 1][phase], a),
                       0.5 * (earth ? kEarthWire : config.diameter)});
    }
  }
  for (const Wire& wire : wires) AddWire(world, aluminium, wire);
  return wires;
}

/// A place on a wire: x along it.
Transform On(const Wire& wire, double share) {
  const Vec3 p = wire.curve.At(share);
  const Vec3 x = (wire.curve.At(share + 1e-3) - wire.curve.At(share - 1e-3)).normalized();
  const Vec3 y = Vec3::UnitZ().cross(x).normalized();
  base::Mat3 R;
  R << x, y, x.cross(y);
  return {base::Quat(R), p};
}

/// Hangs things on conductors, each in a stretch of its own; gives where the first hangs.
Vec3 HangThings(World& world, const PowerlineConfig& config, const std::vector<Wire>& wires, std::uint64_t seed) {
  RandomStream random(seed, "world/hung");
  const HungLooks looks = AddHungLooks(world, seed);
  std::vector<std::pair<std::string, decltype(&HangKite)>> things;
  const auto add = [&](int count, const char* name, decltype(&HangKite) hang) {
    for (int i = 0; i < count; ++i) things.emplace_back(name + std::to_string(i), hang);
  };
  add(config.kites, "kite", &HangKite);
  add(config.balloons, "balloon", &HangBalloon);
  add(config.bags, "bag", &HangBag);
  add(config.branches, "branch", &HangBranch);
  const std::size_t conductors = wires.size() - (kTowers - 1);
  std::vector<int> used(conductors, 0);
  Vec3 first = wires.front().curve.At(0.5);
  for (std::size_t i = 0; i < things.size(); ++i) {
    const std::size_t pick = random.Index(conductors);
    // Stretches of 0.13 of a span from its first third on; a wire that is full passes it on.
    std::size_t wire = pick;
    while (used[wire] >= 5) wire = (wire + 1) % conductors;
    const double share = 0.18 + 0.13 * used[wire]++ + random.Uniform(0.0, 0.06);
    const Transform X = On(wires[wire], share);
    things[i].second(world, looks, things[i].first, X, wires[wire].radius, random);
    if (i == 0) first = X.p;
  }
  return first;
}

void AddLights(World& world, const PowerlineConfig& config, const Land& land, const Vec2& start) {
  if (!IsDark(config.weather)) return;
  // The crew's floodlight on its mast beside the pad, and red obstruction lights on the peaks.
  const int metal = AddPlainMaterial(world, "mast", {0.30F, 0.31F, 0.32F});
  const Vec2 place = start + Vec2(-3.0, -2.0);
  AddStreetLamp(world, metal, "floodlight", {base::FromYaw(0.5 * kPi), land.On(place)},
                {.height = 4.5, .intensity = 260.0, .range = 60.0}, true);
  Lamp& flood = world.light.lamps.back();
  flood.direction = Vec3(0.3, 1.0, 0.45).normalized();
  flood.cone = 0.9;
  flood.colour = {1.0, 0.95, 0.88};
  for (int tower = 0; tower < kTowers; ++tower) {
    const Vec3 top =
        land.On({config.span * (tower - 0.5 * (kTowers - 1)), 0.0}) + Vec3(0, 0, config.tower_height + 0.25);
    AddObject(world, "tower" + std::to_string(tower) + "/beacon", geometry::Sphere{0.12},
              {base::Quat::Identity(), top - Vec3(0, 0, 0.08)},
              AddPlainMaterial(world, "beacon" + std::to_string(tower), {1.0F, 0.15F, 0.10F}), 1.0);
    Lamp red;
    red.position = top + Vec3(0, 0, 0.3);
    red.intensity = 2.5;
    red.range = 12.0;
    red.colour = {1.0, 0.08, 0.05};
    world.light.lamps.push_back(red);
  }
}

}  // namespace

void Describe(base::Description& d, PowerlineConfig& c) {
  d.Field("span", c.span, {.unit = "m", .meaning = "between towers", .min = 30.0, .max = 70.0});
  d.Field("tower_height", c.tower_height, {.unit = "m", .meaning = "of a tower's peak", .min = 14.0, .max = 40.0});
  d.Field("tension", c.tension,
          {.unit = "N", .meaning = "of a conductor, its horizontal part", .min = 1e3, .max = 60e3});
  d.Field("weight", c.weight, {.unit = "N/m", .meaning = "of a conductor", .min = 1.0, .max = 40.0});
  d.Check("tension", [&c] {  // L²/8a, the parabola's sag
    return c.span * c.span * c.weight / (8.0 * c.tension) < 0.2 * c.tower_height
               ? std::string()
               : std::string(
                     "is so small that the line sags by a fifth of a tower's height; make it larger, or span or weight "
                     "less");
  });
  d.Field("diameter", c.diameter, {.unit = "m", .meaning = "of a conductor", .min = 0.005, .max = 0.06});
  for (const auto& [name, count, what] : {std::tuple{"kites", &c.kites, "kites that hang on the line"},
                                          {"balloons", &c.balloons, "balloons that hang on the line"},
                                          {"bags", &c.bags, "plastic bags that hang on the line"},
                                          {"branches", &c.branches, "branches that lie on the line"}}) {
    d.Field(name, *count, {.meaning = what, .min = 0, .max = 6});
  }
  d.Field("trees", c.trees, {.meaning = "trees beside the corridor, at most", .min = 0, .max = 80});
  d.Field("weather", c.weather, {.meaning = "hour, sun, clouds, fog and wind"});
}

World MakeWorld(const PowerlineConfig& config, std::uint64_t seed) {
  World world;
  world.name = "powerline";
  RandomStream random(seed, "world/land");
  Land land = MakeLand({.half = {80.0, 32.0},
                        .cell = 2.0,
                        .swell = {.height = 1.5, .wavelength = 70.0, .octaves = 2},
                        .relief = {.height = 0.10, .wavelength = 12.0, .octaves = 2},
                        .reach = 104.0,
                        .hills = 16.0},
                       {}, random);
  const Vec2 start(random.Uniform(-25.0, 25.0), random.Uniform(-12.0, -9.0));
  AddPadOn(world, land, AddPadMaterial(world, seed), start, 1.2, 0.5 * kPi);
  const Surface grass = AddGrassGround(world, seed);
  AddLand(world, land, grass, AddMeadow(world, seed), random);
  const std::vector<Wire> wires = AddLine(world, config, land, seed);
  const Vec3 thing = HangThings(world, config, wires, seed);
  AddLights(world, config, land, start);

  Plot plot({78.0, 30.0});
  plot.Take(start, 4.0);
  const auto beside = [](const Vec2& p) { return std::abs(p.y()) > kCorridor + 3.0; };
  const Wood wood = MakeWood(world, 5.0, 9.0, 2, 1, seed);
  RandomStream trees(seed, "world/trees");
  for (int i = 0; i < config.trees; ++i) {
    const auto p = plot.Place(2.0, trees, beside);
    if (p) PlantFrom(world, wood, land, "tree" + std::to_string(i), *p, trees);
  }
  AddShrubs(world, land, plot, 40, 0.4, 0.9, seed, [](const Vec2& p) { return std::abs(p.y()) > 4.0; });
  AddRubble(world, land, plot, {.boulders = 8}, wood.looks.front().bark, seed);
  AddTreeLine(world, land, {.nearest = 4.0, .woods = 0.5, .height_min = 7.0, .height_max = 13.0}, seed);
  world.target = thing + Vec3(0.0, -3.0, -0.5);
  FinishWorld(world, land, config.weather, config.tower_height + 8.0, seed);
  return world;
}

}  // namespace alula::worlds

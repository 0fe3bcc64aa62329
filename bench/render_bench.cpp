// What a picture costs: grey stereo pairs with shadows, trilinear textures and the sensor's noise; depth; colour. By
// maker, on a yard of about 25 k triangles of our own, on the courtyard of the first mission, and on a hall and a
// forest of 90 k triangles; beside them `osmesa_plain`, a textured draw of all triangles by OSMesa without culling,
// levels of detail or shadows (with the same noise). Then every other world of the catalog: how long it takes to make,
// its triangles and objects, and a stereo pair. One core (LP_NUM_THREADS=0 as the program sets it); medians of
// thread time.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "bench/bench.h"
#include "bench/synthetic_worlds.h"
#include "render/camera_renderer.h"
#include "render/plain_reference.h"
#include "render/sensor_effects.h"
#include "scenarios/factories.h"
#include "scenarios/gallery/viewpoints.h"
#include "scenarios/scenario.h"
#include "worlds/courtyard.h"

namespace alula::bench {
namespace {
/// 30 m × 20 m: ground, walls, 14 trees of balls, 30 crates, 5 gates.
worlds::World Yard() {
  worlds::World world;
  world.materials = {NoisyMaterial("ground", 1), NoisyMaterial("wall", 2), NoisyMaterial("leaf", 3),
                     NoisyMaterial("crate", 4)};
  world.light.to_sun_W = base::Vec3(0.4, -0.5, 0.8).normalized();
  const auto box = [&world](base::Vec3 at, base::Vec3 half, int material) {
    world.objects.push_back({"box", geometry::Box{half}, {base::Quat::Identity(), at}, material, 2.0, true});
  };
  box({0, 0, -0.5}, {15, 10, 0.5}, 0);
  for (const double side : {-1.0, 1.0}) {
    box({15.1 * side, 0, 1.5}, {0.1, 10, 1.5}, 1);
    box({0, 10.1 * side, 1.5}, {15, 0.1, 1.5}, 1);
  }
  base::RandomStream random(1, "yard");
  for (int i = 0; i < 14; ++i) {
    const base::Vec3 foot(random.Uniform(-14, 14), random.Uniform(-9, 9), 0.0);
    world.objects.push_back(
        {"trunk", geometry::Cylinder{0.12, 1.0}, {base::Quat::Identity(), foot + base::Vec3(0, 0, 1)}, 3, 1.0, true});
    for (int ball = 0; ball < 3; ++ball) {
      const base::Vec3 at = foot + base::Vec3(random.Uniform(-0.5, 0.5), random.Uniform(-0.5, 0.5), 2.0 + 0.4 * ball);
      world.objects.push_back({"leaves", geometry::Sphere{0.7}, {base::Quat::Identity(), at}, 2, 1.0, true});
    }
  }
  for (int i = 0; i < 30; ++i) {
    box({random.Uniform(-14, 14), random.Uniform(-9, 9), 0.4}, {0.4, 0.3, 0.4}, 3);
  }
  for (int gate = 0; gate < 5; ++gate) {
    const base::Vec3 at(-10.0 + 5.0 * gate, random.Uniform(-6, 6), 1.5);
    for (const double side : {-0.8, 0.8}) {
      box(at + base::Vec3(0, side, 0), {0.06, 0.06, 0.8}, 1);
      box(at + base::Vec3(0, 0, side), {0.06, 0.8, 0.06}, 1);
    }
  }
  return world;
}

/// The n-th of the views on a lap through the yard at 1.5 m; 80° across 640×480.
render::View LapView(int n) {
  const double turn = 0.13 * n;
  const base::Vec3 at(9.0 * std::cos(turn), 5.0 * std::sin(turn), 1.5);
  const double heading = turn + M_PI / 2.0;
  render::View view;
  view.X_WC = {base::FromYaw(heading) * base::ForwardCameraRotation(), at};
  view.intrinsics = {640, 480, 381.36, 381.36, 319.5, 239.5, {}};
  view.draw_movers = false;
  return view;
}

double ThreadMs() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

constexpr int kLap = 48;  // views

/// What each view of the lap cost this thread, ms: the least of several laps, so that what else runs on the machine is
/// left out.
class Costs {
 public:
  void Add(int view, double ms) {
    const auto [at, is_new] = least_.try_emplace(view, ms);
    if (!is_new) at->second = std::min(at->second, ms);
  }
  double Median() const {
    std::vector<double> values;
    for (const auto& [view, ms] : least_) values.push_back(ms);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

 private:
  std::map<int, double> least_;
};

/// One maker on one world, and what its calls cost.
struct Candidate {
  std::string maker;
  bool whole = true;  // false: measured by stereo pairs alone
  std::unique_ptr<render::CameraRenderer> renderer;
  Costs pair, without_noise, depth, colour;
};

/// A renderer that has drawn once: textures are packed and shaders compiled.
std::unique_ptr<render::CameraRenderer> Make(const std::string& maker, const worlds::World& world) {
  auto renderer = maker == "osmesa_plain" ? render::MakePlainReference(world) : render::MakeRenderer(maker, world, {});
  render::Picture picture;
  renderer->Grey(LapView(0), picture);
  return renderer;
}

/// Grey pictures of both eyes, 752×480, with the sensor's noise.
void MeasurePair(int n, Candidate& c) {
  constexpr double kBaseline = 0.11;  // m
  render::View view = LapView(n);
  view.intrinsics.width = 752;
  view.intrinsics.cx = 375.5;
  render::Picture left;
  render::Picture right;
  const double start = ThreadMs();
  c.renderer->Grey(view, left);
  view.X_WC = view.X_WC * base::Transform{base::Quat::Identity(), {kBaseline, 0, 0}};
  c.renderer->Grey(view, right);
  const double drawn = ThreadMs();
  render::ApplyPixelNoise(left, 2 * static_cast<std::uint64_t>(n), {});
  render::ApplyPixelNoise(right, 2 * static_cast<std::uint64_t>(n) + 1, {});
  c.without_noise.Add(n, drawn - start);
  c.pair.Add(n, ThreadMs() - start);
}

/// The same of one place, ms.
double PairMs(render::CameraRenderer& renderer, const base::Transform& X_WC, std::size_t n) {
  render::View view;
  view.X_WC = X_WC;
  view.intrinsics = scenarios::gallery::WideCamera(752, 480);
  view.draw_movers = false;
  render::Picture left;
  render::Picture right;
  const double start = ThreadMs();
  renderer.Grey(view, left);
  view.X_WC = view.X_WC * base::Transform{base::Quat::Identity(), {0.11, 0, 0}};
  renderer.Grey(view, right);
  render::ApplyPixelNoise(left, 2 * n, {});
  render::ApplyPixelNoise(right, 2 * n + 1, {});
  return ThreadMs() - start;
}

void MeasureDepthAndColour(int n, Candidate& c) {
  render::DepthPicture depth;
  const double start = ThreadMs();
  c.renderer->Depth(LapView(n), depth);
  c.depth.Add(n, ThreadMs() - start);
  if (n % 4 != 0) return;
  render::View view = LapView(n);
  view.intrinsics = {1280, 720, 760.0, 760.0, 639.5, 359.5, {}};
  render::Picture picture;
  const double begun = ThreadMs();
  c.renderer->Colour(view, picture);
  c.colour.Add(n, ThreadMs() - begun);
}

/// The makers that are there, with what it costs to make each.
std::vector<Candidate> Candidates(const std::string& world_key, const worlds::World& world, Figures& figures) {
  std::vector<Candidate> candidates;
  for (const char* maker : {"osmesa_plain", "osmesa", "egl", "raster"}) {
    try {
      const double start = ThreadMs();
      auto renderer = Make(maker, world);
      const bool whole = std::string(maker) != "osmesa_plain";
      if (whole) figures.Add(world_key + maker + "/making_and_first_picture_ms", ThreadMs() - start);
      candidates.push_back({maker, whole, std::move(renderer), {}, {}, {}, {}});
    } catch (const base::InputError&) {
      continue;  // this maker is not installed here: no figures of it
    }
  }
  return candidates;
}

/// All makers fly each stretch of the lap in turns, so that a change of the machine's pace meets all alike, and each
/// finds its own data in the caches after the first view.
void Measure(const std::string& name, const worlds::World& world, Figures& figures) {
  constexpr int kLaps = 4;
  constexpr int kStretch = 8;
  const std::string key = "render/" + name + "/";
  std::vector<Candidate> candidates = Candidates(key, world, figures);
  for (int stretch = 0; stretch < kLaps * kLap / kStretch; ++stretch) {
    const int begin = stretch * kStretch % kLap;
    for (Candidate& c : candidates) {
      for (int n = begin; n < begin + kStretch; ++n) MeasurePair(n, c);
      for (int n = begin; c.whole && n < begin + kStretch; ++n) MeasureDepthAndColour(n, c);
    }
  }
  for (const Candidate& c : candidates) {
    figures.Add(key + c.maker + "/stereo_pair_752x480_ms", c.pair.Median());
    if (!c.whole) continue;
    figures.Add(key + c.maker + "/stereo_pair_752x480_without_noise_ms", c.without_noise.Median());
    figures.Add(key + c.maker + "/depth_640x480_ms", c.depth.Median());
    figures.Add(key + c.maker + "/colour_1280x720_ms", c.colour.Median());
  }
}

/// Stereo pairs of a world of the catalog from where a gallery looks at it and from random free places, by raster and
/// by OSMesa; how long the world takes to make, and to hand over to each.
void MeasureCatalogWorld(const scenarios::CatalogEntry& entry, Figures& figures) {
  constexpr std::uint64_t kSeed = 1;
  constexpr int kPlaces = 12;
  constexpr int kRounds = 3;
  const std::string key = "render/" + entry.name + "/";
  const double start = ThreadMs();
  const auto world = scenarios::MakeWorld(scenarios::LoadWorld(entry.file, {}, kSeed), kSeed);
  figures.Add(key + "world/load_ms", ThreadMs() - start);
  figures.Add(key + "world/triangles_1", TrianglesOf(*world));
  figures.Add(key + "world/objects_1", static_cast<double>(world->objects.size()));
  std::vector<base::Transform> places = scenarios::gallery::RandomViewpoints(*world, kPlaces, kSeed);
  for (const auto& view : scenarios::gallery::NamedViewpoints(*world)) places.push_back(view.X_WC);
  for (const char* maker : {"osmesa", "raster"}) {
    try {
      const double begun = ThreadMs();
      const auto renderer = render::MakeRenderer(maker, *world, {});
      figures.Add(key + maker + "/making_ms", ThreadMs() - begun);
      Costs costs;
      for (int round = 0; round < kRounds; ++round) {
        for (std::size_t n = 0; n < places.size(); ++n) {
          costs.Add(static_cast<int>(n), PairMs(*renderer, places[n], n));
        }
      }
      figures.Add(key + maker + "/stereo_pair_752x480_ms", costs.Median());
    } catch (const base::InputError&) {
      continue;  // this maker is not installed here
    }
  }
}

}  // namespace

void Run_render(Figures& figures) {
  for (const auto& [name, world] : {std::pair{"yard", Yard()},
                                    {"courtyard", worlds::MakeWorld(worlds::CourtyardConfig{}, 1)},
                                    {"synthetic_hall", SyntheticHall(1)},
                                    {"synthetic_forest", SyntheticForest(1)}}) {
    figures.Add(std::string("render/") + name + "/world/triangles_1", TrianglesOf(world));
    Measure(name, world, figures);
  }
  for (const scenarios::CatalogEntry& entry : scenarios::ListCatalogs()) {
    if (entry.kind == "world" && entry.name != "courtyard") MeasureCatalogWorld(entry, figures);  // it stands above
  }
}

}  // namespace alula::bench

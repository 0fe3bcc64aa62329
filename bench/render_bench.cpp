// What a picture costs: grey stereo pair, depth and colour by maker, on a yard of about 25 k triangles of our own, on
// the courtyard of the first mission, and on a hall and a forest of 90 k triangles. One core (LP_NUM_THREADS=0 as the
// program sets it); medians of CPU time.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "bench/bench.h"
#include "bench/synthetic_worlds.h"
#include "render/camera_renderer.h"
#include "render/sensor_effects.h"
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

/// Median over `count` calls of what a call costs this thread, ms; `act` gets the number of the call.
double MedianMs(int count, const std::function<void(int)>& act) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
  };
  std::vector<double> times;
  for (int n = 0; n < count; ++n) {
    const double start = now();
    act(n);
    times.push_back(now() - start);
  }
  std::nth_element(times.begin(), times.begin() + count / 2, times.end());
  return times[static_cast<std::size_t>(count / 2)];
}

void Measure(const std::string& name, const worlds::World& world, const std::string& maker, Figures& figures) {
  const std::string key = "render/" + name + "/" + maker + "/";
  constexpr int kLap = 48;
  render::Picture left;
  render::Picture right;
  render::DepthPicture depth;
  std::unique_ptr<render::CameraRenderer> renderer;
  const double making = MedianMs(3, [&](int) {
    renderer = render::MakeRenderer(maker, world, {});
    renderer->Grey(LapView(0), left);
  });
  figures.Add(key + "making_and_first_picture_ms", making);
  for (const int width : {640, 752}) {
    figures.Add(key + "stereo_pair_" + std::to_string(width) + "x480_ms", MedianMs(kLap, [&](int n) {
                  render::View view = LapView(n);
                  view.intrinsics.width = width;
                  view.intrinsics.cx = 0.5 * (width - 1);
                  renderer->Grey(view, left);
                  view.X_WC = view.X_WC * base::Transform{base::Quat::Identity(), {0.11, 0, 0}};
                  renderer->Grey(view, right);
                }));
  }
  figures.Add(key + "depth_640x480_ms", MedianMs(kLap, [&](int n) { renderer->Depth(LapView(n), depth); }));
  figures.Add(key + "colour_1280x720_ms", MedianMs(kLap / 2, [&](int n) {
                render::View view = LapView(2 * n);
                view.intrinsics = {1280, 720, 760.0, 760.0, 639.5, 359.5, {}};
                renderer->Colour(view, left);
              }));
}

}  // namespace

void Run_render(Figures& figures) {
  for (const auto& [name, world] : {std::pair{"yard", Yard()},
                                    {"courtyard", worlds::MakeCourtyard({}, 1)},
                                    {"synthetic_hall", SyntheticHall(1)},
                                    {"synthetic_forest", SyntheticForest(1)}}) {
    figures.Add(std::string("render/") + name + "/world/triangles_1", TrianglesOf(world));
    for (const char* maker : {"osmesa", "egl", "raster"}) {
      try {
        Measure(name, world, maker, figures);
      } catch (const base::InputError&) {
        continue;  // this maker is not installed here: no figures of it
      }
    }
  }
  render::Picture picture{640, 480, 1, std::vector<std::uint8_t>(640UL * 480, 120)};
  figures.Add("render/noise/cpu/grey_640x480_ms",
              MedianMs(101, [&](int n) { render::ApplyPixelNoise(picture, static_cast<std::uint64_t>(n), {}); }));
}

}  // namespace alula::bench

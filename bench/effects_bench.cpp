// What turning a drawn picture into a camera's image costs, effect by effect, beside OpenCV doing the same. One thread;
// medians of CPU time; everything in turns, so that a busy machine slows all alike.
#include <algorithm>
#include <ctime>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "bench/bench.h"
#include "render/image_sensor.h"
#include "render/lens.h"
#include "render/structured_light.h"
#include "stack/interface/camera_model.h"

namespace alula::bench {
namespace {

struct Task {
  std::string key;
  std::function<void(int)> act;  // gets the number of the turn
};

double ThreadMs() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

void MeasureInTurns(const std::vector<Task>& tasks, Figures& figures) {
  constexpr int kTurns = 41;
  std::vector<std::vector<double>> times(tasks.size());
  for (int turn = 0; turn < kTurns; ++turn) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      const double start = ThreadMs();
      tasks[i].act(turn);
      times[i].push_back(ThreadMs() - start);
    }
  }
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    std::nth_element(times[i].begin(), times[i].begin() + kTurns / 2, times[i].end());
    figures.Add(tasks[i].key, times[i][kTurns / 2]);
  }
}

/// EuRoC's left camera.
stack::CameraIntrinsics BentCamera() {
  return {752, 480, 458.654, 457.296, 367.215, 248.375, {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0}};
}

/// A view of 190° across.
stack::CameraIntrinsics Fisheye() {
  return {752, 480, 226.8, 226.8, 375.5, 239.5, {}, stack::DistortionModel::kEquidistant};
}

std::vector<std::uint8_t> Noise(std::size_t bytes) {
  base::RandomStream random(1, "canvas");
  std::vector<std::uint8_t> values(bytes);
  for (std::uint8_t& value : values) value = static_cast<std::uint8_t>(random.Index(256));
  return values;
}

/// A lens's table applied to its sources.
Task LensTask(const std::string& what, const stack::CameraIntrinsics& camera, int channels) {
  auto lens = std::make_shared<render::Lens>(camera);
  auto canvas = std::make_shared<std::vector<std::uint8_t>>(Noise(lens->canvas_pixels() * channels));
  auto out =
      std::make_shared<std::vector<std::uint8_t>>(static_cast<std::size_t>(camera.width * camera.height) * channels);
  return {"effects/" + what + "/752x480_ms", [=](int) {
            lens->Sample(canvas->data(), channels, {0, camera.height}, out->data());
          }};
}

/// cv::remap with the fixed-point maps of the first source.
Task RemapTask(const std::string& what, const stack::CameraIntrinsics& camera, int type) {
  const stack::CameraIntrinsics source = render::Lens(camera).sources().front().intrinsics;
  cv::Mat_<cv::Point2f> map(camera.height, camera.width);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const base::Vec2 n = stack::Normalise(camera, {u, v});
      map(v, u) = {static_cast<float>(source.fx * n.x() + source.cx),
                   static_cast<float>(source.fy * n.y() + source.cy)};
    }
  }
  cv::Mat place, fraction;
  cv::convertMaps(map, cv::noArray(), place, fraction, CV_16SC2);
  const cv::Mat from(source.height, source.width, type, cv::Scalar::all(100));
  return {"effects/" + what + "/752x480_ms",
          [=, to = cv::Mat()](int) mutable { cv::remap(from, to, place, fraction, cv::INTER_LINEAR); }};
}

Task SensorTask(const std::string& what, const render::SensorEffects& effects, int channels = 1) {
  const stack::CameraIntrinsics camera = BentCamera();
  auto sensor = std::make_shared<render::ImageSensor>(effects, camera, channels, 1);
  const render::Picture scene{752, 480, channels, Noise(752UL * 480 * static_cast<std::size_t>(channels))};
  return {"effects/" + what + "/752x480_ms", [=, picture = scene](int turn) mutable {
            const render::GlareLight sun{base::Vec3(0.2, -0.3, 1).normalized()};
            sensor->Apply(picture, static_cast<std::uint64_t>(turn), {.lights = {&sun, 1}});
          }};
}

std::vector<Task> SensorTasks() {
  render::SensorEffects noise, vignetting, pattern, gamma, dirt, glare;
  vignetting.vignetting = 0.4;
  pattern.fixed_pattern = {0.5, 0.01};
  gamma.gamma = 2.2;
  gamma.bits = 6;
  dirt.dirt = {0.3, 0.4, 0.05};
  glare.glare.veil = 20;
  render::SensorEffects all{.noise = {},
                            .fixed_pattern = pattern.fixed_pattern,
                            .vignetting = 0.4,
                            .dirt = dirt.dirt,
                            .glare = glare.glare,
                            .gamma = 2.2,
                            .bits = 6};
  return {SensorTask("noise", noise),
          SensorTask("noise_vignetting", vignetting),
          SensorTask("noise_fixed_pattern", pattern),
          SensorTask("noise_gamma_6_bits", gamma),
          SensorTask("noise_dirt", dirt),
          SensorTask("noise_glare", glare),
          SensorTask("all", all),
          SensorTask("colour_noise", noise, 3),
          SensorTask("colour_all", all, 3)};
}

/// Gaussian noise as OpenCV makes and adds it.
Task OpenCvNoiseTask() {
  return {"effects/cv_rng_noise/752x480_ms", [rng = cv::RNG(1), image = cv::Mat(480, 752, CV_8UC1, cv::Scalar(100)),
                                              noise = cv::Mat(480, 752, CV_16SC1)](int) mutable {
            rng.fill(noise, cv::RNG::NORMAL, 0, 2);
            cv::add(image, noise, image, cv::noArray(), CV_8U);
          }};
}

std::vector<Task> DepthTasks() {
  constexpr double kFocal = 577.0;
  const stack::CameraIntrinsics camera{640, 480, kFocal, kFocal, 319.5, 239.5, {}};
  render::DepthPicture depth{640, 480, {}};
  for (int i = 0; i < 640 * 480; ++i) depth.metres.push_back(1.0F + 0.002F * static_cast<float>(i % 640));
  const auto millimetres = render::MeasureDepth(depth, kFocal, nullptr, nullptr, {}, 1);
  return {
      {"effects/structured_light/640x480_ms",
       [=](int turn) { render::MeasureDepth(depth, kFocal, nullptr, nullptr, {}, static_cast<std::uint64_t>(turn)); }},
      {"effects/depth_registration/640x480_ms", [=](int) {
         render::RegisterDepth(millimetres, camera, camera, {base::Quat::Identity(), {-0.025, 0, 0}});
       }}};
}

}  // namespace

void Run_effects(Figures& figures) {
  cv::setNumThreads(1);
  std::vector<Task> tasks = SensorTasks();
  for (Task& task : DepthTasks()) tasks.push_back(std::move(task));
  tasks.push_back(OpenCvNoiseTask());
  tasks.push_back(LensTask("lens", BentCamera(), 1));
  tasks.push_back(LensTask("lens_fisheye_190", Fisheye(), 1));
  tasks.push_back(LensTask("colour_lens", BentCamera(), 3));
  tasks.push_back(RemapTask("cv_remap", BentCamera(), CV_8UC1));
  tasks.push_back(RemapTask("cv_remap_colour", BentCamera(), CV_8UC3));
  MeasureInTurns(tasks, figures);
}

}  // namespace alula::bench

#include "scenarios/check/exposure_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "scenarios/check/check_worlds.h"
#include "scenarios/check/statistics.h"

namespace alula::scenarios::check {
namespace {

/// Share of full scale.
double MeanOf(const Frame& frame) {
  return std::accumulate(frame.grey.begin(), frame.grey.end(), 0.0) / (255.0 * static_cast<double>(frame.grey.size()));
}

double StopsOf(const Frame& frame) { return std::log2(frame.exposure.Seconds() * frame.gain); }

/// Frames from the change at `change` until the setting moves.
double AnswerOf(const std::vector<Frame>& frames, std::size_t change) {
  for (std::size_t i = change; i < frames.size(); ++i) {
    if (std::abs(StopsOf(frames[i]) - StopsOf(frames[change])) > 0.02) return static_cast<double>(i - change);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Share of the error in stops that goes from one frame to the one that obeys it: the error before it was e, after it
/// (1 − speed) e.
double SpeedOf(const std::vector<Frame>& frames, std::size_t change, std::size_t answer, double target) {
  double products = 0.0, squares = 0.0;
  for (std::size_t i = change; i + answer < std::min(frames.size(), change + 4 * answer); ++i) {
    const double before = std::log2(target / MeanOf(frames[i])), after = std::log2(target / MeanOf(frames[i + answer]));
    products += before * (before - after);
    squares += before * before;
  }
  return products / squares;
}

}  // namespace

void CheckExposureControl(const Rig& rig, const CameraGroup& group, const sim::CameraConfig& claimed, Report& report) {
  if (!claimed.auto_exposure) return;
  Rig bench = Isolate(rig, group);
  ConfigOf(bench.sensors, Only(group)).auto_exposure = ConfigOf(rig.sensors, group).auto_exposure;
  const sim::AutoExposureConfig& control = *claimed.auto_exposure;
  const CameraGeometry camera = GeometryOf(bench, group).front();
  // Two greys within reach of the control's limits, a stop apart: darker and brighter than the target at nominal light.
  const double dark = control.target / std::sqrt(2.0), bright = std::min(0.95, control.target * std::sqrt(2.0));
  const auto renderer = render::MakeRenderer(bench.render, TwoGreys(dark, bright), {});
  const int settle = static_cast<int>(std::ceil(8.0 * control.delay / control.speed)) + 10;
  const base::Time change =
      claimed.rate.SampleTime(settle) - base::Nanoseconds(static_cast<std::int64_t>(0.5e9 * claimed.rate.Period()));
  const Motion motion = [&](base::Time t) {
    const double x = t < change ? -20.0 : 20.0;  // m along a wall seen from one metre
    const base::Transform X_WC = ChartPose() * base::Transform{base::Quat::Identity(), {x, 0.0, -0.3}};
    return vehicles::BodyState{BodyPose(X_WC, camera.X_BC), base::Vec3::Zero(), base::Vec3::Zero()};
  };
  const base::Duration duration = claimed.rate.SampleTime(2 * settle) - base::Time{} + claimed.read_out;
  std::vector<Frame> frames;
  for (Frame& frame : FramesOf(Record(bench, renderer.get(), motion, duration))) {
    if (frame.sensor == camera.sensor) frames.push_back(std::move(frame));
  }
  const auto first = static_cast<std::size_t>(settle);
  if (frames.size() < 2 * first) {
    report.Add(Compare(camera.name, "exposure control: mean it settles at", control.target,
                       std::numeric_limits<double>::quiet_NaN(), 0.0, "1"));
    return;
  }
  constexpr double kRounding = 0.01;  // of the picture's mean: a grey level of 255, and the share of error that is left
  report.Add(Compare(camera.name, "exposure control: mean it settles at, dark", control.target,
                     MeanOf(frames[first - 1]), kRounding, "1"));
  report.Add(Compare(camera.name, "exposure control: mean it settles at, bright", control.target, MeanOf(frames.back()),
                     kRounding, "1"));
  // A frame's picture is there `read_out` after its middle; the next that opens later can obey.
  const double opens = 1e-9 * static_cast<double>(sim::HalfSpan(claimed, claimed.exposure).ns);
  const double waits = std::floor((claimed.read_out.Seconds() + opens) / claimed.rate.Period());
  const double answer = AnswerOf(frames, first);
  report.Add(Compare(camera.name, "exposure control: frames until it obeys", control.delay + waits, answer, 0.0, "1"));
  const double speed = std::isfinite(answer) ? SpeedOf(frames, first, static_cast<std::size_t>(answer), control.target)
                                             : std::numeric_limits<double>::quiet_NaN();
  report.Add(Compare(camera.name, "exposure control: speed", control.speed, speed, 0.05 * control.speed + 0.01, "1"));
}

}  // namespace alula::scenarios::check

#include "scenarios/check/depth_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "scenarios/check/check_worlds.h"
#include "scenarios/check/statistics.h"

namespace alula::scenarios::check {
namespace {

using base::Transform;
using base::Vec3;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// A frame of depth and the colour frame of the same number.
struct RgbdFrame {
  stack::DepthImage depth;
  base::Duration read_out;
  Frame colour;
};

/// What stands on the bench: the rig, its claimed optics and where its depth camera is on the body.
struct Bench {
  Rig rig;
  sim::RgbdCameraConfig claimed;
  CameraGroup group;
  std::string name;
  double focal = 0.0;  // of the depth camera, px
  Transform X_BD;      // depth camera on the body, colour camera besides
  Transform X_BC;

  /// A grey that does not drown the pattern.
  double dim() const { return std::min(0.6, 0.7 * claimed.depth.light.blinding); }
  double focal_baseline() const { return focal * claimed.depth.light.baseline; }
  double SigmaAt(double z) const {
    const sim::DepthCameraConfig& depth = claimed.depth;
    const double step = depth.light.disparity_step;
    return z * z / focal_baseline() * std::hypot(depth.light.disparity_noise, step / std::sqrt(12.0));
  }
};

Bench Prepare(const Rig& isolated, const CameraGroup& group, const sim::RgbdCameraConfig& claimed) {
  Bench bench{isolated, claimed, group, {}, sim::DepthIntrinsicsOf(claimed.depth).fx, {}, {}};
  const CameraGeometry colour = GeometryOf(isolated, group).front();
  bench.name = colour.name + ".depth";
  bench.X_BC = colour.X_BC;
  bench.X_BD = colour.X_BC * Transform{base::Quat::Identity(), {claimed.depth.offset, 0.0, 0.0}};
  return bench;
}

/// As it is, or with depth in the depth camera's own pixels.
Bench Unregistered(Bench bench) {
  bench.rig.sensors.rgbd.front().depth.registered = false;
  return bench;
}

/// One frame from each pose of the depth camera.
std::vector<RgbdFrame> Shoot(const Bench& bench, const worlds::World& world, const std::vector<Transform>& X_WD) {
  const auto renderer = render::MakeRenderer(bench.rig.render, world, {});
  const base::Rate rate = bench.claimed.rate;
  const auto views = static_cast<std::int64_t>(X_WD.size());
  const Motion motion = [&](base::Time t) {
    const std::int64_t n = std::min(NearestFrame(rate, t), views - 1);
    return vehicles::BodyState{BodyPose(X_WD[static_cast<std::size_t>(n)], bench.X_BD), Vec3::Zero(), Vec3::Zero()};
  };
  const base::Duration duration =
      rate.SampleTime(views) - base::Time{} + std::max(bench.claimed.read_out, bench.claimed.depth.read_out);
  std::vector<RgbdFrame> frames(X_WD.size());
  Record(bench.rig, renderer.get(), motion, duration, [&](stack::Measurement&& m) {
    if (m.seq >= X_WD.size()) return;
    if (const auto* depth = std::get_if<stack::DepthImage>(&m.data)) {
      frames[m.seq].depth = *depth;
      frames[m.seq].read_out = m.available - m.captured;
    }
    std::vector<Frame> colour = FramesOf({m});
    if (!colour.empty()) frames[m.seq].colour = std::move(colour.front());
  });
  return frames;
}

/// Before the chart at this distance, `x` metres to the right of its middle, turned by `turn` to the left.
Transform Before(double distance, double x = 0.0, double turn = 0.0) {
  const base::Quat q_TD = base::Exp({0.0, turn, 0.0});
  return ChartPose() * Transform{q_TD, Vec3(x, 0.0, 0.0) + q_TD * Vec3(0.0, 0.0, -distance)};
}

/// Depths (m; 0 where lost) in the middle of a picture: `share` of its width and height.
std::vector<double> Middle(const stack::DepthImage& image, double share) {
  std::vector<double> depths;
  if (image.millimetres == nullptr) return depths;
  const int half_u = std::max(2, static_cast<int>(0.5 * share * image.width));
  const int half_v = std::max(2, static_cast<int>(0.5 * share * image.height));
  for (int v = image.height / 2 - half_v; v < image.height / 2 + half_v; ++v) {
    for (int u = image.width / 2 - half_u; u < image.width / 2 + half_u; ++u) {
      depths.push_back(1e-3 * (*image.millimetres)[static_cast<std::size_t>(v) * image.width + u]);
    }
  }
  return depths;
}

double ShareLost(const stack::DepthImage& image, double share) {
  const std::vector<double> depths = Middle(image, share);
  if (depths.empty()) return kNothing;
  return static_cast<double>(std::count(depths.begin(), depths.end(), 0.0)) / static_cast<double>(depths.size());
}

/// Walls about one distance, 3 % to and fro, so that disparity runs over several of its steps.
void AddRange(const Bench& bench, double distance, Report& report) {
  constexpr int kFrames = 24;
  std::vector<Transform> poses;
  for (int i = 0; i < kFrames; ++i) poses.push_back(Before(distance * (0.97 + 0.06 * (i + 0.5) / kFrames)));
  const std::vector<RgbdFrame> frames = Shoot(bench, TwoGreys(bench.dim(), bench.dim()), poses);
  std::vector<double> errors;
  double lost = 0.0, all = 0.0;
  for (int i = 0; i < kFrames; ++i) {
    const double truth = distance * (0.97 + 0.06 * (i + 0.5) / kFrames);
    for (const double depth : Middle(frames[i].depth, 0.6)) {
      depth > 0.0 ? errors.push_back(depth - truth) : void(++lost);
      ++all;
    }
  }
  const std::string at = " at " + std::to_string(std::lround(1000.0 * distance)) + " mm";
  if (errors.size() < 100) {
    report.Add(Compare(bench.name, "spread" + at, bench.SigmaAt(distance), kNothing, 0.0, "m"));
    return;
  }
  // The errors of a window's pixels (5 × 5) count as one.
  const double independent = static_cast<double>(errors.size()) / 25.0;
  const Spread spread = SpreadOf(errors);
  const double sigma = bench.SigmaAt(distance);
  report.Add(Compare(bench.name, "bias" + at, 0.0, spread.mean,
                     5e-4 + 0.02 * sigma + kSigmas * sigma / std::sqrt(independent), "m"));
  // Steps of disparity and whole millimetres: where they are alike, the two roundings are not independent.
  const double total = std::hypot(sigma, 1e-3 / std::sqrt(12.0));
  report.Add(Compare(bench.name, "spread" + at, total, spread.sigma,
                     0.05 * total + kSigmas * SigmaError(sigma, independent), "m"));
  const double holes = bench.claimed.depth.light.holes;  // of 2 × 2 px
  report.Add(Compare(bench.name, "share lost" + at, holes, lost / all,
                     BinomialTolerance(holes, std::max(1.0, all / 4.0)), "1"));
}

/// The value between `low` and `high` at which a picture's middle goes from lost to seen or back, to `steps` parts.
template <typename PoseOf>
double Threshold(const Bench& bench, double low, double high, int steps, double share, const PoseOf& pose_of) {
  std::vector<Transform> poses;
  for (int i = 0; i <= steps; ++i) poses.push_back(pose_of(low + (high - low) * i / steps));
  const std::vector<RgbdFrame> frames = Shoot(bench, TwoGreys(bench.dim(), bench.dim()), poses);
  for (int i = 1; i <= steps; ++i) {
    const bool before = ShareLost(frames[i - 1].depth, share) > 0.5, now = ShareLost(frames[i].depth, share) > 0.5;
    if (before != now) return low + (high - low) * (i - 0.5) / steps;
  }
  return kNothing;
}

void AddLimits(const Bench& bench, Report& report) {
  constexpr int kSteps = 40;
  const render::StructuredLight& light = bench.claimed.depth.light;
  const auto straight = [](double distance) { return Before(distance); };
  for (const bool near : {true, false}) {
    const double limit = near ? light.nearest : light.farthest;
    report.Add(Compare(bench.name, near ? "nearest" : "farthest", limit,
                       Threshold(bench, 0.9 * limit, 1.1 * limit, kSteps, 0.2, straight), 0.2 * limit / kSteps, "m"));
  }
  const double distance = std::sqrt(light.nearest * light.farthest);
  const double low = std::max(0.0, light.grazing - 5.0 * kDegree), high = std::min(1.55, light.grazing + 5.0 * kDegree);
  const auto turned = [distance](double angle) { return Before(distance, 0.0, angle); };
  report.Add(Compare(bench.name, "grazing angle", light.grazing / kDegree,
                     Threshold(bench, low, high, kSteps, 0.02, turned) / kDegree, 0.5, "deg"));
}

/// Columns that are lost in each row beside the two edges of a nearer sheet, mean over rows: left and right of it.
struct Shadows {
  double left = 0.0, right = 0.0;
};
Shadows FindShadows(const stack::DepthImage& image, double near, double far) {
  const double middle = 0.5 * (near + far);
  Shadows sum;
  double rows = 0.0;
  for (int v = image.height / 3; v < 2 * image.height / 3; ++v) {
    const std::uint16_t* row = image.millimetres->data() + static_cast<std::size_t>(v) * image.width;
    const auto is_near = [&](int u) { return row[u] > 0 && 1e-3 * row[u] < middle; };
    int first = 0, last = image.width - 1;
    while (first < image.width && !is_near(first)) ++first;
    while (last > 0 && !is_near(last)) --last;
    if (first >= last) continue;
    double left = 0.0, right = 0.0;
    for (int u = first - 1; u >= 0 && row[u] == 0; --u) ++left;
    for (int u = last + 1; u < image.width && row[u] == 0; ++u) ++right;
    sum.left += left;
    sum.right += right;
    ++rows;
  }
  if (rows == 0.0) return {kNothing, kNothing};
  return {sum.left / rows, sum.right / rows};
}

/// Distances of a sheet and a wall behind it, well inside the range.
std::pair<double, double> NearAndFar(const Bench& bench) {
  const render::StructuredLight& light = bench.claimed.depth.light;
  const double near = light.nearest + 0.25 * (light.farthest - light.nearest);
  return {near, std::min(0.9 * light.farthest, 2.0 * near)};
}

void AddShadow(const Bench& bench, Report& report) {
  const auto [near, far] = NearAndFar(bench);
  const double width = 0.3 * near * bench.claimed.depth.width / bench.focal;
  const std::vector<RgbdFrame> frames =
      Shoot(bench, SheetBeforeWall(width, far - near, bench.dim()), {Before(near), Before(near)});
  const Shadows shadows = FindShadows(frames.back().depth, near, far);
  const double expected = bench.focal_baseline() * (1.0 / near - 1.0 / far);
  // At either edge a column or two are lost to the slant between the depths; the shadow comes on top on one side.
  report.Add(Compare(bench.name, "shadow beside an edge", expected, shadows.right - shadows.left, 1.5, "px"));
}

/// Sub-pixel column at which a row crosses the middle between the grey of two places, from `from` in steps of `step`.
double Crossing(const std::uint8_t* row, int from, int step, int count) {
  const double middle = 0.5 * (row[from] + row[from + step * count]);
  for (int i = 0; i < count; ++i) {
    const double a = row[from + step * i] - middle, b = row[from + step * (i + 1)] - middle;
    if (a * b <= 0.0 && a != b) return from + step * (i + a / (a - b));
  }
  return kNothing;
}

/// The sheet's left edge in the colour picture and in the registered depth, mean over rows.
void AddRegistration(const Bench& bench, Report& report) {
  const auto [near, far] = NearAndFar(bench);
  const double width = 0.3 * near * bench.claimed.depth.width / bench.focal;
  const std::vector<RgbdFrame> frames =
      Shoot(bench, SheetBeforeWall(width, far - near, bench.dim()), {Before(near), Before(near)});
  const RgbdFrame& frame = frames.back();
  double sum = 0.0, rows = 0.0;
  if (frame.depth.millimetres != nullptr && frame.colour.width == frame.depth.width) {
    for (int v = 2 * frame.depth.height / 5; v < 3 * frame.depth.height / 5; ++v) {
      const std::uint16_t* depth = frame.depth.millimetres->data() + static_cast<std::size_t>(v) * frame.depth.width;
      int first = 0;
      while (first < frame.depth.width && !(depth[first] > 0 && 2e-3 * depth[first] < near + far)) ++first;
      constexpr int kReach = 20;  // px to either side
      if (first < kReach || first + kReach >= frame.depth.width) continue;
      const std::uint8_t* colour = frame.colour.grey.data() + static_cast<std::size_t>(v) * frame.colour.width;
      const double edge = Crossing(colour, first - kReach, 1, 2 * kReach);
      if (!std::isfinite(edge)) continue;
      sum += first - 0.5 - edge;  // the pixel's own left border
      ++rows;
    }
  }
  // The border column is lost to the slant; patches of another size than the pixels reach over by half of one.
  report.Add(Compare(bench.name, "registration: depth's edge to colour's", 0.0, rows > 0.0 ? sum / rows : kNothing, 2.5,
                     "px"));
}

void AddBlinding(const Bench& bench, Report& report) {
  const double blinding = bench.claimed.depth.light.blinding;
  if (blinding > 0.99 || blinding < 0.1) return;
  const double distance = std::sqrt(bench.claimed.depth.light.nearest * bench.claimed.depth.light.farthest);
  const std::vector<RgbdFrame> frames =
      Shoot(bench, TwoGreys(blinding - 0.03, std::min(1.0, blinding + 0.02)),
            {Before(distance, -50.0), Before(distance, -50.0), Before(distance, 50.0), Before(distance, 50.0)});
  const double few = bench.claimed.depth.light.holes + 0.01;
  report.Add(
      Compare(bench.name, "share lost in light below the limit", 0.0, ShareLost(frames[1].depth, 0.5), few, "1"));
  report.Add(
      Compare(bench.name, "share lost in light above the limit", 1.0, ShareLost(frames[3].depth, 0.5), 0.01, "1"));
}

}  // namespace

void CheckDepth(const Rig& isolated, const CameraGroup& group, const sim::RgbdCameraConfig& claimed, Report& report) {
  const Bench bench = Prepare(isolated, group, claimed);
  const Bench own = Unregistered(bench);
  const render::StructuredLight& light = claimed.depth.light;
  const double near = 1.15 * light.nearest, far = 0.9 * light.farthest;
  for (const double distance : {near, std::sqrt(near * far), far}) AddRange(own, distance, report);
  AddLimits(own, report);
  AddShadow(own, report);
  AddBlinding(own, report);
  if (claimed.depth.registered) {
    AddRegistration(bench, report);
    report.Note("depth against range, limits and shadows: in the depth camera's own pixels");
  }
  const std::vector<RgbdFrame> frames = Shoot(bench, TwoGreys(bench.dim(), bench.dim()), {Before(far), Before(far)});
  report.Add(
      Compare(bench.name, "read-out", claimed.depth.read_out.Seconds(), frames.back().read_out.Seconds(), 1e-9, "s"));
}

}  // namespace alula::scenarios::check

#include "scenarios/check/shutter_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scenarios/check/check_worlds.h"
#include "scenarios/check/statistics.h"
#include "stack/interface/camera_model.h"

namespace alula::scenarios::check {
namespace {

using base::Transform;
using base::Vec3;

constexpr double kFar = 30.0;      // m, of the wall: the eyes of a pair see it alike
constexpr double kPeriod = 512.0;  // px, of the stripes
constexpr int kPhases = 13;        // frames whose edges lie at other parts of a pixel

/// The swing: about the first camera's centre at `rate` (rad/s), through a direction that differs by a part of a pixel
/// from frame to frame.
struct Swing {
  base::Rate frames;
  double focal = 0.0;
  double rate = 0.0;
  Transform X_BC;

  double Angle(base::Time t) const {
    const std::int64_t n = NearestFrame(frames, t);
    return static_cast<double>(n % kPhases) / kPhases / focal + rate * (t - frames.SampleTime(n)).Seconds();
  }
  vehicles::BodyState operator()(base::Time t) const {
    const Transform X_WC = ChartPose() * Transform{base::Exp({0.0, Angle(t), 0.0}), {0.0, 0.0, -kFar}};
    vehicles::BodyState state;
    state.X_WB = BodyPose(X_WC, X_BC);
    const Vec3 w_W = X_WC.q * Vec3(0.0, rate, 0.0);
    state.v_WB = w_W.cross(state.X_WB.p - X_WC.p);
    state.w_B = state.X_WB.q.conjugate() * w_W;
    return state;
  }
};

/// Pixel of the edge at the height at which `row` sees it, from a pose of the camera.
base::Vec2 EdgePixel(const stack::CameraIntrinsics& k, const Transform& X_WC, int row) {
  const Transform X_CT = X_WC.Inverse() * ChartPose();
  double y = kFar * (row - k.cy) / k.fy;
  base::Vec2 pixel = stack::Project(k, X_CT * Vec3(0.0, y, 0.0));
  for (int i = 0; i < 20 && std::abs(pixel.y() - row) > 1e-6; ++i) {
    y += kFar * (row - pixel.y()) / k.fy;
    pixel = stack::Project(k, X_CT * Vec3(0.0, y, 0.0));
  }
  return pixel;
}

/// How fast the edge moves in a row, px/s.
double EdgeSpeed(const CameraGeometry& camera, const Swing& swing, base::Time t, int row) {
  constexpr base::Duration h = base::Microseconds(100);
  const auto at = [&](base::Time time) {
    return EdgePixel(camera.intrinsics, swing(time).X_WB * camera.X_BC, row).x();
  };
  return (at(t + h) - at(t - h)) / (2.0 * h.Seconds());
}

/// So fast that the exposure smears an edge over 8 px, but neither rolling nor an eye's offset shift it by over 60.
double SpeedFor(const sim::CameraConfig& camera, base::Duration eye_offset) {
  const double roll = camera.row_delay.Seconds() * camera.height;
  double speed = std::min(8.0 / camera.exposure.Seconds(), 0.4 * camera.width * camera.rate.Hz());
  if (roll > 0.0) speed = std::min(speed, 60.0 / roll);
  if (eye_offset.ns != 0) speed = std::min(speed, 60.0 / std::abs(eye_offset.Seconds()));
  return speed;
}

std::vector<int> MiddleRows(int height) {
  std::vector<int> rows;
  for (int row = height / 5; row < height - height / 5; row += std::max(1, height / 120)) rows.push_back(row);
  return rows;
}

/// What the edges of one frame say, by least squares over its rows.
struct EdgeReading {
  std::uint32_t seq = 0;
  double exposure = 0.0, row_delay = 0.0, offset = 0.0;  // s
};
EdgeReading Read(const std::vector<EdgeRow>& still, const std::vector<EdgeRow>& moving,
                 const std::vector<double>& speeds, double middle_row) {
  const auto n = static_cast<Eigen::Index>(still.size());
  Eigen::MatrixXd A(n, 2);
  Eigen::VectorXd shift(n);
  double box = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    // A row's own speed: seconds, so that rows add up.
    A.row(i) << 1.0, moving[i].row - middle_row;
    shift[i] = (moving[i].place - still[i].place) / speeds[i];
    box += (moving[i].variance - still[i].variance) / (speeds[i] * speeds[i]) / static_cast<double>(n);
  }
  const Solution line = LeastSquares(A, shift);
  return {0, std::sqrt(std::max(0.0, 12.0 * box)), line.x[1], line.x[0]};
}

std::vector<Frame> Of(const std::vector<Frame>& frames, stack::SensorId sensor) {
  std::vector<Frame> own;
  std::copy_if(frames.begin(), frames.end(), std::back_inserter(own),
               [sensor](const Frame& frame) { return frame.sensor == sensor; });
  return own;
}

std::vector<EdgeReading> ReadAll(const CameraGeometry& camera, const Swing& swing, const std::vector<Frame>& still,
                                 const std::vector<Frame>& moving, int window) {
  const std::vector<int> rows = MiddleRows(camera.intrinsics.height);
  std::vector<EdgeReading> readings;
  for (std::size_t i = 2; i < std::min(still.size(), moving.size()); ++i) {  // the first have no motion before them
    const base::Time t = still[i].captured;
    std::vector<double> around, speeds;
    for (const int row : rows) {
      Swing at_rest = swing;
      at_rest.rate = 0.0;
      around.push_back(EdgePixel(camera.intrinsics, at_rest(t).X_WB * camera.X_BC, row).x());
      speeds.push_back(EdgeSpeed(camera, swing, t, row));
    }
    EdgeReading reading = Read(FindEdge(still[i], around, rows, window), FindEdge(moving[i], around, rows, window),
                               speeds, 0.5 * (camera.intrinsics.height - 1));
    reading.seq = still[i].seq;
    readings.push_back(reading);
  }
  return readings;
}

double MeanOf(const std::vector<EdgeReading>& readings, double EdgeReading::*what, std::uint32_t every = 1,
              bool struck = true) {
  double sum = 0.0, count = 0.0;
  for (const EdgeReading& reading : readings) {
    if ((reading.seq % every == 0) != struck) continue;
    sum += reading.*what;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

void AddRows(const CameraGeometry& camera, const sim::CameraConfig& claimed, const std::vector<EdgeReading>& readings,
             double speed, base::Duration offset, int every, Report& report) {
  // An edge is found to a few hundredths of a pixel; instants 0.75 px apart take (1/N²)/2 of N instants' length.
  const double blur = claimed.motion_blur ? claimed.exposure.Seconds() : 0.0;
  const double smear = speed * blur;  // px
  const double blur_tolerance = blur > 0.0 ? blur * (0.02 + 0.3 / (smear * smear)) : 0.6 / speed;
  report.Add(Compare(camera.name, "exposure, from the blur of an edge", blur, MeanOf(readings, &EdgeReading::exposure),
                     blur_tolerance, "s"));
  const double rows = 0.6 * claimed.height;
  report.Add(Compare(camera.name, "row delay, from the slant of an edge", claimed.row_delay.Seconds(),
                     MeanOf(readings, &EdgeReading::row_delay),
                     0.01 * claimed.row_delay.Seconds() + 0.1 / (speed * rows), "s"));
  const double tolerance = 0.1 / speed + 0.002 * std::abs(offset.Seconds());
  if (offset.ns == 0 || every == 1) {
    report.Add(Compare(camera.name, "stamps' offset", offset.Seconds(), MeanOf(readings, &EdgeReading::offset),
                       tolerance, "s"));
    return;
  }
  const auto n = static_cast<std::uint32_t>(every);
  report.Add(Compare(camera.name, "stamps' offset, every " + std::to_string(every) + " frames", offset.Seconds(),
                     MeanOf(readings, &EdgeReading::offset, n, true), tolerance, "s"));
  report.Add(Compare(camera.name, "stamps' offset, other frames", 0.0, MeanOf(readings, &EdgeReading::offset, n, false),
                     tolerance, "s"));
}

}  // namespace

std::vector<EdgeRow> FindEdge(const Frame& frame, const std::vector<double>& around, const std::vector<int>& rows,
                              int window) {
  std::vector<EdgeRow> edge;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::uint8_t* row = frame.grey.data() + static_cast<std::size_t>(rows[i]) * frame.width;
    const int middle = static_cast<int>(std::lround(around[i]));
    const int low = std::max(0, middle - window), high = std::min(frame.width - 2, middle + window);
    double sum = 0.0, first = 0.0, second = 0.0;
    for (int u = low; u <= high; ++u) {
      const double step = static_cast<double>(row[u + 1]) - row[u];  // lies at u + ½
      const double x = u + 0.5 - around[i];
      sum += step;
      first += step * x;
      second += step * x * x;
    }
    edge.push_back({rows[i], around[i] + first / sum, second / sum - (first / sum) * (first / sum)});
  }
  return edge;
}

void CheckShutter(const Rig& isolated, const CameraGroup& group, const sim::SensorsConfig& claimed_sensors,
                  const std::vector<CameraGeometry>& cameras, Report& report) {
  const sim::CameraConfig& claimed = ConfigOf(claimed_sensors, group);
  const bool pair = group.kind == CameraGroup::Kind::kStereo;
  const base::Duration eye_offset = pair ? claimed_sensors.stereo->eye_offset : base::Duration{};
  const int every = pair ? claimed_sensors.stereo->eye_offset_every : 1;
  const Rig rig = WithoutNoise(isolated, group);
  const stack::CameraIntrinsics& k = cameras.front().intrinsics;
  const double speed = SpeedFor(claimed, eye_offset);
  // Along the axis a pixel is one focal length's part of a radian with either lens.
  const Swing swing{claimed.rate, k.fx, -speed / k.fx, cameras.front().X_BC};
  Swing at_rest = swing;
  at_rest.rate = 0.0;
  constexpr int kLongest = 82;  // frames
  const int frames = std::clamp(2 * every + 2, kPhases + 2, kLongest);
  const base::Duration duration = claimed.rate.SampleTime(frames) - base::Time{} + claimed.read_out;
  const auto renderer = render::MakeRenderer(rig.render, StripedWall(0.5 * kPeriod * kFar / k.fx), {});
  const std::vector<Frame> still = FramesOf(Record(rig, renderer.get(), at_rest, duration));
  const std::vector<Frame> moving = FramesOf(Record(rig, renderer.get(), swing, duration));
  for (std::size_t eye = 0; eye < cameras.size(); ++eye) {
    const CameraGeometry& camera = cameras[eye];
    const std::vector<EdgeReading> readings =
        ReadAll(camera, swing, Of(still, camera.sensor), Of(moving, camera.sensor), 90);
    const bool late = eye == 1 && 2 * every < kLongest;
    if (eye == 1 && !late)
      report.Note("an eye's offset that strikes more rarely than every 40th frame is not measured");
    AddRows(camera, claimed, readings, speed, late ? eye_offset : base::Duration{}, every, report);
  }
  report.Note("edges and sub-frames: noise of pixels off, exposure control off");
}

}  // namespace alula::scenarios::check

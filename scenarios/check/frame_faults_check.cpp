#include "scenarios/check/frame_faults_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "scenarios/check/check_worlds.h"
#include "scenarios/check/statistics.h"

namespace alula::scenarios::check {
namespace {

constexpr int kFew = 200;  // frames, to see that all are there

/// So many that a share is found to a tenth of itself (one standard deviation), but 8000 at most.
int FramesFor(double share) {
  if (share <= 0.0) return kFew;
  return static_cast<int>(std::clamp(100.0 * (1.0 - share) / share, 1000.0, 8000.0));
}

/// The group with small pictures, no noise (so that only a frozen picture repeats itself) and these faults.
Rig SmallPictures(const Rig& rig, const CameraGroup& group, const sim::FrameFaultsConfig& faults) {
  Rig bench = WithoutNoise(Isolate(rig, group), group);
  sim::CameraConfig& camera = ConfigOf(bench.sensors, Only(group));
  const std::int64_t roll = camera.row_delay.ns * (camera.height - 1);
  camera.width = 32;
  camera.height = 16;
  camera.lens = {};
  camera.fov = 1.0;
  camera.motion_blur = false;
  camera.row_delay = base::Nanoseconds(roll / (camera.height - 1));  // rolling takes as long as before
  camera.faults = faults;
  return bench;
}

/// Before a grey ramp, moving on from frame to frame: no two pictures are alike.
std::vector<Frame> RecordFrames(const Rig& bench, const CameraGroup& group, int frames) {
  const CameraGeometry camera = GeometryOf(bench, group).front();
  const sim::CameraConfig& config = ConfigOf(bench.sensors, Only(group));
  const auto renderer = render::MakeRenderer(bench.render, GreyWall(3.0), {});
  const double hertz = 0.137 * config.rate.Hz();  // of the swing: never in step with the frames
  const Motion motion = [&](base::Time t) {
    const double s = t.Seconds();
    const double x = 0.3 * std::sin(2.0 * std::numbers::pi * hertz * s) + 0.002 * s;
    const base::Transform X_WC = ChartPose() * base::Transform{base::Quat::Identity(), {x, 0.0, -2.0}};
    return vehicles::BodyState{BodyPose(X_WC, camera.X_BC), base::Vec3::Zero(), base::Vec3::Zero()};
  };
  const base::Duration duration =
      config.rate.SampleTime(frames) - base::Time{} + config.read_out + config.faults.late_by;
  std::vector<Frame> all = FramesOf(Record(bench, renderer.get(), motion, duration));
  std::sort(all.begin(), all.end(), [](const Frame& a, const Frame& b) { return a.seq < b.seq; });
  return all;
}

std::vector<Frame> Of(const std::vector<Frame>& frames, stack::SensorId sensor, int count) {
  std::vector<Frame> own;
  for (const Frame& frame : frames) {
    if (frame.sensor == sensor && frame.seq < static_cast<std::uint32_t>(count)) own.push_back(frame);
  }
  return own;
}

void AddTimes(const CameraGeometry& camera, const sim::CameraConfig& claimed, const std::vector<Frame>& frames,
              int count, Report& report) {
  const double n = static_cast<double>(frames.size());
  const double span = (frames.back().captured - frames.front().captured).Seconds();
  report.Add(Compare(camera.name, "rate", claimed.rate.Hz(), (frames.back().seq - frames.front().seq) / span,
                     1e-6 * claimed.rate.Hz(), "Hz"));
  const sim::FrameFaultsConfig& faults = claimed.faults;
  report.Add(Compare(camera.name, "share of frames lost", faults.drop, 1.0 - n / count,
                     BinomialTolerance(faults.drop, count), "1"));
  base::Duration least{std::numeric_limits<std::int64_t>::max()};
  for (const Frame& frame : frames) least = std::min(least, frame.available - frame.captured);
  report.Add(Compare(camera.name, "read-out", claimed.read_out.Seconds(), least.Seconds(), 1e-9, "s"));
  std::vector<double> late;
  for (const Frame& frame : frames) {
    const base::Duration by = frame.available - frame.captured - least;
    if (by.ns > 0) late.push_back(by.Seconds());
  }
  const auto lates = static_cast<double>(late.size());
  report.Add(
      Compare(camera.name, "share of frames late", faults.late, lates / n, BinomialTolerance(faults.late, n), "1"));
  if (faults.late > 0.0 && lates >= 10.0) {
    const double mean = std::accumulate(late.begin(), late.end(), 0.0) / lates;
    report.Add(Compare(camera.name, "lateness, twice its mean", faults.late_by.Seconds(), 2.0 * mean,
                       kSigmas * faults.late_by.Seconds() / std::sqrt(3.0 * lates), "s"));
  }
}

/// Runs of pictures equal to the one before, from which the rate of starts follows: each run of m · n frames is m
/// starts; a start may come at every frame that is not stuck, or right after n that were.
void AddFreezes(const CameraGeometry& camera, const sim::FrameFaultsConfig& claimed, const std::vector<Frame>& frames,
                Report& report) {
  double frozen = 0.0, shortest = std::numeric_limits<double>::infinity(), run = 0.0;
  for (std::size_t i = 2; i <= frames.size(); ++i) {  // frame 0 has none before it
    if (i < frames.size() && frames[i].grey == frames[i - 1].grey) {
      ++run, ++frozen;
    } else {
      // A run at the very beginning or end may have been longer.
      const bool whole = static_cast<double>(i) - run > 2.0 && i < frames.size();
      if (run > 0.0 && whole) shortest = std::min(shortest, run);
      run = 0.0;
    }
  }
  const double starts = frozen / claimed.freeze_frames;
  const double chances = std::max(1.0, static_cast<double>(frames.size()) - frozen + starts);
  report.Add(Compare(camera.name, "share of frames at which it freezes", claimed.freeze, starts / chances,
                     BinomialTolerance(claimed.freeze, chances) + (claimed.freeze > 0.0 ? 2.0 / chances : 0.0), "1"));
  if (std::isfinite(shortest)) {
    report.Add(Compare(camera.name, "frames that it stays frozen", claimed.freeze_frames, shortest, 0.0, "1"));
  }
}

}  // namespace

void CheckFrameFaults(const Rig& rig, const CameraGroup& group, const sim::CameraConfig& claimed, Report& report) {
  const sim::FrameFaultsConfig& built = ConfigOf(rig.sensors, group).faults;
  // One fault at a time: a frame that is lost cannot be seen to be frozen. Fates are drawn alike either way.
  sim::FrameFaultsConfig on_the_way = built, stuck = built;
  on_the_way.freeze = 0.0;
  stuck.drop = stuck.late = 0.0;
  const Rig first = SmallPictures(rig, group, on_the_way), second = SmallPictures(rig, group, stuck);
  const int ways = std::max(FramesFor(claimed.faults.drop), FramesFor(claimed.faults.late));
  const int freezes = FramesFor(claimed.faults.freeze);
  const std::vector<Frame> travelled = RecordFrames(first, group, ways), held = RecordFrames(second, group, freezes);
  for (const CameraGeometry& camera : GeometryOf(first, group)) {
    const std::vector<Frame> own = Of(travelled, camera.sensor, ways);
    if (own.size() < 2) {
      report.Add(Compare(camera.name, "share of frames lost", claimed.faults.drop,
                         1.0 - static_cast<double>(own.size()) / ways, 0.0, "1"));
      continue;
    }
    AddTimes(camera, claimed, own, ways, report);
    AddFreezes(camera, claimed.faults, Of(held, camera.sensor, freezes), report);
  }
}

}  // namespace alula::scenarios::check

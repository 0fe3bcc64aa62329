// Line segments of rendered views of 752×480, on one thread: detectors at full and half resolution, P0's steps
// included, and partners in the right image. Medians of processor time.
#include <algorithm>
#include <string>
#include <vector>

#include "base/processor_clock.h"
#include "bench/bench.h"
#include "stack/features/line_segments.h"
#include "stack/features/line_stereo.h"
#include "tests/scenarios/slam/photographer.h"

namespace alula::bench {
namespace {

template <typename Act>
double Ms(Act act) {
  const double start = base::ProcessorMs();
  act();
  return base::ProcessorMs() - start;
}

double Median(std::vector<double> times) {
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

}  // namespace

void Run_lines(Figures& figures) {
  using stack::features::LineDetector;
  for (const std::string world : {"machine_hall", "vicon_room"}) {
    scenarios::slam::test::Photographer photographer(world, 5);
    const stack::features::StereoRig rig = scenarios::slam::test::Rig();
    std::vector<double> half, full, lsd, stereo;
    for (const base::Transform& X_WC : scenarios::gallery::RandomViewpoints(photographer.world(), 16, 5)) {
      const stack::Image left = photographer.Picture(rig.left, X_WC);
      const stack::Image right = photographer.Picture(rig.right, X_WC * rig.X_LR);
      stack::features::LineConfig config;
      std::vector<stack::features::LineSegment> l, r;
      half.push_back(Ms([&] { l = DetectLines(left, config); }));
      r = DetectLines(right, config);
      stereo.push_back(Ms([&] { MatchLines(rig, left, right, l, r, {}); }));
      config.detector = LineDetector::kLsd;
      lsd.push_back(Ms([&] { DetectLines(left, config); }));
      config.detector = LineDetector::kEdLines;
      config.half = false;
      full.push_back(Ms([&] { DetectLines(left, config); }));
    }
    figures.Add("lines/" + world + "/edlines_half/detect_ms", Median(half));
    figures.Add("lines/" + world + "/edlines/detect_ms", Median(full));
    figures.Add("lines/" + world + "/lsd_half/detect_ms", Median(lsd));
    figures.Add("lines/" + world + "/stereo/match_ms", Median(stereo));
  }
}

}  // namespace alula::bench

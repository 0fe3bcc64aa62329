#include <gtest/gtest.h>

#include "tests/stack/estimation/track_simulator.h"

namespace alula::stack::estimation::test {
namespace {

using base::Vec2;

const std::array<Vec3, 5> kWay{Vec3(0, -6, 1.3), Vec3(-6, -5, 1.5), Vec3(-8, 0, 1.8), Vec3(-6, 5, 1.5),
                               Vec3(0, 6, 1.2)};

/// Poles and rails along the way, as a perfect detector shows them.
class LineSimulator {
 public:
  LineSimulator(const Calibration& calibration, int count, double pixel_noise, std::uint64_t seed)
      : calibration_(calibration), noise_(pixel_noise), random_(seed, "test/lines") {
    for (int i = 0; i < count; ++i) {
      const std::size_t leg = random_.Index(4);
      const Vec3 along = kWay[leg + 1] - kWay[leg];
      const double side = (random_.Index(2) == 0 ? -1.0 : 1.0) * random_.Uniform(1.2, 3.0);
      const Vec3 middle = kWay[leg] + random_.Uniform(0, 1.3) * along +
                          side * Vec3(-along.y(), along.x(), 0).normalized() + Vec3(0, 0, random_.Uniform(-0.5, 0.8));
      const Vec3 way = random_.Index(3) == 0 ? along.normalized() : Vec3::UnitZ();
      const Vec3 tilted = (way + 0.2 * random_.GaussianVec3()).normalized();
      edges_.push_back({middle - 0.8 * tilted, middle + 0.8 * tilted});
    }
  }

  std::vector<LineSighting> See(const Flight& flight, Time stamp, bool keyframe) {
    const Motion m = flight.At(stamp);
    std::vector<LineSighting> seen;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const auto left = Look(m, 0, edges_[i]);
      if (!left) continue;
      const bool known = followed_.contains(i);
      if (!known && !keyframe) continue;
      LineSighting one{i, *left, {}, {}};
      if (keyframe) {
        one.right = Look(m, 1, edges_[i]);
        const Transform X_CW = (m.X_WB * calibration_.cameras[0].X_BC).Inverse();
        // By stereo: a few per cent off.
        if (one.right && !known) {
          one.ends_L = {X_CW * edges_[i][0], X_CW * edges_[i][1]};
          for (Vec3& end : *one.ends_L) end *= 1.0 + 0.05 * random_.Gaussian();
          followed_.insert(i);
        }
        if (!known && !one.right) continue;
      }
      seen.push_back(one);
    }
    return seen;
  }

 private:
  std::optional<SeenSegment> Look(const Motion& m, std::size_t eye, const std::array<Vec3, 2>& edge) {
    const CameraIntrinsics& camera = calibration_.cameras[eye].intrinsics;
    const Transform X_CW = (m.X_WB * calibration_.cameras[eye].X_BC).Inverse();
    std::array<Vec2, 2> ends;
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec3 p = X_CW * edge[k];
      if (p.z() < 0.5 || p.z() > 20) return std::nullopt;
      const Vec2 pixel = Project(camera, p) + noise_ * Vec2(random_.Gaussian(), random_.Gaussian());
      if (!Inside(camera, pixel, 5)) return std::nullopt;
      ends[k] = Normalise(camera, pixel);
    }
    return SeenSegment{ends[0], ends[1]};
  }

  Calibration calibration_;
  double noise_;
  base::RandomStream random_;
  std::vector<std::array<Vec3, 2>> edges_;
  std::set<std::size_t> followed_;
};

struct Outcome {
  double ate = 0.0;
  int most_used = 0;
  std::vector<Vec3> estimate;
};

/// A lap with `points` random points in all, of which a handful are in view, and with or without lines.
Outcome Fly(int points, int lines, std::uint64_t seed, const WindowConfig& config) {
  const Flight flight({0, -6, 0.1}, M_PI, {kWay.begin() + 1, kWay.end()}, 2.0, 1.0, false);
  const Calibration truth = TrueCalibration();
  TrackSimulator tracks(truth, truth, {-12, -9, 0}, {12, 9, 4}, points, 0.5, 0.0, seed);
  LineSimulator edges(truth, lines, 0.5, seed);
  const std::vector<TimedImu> imu = SimulateImu(flight, *truth.imu, seed);
  LinesConfig with;
  with.enabled = true;
  with.sigma = 0.5;
  SlidingWindow window(features::MakeRig(truth), truth.imu->X_BI.Inverse() * truth.cameras[0].X_BC, truth.imu->noise,
                       config, with);
  Outcome outcome;
  std::vector<Vec3> real;
  for (Time stamp{500'000'000}; stamp + base::Milliseconds(60) < flight.end(); stamp += base::Milliseconds(50)) {
    const TrackSimulator::Pair pair = tracks.See(flight, stamp);
    const Transform X_WI = flight.At(stamp).X_WB * truth.imu->X_BI;
    if (window.frames() == 0) {
      ImuState state;
      state.stamp = stamp;
      state.X_OI = X_WI;
      StartSigmas sigmas;
      sigmas.accel_bias = truth.imu->noise.accelerometer_turn_on_bias;
      window.Start(state, sigmas, pair.sightings, edges.See(flight, stamp, true));
      continue;
    }
    window.AddFrame(Cut(imu, window.Newest().stamp, stamp), pair.sightings, pair.keyframe,
                    edges.See(flight, stamp, pair.keyframe));
    EXPECT_TRUE(window.Solve());
    outcome.most_used = std::max(outcome.most_used, window.UsedLines());
    window.RejectOutliers();
    outcome.estimate.push_back(window.Newest().X_OI.p);
    real.push_back(X_WI.p);
    window.Slide();
  }
  outcome.ate = AlignedError(outcome.estimate, real);
  return outcome;
}

TEST(WindowLines, HelpWherePointsAreFew) {
  WindowConfig config;
  config.pixel_sigma = 0.5;
  double without = 0.0, with = 0.0;
  for (const std::uint64_t seed : {1ULL, 2ULL, 3ULL}) {
    without += Fly(60, 0, seed, config).ate / 3;
    const Outcome o = Fly(60, 300, seed, config);
    EXPECT_GT(o.most_used, 5);
    with += o.ate / 3;
  }
  std::printf("ATE with few points: %.3f m, with lines beside them %.3f m\n", without, with);
  EXPECT_LT(with, 0.9 * without);
}

TEST(WindowLines, BothSolversFindTheSameAndTheSameBitsTwice) {
  WindowConfig config;
  config.iterations = 10;
  const Outcome ours = Fly(400, 80, 4, config), again = Fly(400, 80, 4, config);
  config.solver = WindowSolver::kCeres;
  const Outcome reference = Fly(400, 80, 4, config);
  double apart = 0.0;
  for (std::size_t i = 0; i < ours.estimate.size(); ++i) {
    EXPECT_EQ(ours.estimate[i], again.estimate[i]);
    apart = std::max(apart, (ours.estimate[i] - reference.estimate[i]).norm());
  }
  EXPECT_LT(apart, 0.05);  // both end where a step gains less than 1e-4 of the cost, and sights are dropped by that
}

}  // namespace
}  // namespace alula::stack::estimation::test

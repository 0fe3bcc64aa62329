#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "base/hash.h"
#include "tests/stack/estimation/track_simulator.h"

namespace alula::stack::estimation::test {
namespace {

struct Outcome {
  double ate = 0.0;
  double nees_position = 0.0, nees_attitude = 0.0, nees_velocity = 0.0;  // means; 3 each where the model is exact
  std::uint64_t digest = 0;
  CalibrationEstimate rig;
};

/// A lap of 30 m round a yard with tracks of random points.
Outcome Fly(std::uint64_t seed, double errors, const WindowConfig& config, double blind_from = 1e9,
            double blind_to = 1e9) {
  const std::vector<Vec3> corners = {{-6, -5, 1.5}, {-8, 0, 1.8}, {-6, 5, 1.5}, {0, 6, 1.2}, {4, 5, 1.4}};
  const Flight flight({0, -6, 0.1}, M_PI, corners, 2.0, 1.0, false);
  const Calibration truth = TrueCalibration(), told = WrongCalibration(truth, seed, errors);
  TrackSimulator tracks(truth, told, {-12, -9, 0}, {12, 9, 4}, 1500, 0.5, errors * DrawTimeOffset(seed), seed);
  const std::vector<TimedImu> imu = SimulateImu(flight, *truth.imu, seed);
  SlidingWindow window(features::MakeRig(told), truth.imu->X_BI.Inverse() * told.cameras[0].X_BC, truth.imu->noise,
                       config);
  base::RandomStream random(seed, "test/start");
  std::vector<Vec3> estimate, real;
  base::RollingHash digest;
  Outcome outcome;
  int checks = 0;
  for (Time stamp{500'000'000}; stamp + base::Milliseconds(60) < flight.end(); stamp += base::Milliseconds(50)) {
    TrackSimulator::Pair pair = tracks.See(flight, stamp);
    if (stamp.Seconds() > blind_from && stamp.Seconds() < blind_to) pair = {};
    const Motion m = flight.At(stamp);
    const Transform X_WI = m.X_WB * truth.imu->X_BI;
    if (window.frames() == 0) {
      ImuState state;
      state.stamp = stamp;
      state.X_OI = {base::Exp(Vec3(0.005 * random.Gaussian(), 0.005 * random.Gaussian(), 0)) * X_WI.q, X_WI.p};
      StartSigmas sigmas;
      sigmas.accel_bias = truth.imu->noise.accelerometer_turn_on_bias;
      window.Start(state, sigmas, pair.sightings);
      continue;
    }
    window.AddFrame(Cut(imu, window.Newest().stamp, stamp), pair.sightings, pair.keyframe);
    EXPECT_TRUE(window.Solve());
    window.RejectOutliers();
    const ImuState s = window.Newest();
    digest.Add(s.X_OI);
    estimate.push_back(s.X_OI.p);
    real.push_back(X_WI.p);
    if (estimate.size() % 10 == 0) {
      const Mat15 C = window.NewestCovariance();
      const auto nees = [&C](const Vec3& e, int at) {
        const base::Mat3 block = C.block<3, 3>(at, at);
        return double(e.transpose() * block.ldlt().solve(e));
      };
      outcome.nees_position += nees(s.X_OI.p - X_WI.p, 0);
      outcome.nees_attitude += nees(base::Log(X_WI.q.conjugate() * s.X_OI.q), 3);
      outcome.nees_velocity += nees(s.v_OI - m.v_W - X_WI.q * m.w_B.cross(truth.imu->X_BI.p), 6);
      ++checks;
    }
    window.Slide();
  }
  outcome.nees_position /= checks;
  outcome.nees_attitude /= checks;
  outcome.nees_velocity /= checks;
  outcome.ate = AlignedError(estimate, real);
  outcome.digest = digest.value();
  outcome.rig = window.Rig();
  return outcome;
}

TEST(SlidingWindow, FollowsAFlightAndKnowsHowWell) {
  WindowConfig config;
  config.pixel_sigma = 0.5;  // what the tracks have
  config.imu_noise_scale = 1.0;
  double position = 0, attitude = 0, velocity = 0;
  constexpr int kSeeds = 3;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Outcome o = Fly(seed, 0.0, config);
    EXPECT_LT(o.ate, 0.08) << seed;
    position += o.nees_position / kSeeds;
    attitude += o.nees_attitude / kSeeds;
    velocity += o.nees_velocity / kSeeds;
  }
  // Three degrees of freedom each: 3 where the model is exact. Errors within a flight are one slow drift, so three
  // flights are about three samples of position and heading (χ² with 9: 99.9 % at 27.9/3).
  EXPECT_LT(position, 9.3);
  EXPECT_LT(attitude, 9.3);
  EXPECT_LT(velocity, 9.3);
}

TEST(SlidingWindow, RefinesAWrongCalibration) {
  constexpr std::uint64_t kSeed = 4;
  const Outcome o = Fly(kSeed, 1.0, {});
  EXPECT_LT(o.ate, 0.12);
  const Calibration truth = TrueCalibration(), told = WrongCalibration(truth, kSeed, 1.0);
  const auto between = [](const Calibration& c) { return c.cameras[0].X_BC.Inverse() * c.cameras[1].X_BC; };
  const Vec3 eye = base::Log(between(told).q.conjugate() * between(truth).q);
  EXPECT_NEAR(o.rig.time_offset, DrawTimeOffset(kSeed), 0.5e-3);
  EXPECT_NEAR(o.rig.eye_rotation.y(), eye.y(), 1e-4);  // yaw of an eye: the disparity of things far away
}

TEST(SlidingWindow, SurvivesABlindSecond) { EXPECT_LT(Fly(5, 1.0, {}, 8.0, 9.0).ate, 0.15); }

TEST(SlidingWindow, GivesTheSameBitsTwice) { EXPECT_EQ(Fly(6, 1.0, {}).digest, Fly(6, 1.0, {}).digest); }

}  // namespace
}  // namespace alula::stack::estimation::test

// `alula export` as a user meets it: what it writes is true, reads back, and can be flown again.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "scenarios/dataset/euroc_reader.h"
#include "tests/scenarios/command.h"
#include "tests/scenarios/dataset/reprojection.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::dataset {
namespace {

namespace fs = std::filesystem;
using scenarios::testing::Alula;
using scenarios::testing::CommandResult;
using scenarios::testing::ReadText;
using scenarios::testing::TemporaryFolder;
using testing::FollowCorners;
using testing::Reproject;
using testing::ReprojectionFigures;
using testing::Track;

/// Some seconds through the courtyard: straight on, a turn to the left, straight on.
std::vector<std::string> ShortFlight(std::vector<std::string> arguments) {
  for (const char* set :
       {"vehicle.motion.waypoints=[[-9 m, -5 m, 3.7 m], [-5.5 m, -5.2 m, 3.9 m], [-4.5 m, -2 m, 4 m]]",
        "vehicle.motion.speed=2.2 m/s", "vehicle.motion.knot_interval=0.3 s", "vehicle.standstill=0.2 s",
        "sensors.stereo.rate=10 Hz"}) {
    arguments.insert(arguments.end(), {"--set", set});
  }
  return arguments;
}

/// One export for all tests of this file.
class Export : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>("export");
    const CommandResult run =
        Alula(ShortFlight({"export", "prescribed_flight", "--quiet", "--out", folder_->path() / "euroc"}));
    ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
    EXPECT_NE(run.out.find(" images, 0 depth images, "), std::string::npos) << run.out;
    recording_ = ReadEuroc(folder_->path() / "euroc");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::unique_ptr<TemporaryFolder> folder_;
  static Recording recording_;
};
std::unique_ptr<TemporaryFolder> Export::folder_;
Recording Export::recording_;

void Print(const char* what, const ReprojectionFigures& f) {
  std::printf("%-40s median reprojection error left %.3f px, right %.3f px (%zu landmarks, %zu + %zu sightings)\n",
              what, f.median[0], f.median[1], f.landmarks, f.sightings[0], f.sightings[1]);
}

constexpr double kBound = 0.3;  // px
bool Passes(const ReprojectionFigures& f) { return f.median[0] < kBound && f.median[1] < kBound; }

TEST_F(Export, LandmarksReprojectIntoBothEyes) {
  const std::vector<Track> tracks = FollowCorners(recording_, 4, 4);
  const ReprojectionFigures right = Reproject(recording_, tracks);
  Print("as exported", right);
  EXPECT_GT(right.landmarks, 300u);
  EXPECT_TRUE(Passes(right));

  // The check sees what it must: each of these is wrong by little.
  const auto tampered = [&](const char* what, const auto& tamper) {
    Recording wrong = recording_;
    tamper(wrong);
    const ReprojectionFigures figures = Reproject(wrong, tracks);
    Print(what, figures);
    EXPECT_FALSE(Passes(figures)) << what;
  };
  const base::Duration late = base::Milliseconds(5);
  tampered("right eye's stamps 5 ms late", [&](Recording& r) {
    for (ImageFile& image : r.images[1]) image.captured += late;
  });
  tampered("every second pair's stamp 5 ms late", [&](Recording& r) {
    for (std::size_t i = 0; i < r.images[0].size(); i += 2) {
      r.images[0][i].captured += late;
      r.images[1][i].captured += late;
    }
  });
  const double half_degree = 0.5 * M_PI / 180;
  for (int axis = 0; axis < 3; ++axis) {
    const base::Quat turn = base::Exp(half_degree * base::Vec3::Unit(axis));
    const std::string name = std::string("right eye turned by 0.5 deg about its ") + "xyz"[axis];
    tampered(name.c_str(), [&](Recording& r) {
      base::Transform& X_BC = r.calibration.cameras[1].X_BC;
      X_BC.q = X_BC.q * turn;
    });
  }
}

TEST_F(Export, SamplesAreWhereTheyShouldBe) {
  ASSERT_EQ(recording_.calibration.cameras.size(), 2u);
  const double span = (recording_.truth.back().time - recording_.truth.front().time).Seconds();
  EXPECT_GT(span, 4.0);
  EXPECT_NEAR(static_cast<double>(recording_.images[0].size()), span * 10, 2);
  EXPECT_NEAR(static_cast<double>(recording_.imu.size()), span * 200, 3);
  EXPECT_NEAR(static_cast<double>(recording_.truth.size()), span * 200 + 1, 1);
  for (std::size_t i = 0; i < recording_.images[0].size(); ++i) {
    EXPECT_EQ(recording_.images[0][i].captured, recording_.images[1][i].captured);
  }
  EXPECT_NEAR(recording_.calibration.cameras[0].X_BC.p.y() - recording_.calibration.cameras[1].X_BC.p.y(), 0.11, 1e-12);
}

TEST_F(Export, InertialReadingsIntegrateToTheGroundTruth) {
  // From the first pose on, with the true biases taken off: mid-point integration over the whole flight. White noise of
  // 1.7e-4 rad/s/√Hz leaves 1.7e-4 √5 = 4e-4 rad of attitude, which with gravity and the accelerometer's own
  // 2e-3 m/s²/√Hz comes to some 1–2 cm after 5 s; four times that is allowed.
  const std::vector<ImuReading>& imu = recording_.imu;
  const auto truth_at = [&](base::Time t) {
    return std::min_element(
        recording_.truth.begin(), recording_.truth.end(),
        [&](const BodyTruth& a, const BodyTruth& b) { return std::abs((a.time - t).ns) < std::abs((b.time - t).ns); });
  };
  auto truth = truth_at(imu.front().time);
  base::Transform X = truth->X_WB;
  base::Vec3 v = truth->v_WB;
  for (std::size_t i = 1; i < imu.size(); ++i) {
    const double dt = (imu[i].time - imu[i - 1].time).Seconds();
    truth = truth_at(imu[i].time);
    const base::Vec3 w = 0.5 * (imu[i].sample.angular_velocity + imu[i - 1].sample.angular_velocity) - truth->gyro_bias;
    const base::Vec3 f =
        0.5 * (imu[i].sample.specific_force + imu[i - 1].sample.specific_force) - truth->accelerometer_bias;
    const base::Vec3 a = (X.q * base::Exp(0.5 * dt * w)) * f - base::Vec3(0, 0, base::kGravity);
    X.p += dt * v + 0.5 * dt * dt * a;
    v += dt * a;
    X.q = (X.q * base::Exp(dt * w)).normalized();
  }
  // The last reading lies up to half a ground-truth period from the nearest row.
  const base::Vec3 p_end = truth->X_WB.p + (imu.back().time - truth->time).Seconds() * truth->v_WB;
  std::printf("after %.1f s of integration: %.1f mm, %.3f deg from the ground truth\n",
              (imu.back().time - imu.front().time).Seconds(), 1e3 * (X.p - p_end).norm(),
              180 / M_PI * base::Log(truth->X_WB.q.conjugate() * X.q).norm());
  EXPECT_LT((X.p - p_end).norm(), 0.08);
  EXPECT_LT(base::Log(truth->X_WB.q.conjugate() * X.q).norm(), 4e-3);
}

TEST_F(Export, CanBeFlownAgainFromItsFile) {
  const fs::path again = folder_->path() / "again";
  const std::string file = folder_->path() / "euroc" / "mav0" / "state_groundtruth_estimate0" / "data.csv";
  const CommandResult run =
      Alula({"export", "prescribed_flight", "--quiet", "--out", again, "--set", "vehicle.standstill=0 s", "--set",
             "vehicle.motion={type: file, path: " + file + ", frame_position: [20 mm, 0 mm, -10 mm]}", "--set",
             "sensors.stereo=~"});
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  const Recording flown = ReadEuroc(again);
  ASSERT_NEAR(static_cast<double>(flown.truth.size()), static_cast<double>(recording_.truth.size()), 1);
  double position = 0, angle = 0, speed = 0;
  for (std::size_t i = 0; i < std::min(flown.truth.size(), recording_.truth.size()); ++i) {
    const BodyTruth &a = recording_.truth[i], &b = flown.truth[i];
    ASSERT_EQ(a.time, b.time);
    position = std::max(position, (a.X_WB.p - b.X_WB.p).norm());
    angle = std::max(angle, base::Log(a.X_WB.q.conjugate() * b.X_WB.q).norm());
    speed = std::max(speed, (a.v_WB - b.v_WB).norm());
  }
  std::printf("flown again: at most %.3f mm, %.4f deg, %.2f mm/s from the first flight\n", 1e3 * position,
              180 / M_PI * angle, 1e3 * speed);
  EXPECT_LT(position, 0.003);
  EXPECT_LT(angle, 0.1 * M_PI / 180);
}

TEST_F(Export, RunWritesTheSameDatasetAndTheSameDigest) {
  const fs::path plain = folder_->path() / "plain", with = folder_->path() / "with";
  ASSERT_EQ(Alula(ShortFlight({"run", "prescribed_flight", "--quiet", "--out", plain})).exit_code, 0);
  ASSERT_EQ(Alula(ShortFlight({"run", "prescribed_flight", "--quiet", "--out", with, "--dataset"})).exit_code, 0);
  const auto digest = [](const fs::path& folder) {
    const std::string text = ReadText(folder / "verdict.json");
    const std::size_t at = text.find("\"digest\"");
    return text.substr(at, text.find('\n', at) - at);
  };
  EXPECT_EQ(digest(plain), digest(with));
  EXPECT_FALSE(fs::exists(plain / "dataset"));
  const fs::path mav = folder_->path() / "euroc" / "mav0";
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(mav)) {
    if (!entry.is_regular_file()) continue;
    ++files;
    EXPECT_EQ(ReadText(entry.path()), ReadText(with / "dataset" / "mav0" / fs::relative(entry.path(), mav)))
        << entry.path();
  }
  EXPECT_GT(files, 80u);
  // A run without a dataset takes the old one away: what lies in a run folder is one run's.
  ASSERT_EQ(
      Alula(ShortFlight({"run", "prescribed_flight", "--quiet", "--out", with, "--set", "sensors.stereo=~"})).exit_code,
      0);
  EXPECT_FALSE(fs::exists(with / "dataset"));
}

TEST(ExportCommand, BadInputIsOneLine) {
  const TemporaryFolder folder("export_bad");
  std::ofstream(folder.path() / "bad.tum") << "0 0 0 1 0 0 0 1\n0.05 0 0 x 0 0 0 1\n";
  const std::string motion = "vehicle.motion={type: file, path: bad.tum}";
  struct Bad {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::vector<Bad> table = {
      {{"export", "hover", "--format", "tum"}, "needs a depth camera"},
      {{"export", "hover", "--format", "kitti"}, "--format"},
      {{"run", "hover", "--dataset", "kitti"}, "--dataset"},
      {{"export", "hover", "--set", "sensors.imu=~"}, "neither"},
      {{"export", "prescribed_flight", "--set", motion}, "bad.tum:2: p_z: `x` is not a finite number"},
      {{"export", "prescribed_flight", "--set", "vehicle.motion={type: file}"}, "path"},
      {{"check", "prescribed_flight", "--set", motion}, "bad.tum:2"},
  };
  for (const Bad& bad : table) {
    const CommandResult run = Alula(bad.arguments, {.directory = folder.path()});
    EXPECT_EQ(run.exit_code, 2) << bad.message << '\n' << run.err;
    EXPECT_NE(run.err.find(bad.message), std::string::npos) << "wanted: " << bad.message << "\nsaid: " << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  EXPECT_FALSE(fs::exists(folder.path() / "datasets"));
  EXPECT_FALSE(fs::exists(folder.path() / "runs"));
}

TEST(ExportCommand, AnInterruptLeavesNothingBehind) {
  const TemporaryFolder folder("export_interrupt");
  const CommandResult run =
      Alula({"export", "hover", "--set", "stack.dwell=600 s", "--set", "criteria=[{type: time_limit, limit: 3600 s}]"},
            {.directory = folder.path(), .interrupt_when_err_has_lines = 1});
  EXPECT_EQ(run.exit_code, 130) << run.err;
  EXPECT_EQ(fs::directory_iterator(folder.path()), fs::directory_iterator());
}

}  // namespace
}  // namespace alula::scenarios::dataset

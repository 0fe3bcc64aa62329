// A recorded trajectory flown again: closed forms go in through a file, and the motion that comes out is compared.
#include "vehicles/file_motion.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>

#include "base/error.h"
#include "base/random.h"
#include "base/trajectory_file.h"
#include "vehicles/spline_fit.h"

namespace alula::vehicles {
namespace {

using base::Quat;
using base::Vec3;

/// A file of its own for one test, gone afterwards.
class TrajectoryText {
 public:
  explicit TrajectoryText(const std::string& text) {
    path_ = std::filesystem::temp_directory_path() / ("alula_trajectory_" + std::to_string(::getpid()));
    std::ofstream(path_) << text;
  }
  ~TrajectoryText() { std::filesystem::remove(path_); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// A closed form with its derivatives: a figure of eight whose attitude swings about all three axes. Angular velocity
/// from the rates of yaw, pitch and roll (z-y'-x'').
struct Truth {
  Vec3 p, v;
  Quat q;
  Vec3 w;
};
Truth FigureOfEight(double t) {
  const double a = 0.8, b = 1.6;  // rad/s
  const double yaw = 0.9 * std::sin(0.7 * t), pitch = 0.3 * std::sin(1.9 * t), roll = 0.4 * std::cos(1.3 * t);
  const double yaw_rate = 0.63 * std::cos(0.7 * t), pitch_rate = 0.57 * std::cos(1.9 * t);
  const double roll_rate = -0.52 * std::sin(1.3 * t);
  return {{3 * std::sin(a * t), 1.5 * std::sin(b * t), 1.5 + 0.3 * std::cos(a * t)},
          {3 * a * std::cos(a * t), 1.5 * b * std::cos(b * t), -0.3 * a * std::sin(a * t)},
          base::FromYawPitchRoll(yaw, pitch, roll),
          {roll_rate - yaw_rate * std::sin(pitch),
           pitch_rate * std::cos(roll) + yaw_rate * std::sin(roll) * std::cos(pitch),
           -pitch_rate * std::sin(roll) + yaw_rate * std::cos(roll) * std::cos(pitch)}};
}

using PoseAt = std::function<base::Transform(double)>;
base::Transform EightPose(double t) { return {FigureOfEight(t).q, FigureOfEight(t).p}; }

std::string Tum(const PoseAt& pose, double duration, double rate, double epoch = 1305031102.25) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  char line[256];
  for (int i = 0; i <= std::lround(duration * rate); ++i) {
    const base::Transform X = pose(i / rate);
    std::snprintf(line, sizeof line, "%.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", epoch + i / rate, X.p.x(), X.p.y(),
                  X.p.z(), X.q.x(), X.q.y(), X.q.z(), X.q.w());
    text += line;
  }
  return text;
}

std::string Euroc(const PoseAt& pose, double duration, double rate) {
  std::string text = "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n";
  char line[256];
  for (int i = 0; i <= std::lround(duration * rate); ++i) {
    const base::Transform X = pose(i / rate);
    std::snprintf(line, sizeof line, "%lld,%.9f,%.9f,%.9f,%.9f,%.9f,%.9f,%.9f,0,0,0,0,0,0,0,0,0\n",
                  1403715273262142976LL + std::llround(i / rate * 1e9), X.p.x(), X.p.y(), X.p.z(), X.q.w(), X.q.x(),
                  X.q.y(), X.q.z());
    text += line;
  }
  return text;
}

std::string Complaint(const FileMotion& config, double standstill) {
  try {
    const FittedMotion motion(config, standstill);
  } catch (const base::InputError& e) {
    return e.what();
  }
  return {};
}

TEST(FileMotion, FollowsAClosedForm) {
  // On knots of h = 0.1 s a quintic's error is of the order (ωh)⁶ of the amplitude: (1.9·0.1)⁶ = 5e-5 of 0.3 rad at
  // most. At the ends the splines rest on samples of one side only, so there is more room.
  for (const std::string& text : {Tum(EightPose, 10, 100), Euroc(EightPose, 10, 200)}) {
    const TrajectoryText file(text);
    const FittedMotion motion({.path = file.path()}, 0);
    EXPECT_NEAR(motion.duration(), 10, 1e-9);
    EXPECT_LT(motion.position_rms(), 1e-6);
    EXPECT_LT(motion.attitude_rms(), 1e-6);
    for (double t = 0.1; t < 9.9; t += 0.0137) {
      const Truth truth = FigureOfEight(t);
      const FlatAttitude attitude = motion.Attitude(t);
      EXPECT_LT((motion.Position(t) - truth.p).norm(), 1e-6);
      EXPECT_LT((motion.Velocity(t) - truth.v).norm(), 1e-4);
      EXPECT_LT(base::Log(truth.q.conjugate() * attitude.q_WB).norm(), 2e-6);
      EXPECT_LT((attitude.w_B - truth.w).norm(), 1e-4);
    }
    EXPECT_LT((motion.Position(0) - FigureOfEight(0).p).norm(), 1e-5);
    EXPECT_LT((motion.Position(10) - FigureOfEight(10).p).norm(), 1e-5);
  }
}

TEST(FileMotion, AngularVelocityAndAccelerationHaveNoSteps) {
  const TrajectoryText file(Tum(EightPose, 4, 100));
  const FittedMotion motion({.path = file.path()}, 0);
  const double h = 1e-4;
  for (double t = 0.05; t < 3.95; t += 0.0025) {  // every knot (0.1 s) is met
    const FlatAttitude a = motion.Attitude(t - h), s = motion.Attitude(t), b = motion.Attitude(t + h);
    // Central differences: error h² ω‴/6, below 1e-7; rounding 1e-16 / h.
    EXPECT_LT((base::Log(a.q_WB.conjugate() * b.q_WB) / (2 * h) - s.w_B).norm(), 1e-7);
    // A step of angular acceleration, or of its derivative, would leave w″·h² + step·h.
    EXPECT_LT((b.w_B - 2 * s.w_B + a.w_B).norm(), 2e-7);
    EXPECT_LT(((motion.Position(t + h) - motion.Position(t - h)) / (2 * h) - motion.Velocity(t)).norm(), 1e-7);
  }
}

TEST(FileMotion, AnImuIntegratesToThePoses) {
  // A vehicle made from noisy poses: mid-point integration of its own rates and velocities, as an IMU's reader would,
  // comes back to its own poses, however the file's noise has bent them.
  base::RandomStream random(5, "noise");
  const auto noisy = [&](double t) {
    base::Transform X = EightPose(t);
    X.p += 1e-3 * random.GaussianVec3();
    X.q = X.q * base::Exp(2e-3 * random.GaussianVec3());
    return X;
  };
  const TrajectoryText file(Tum(noisy, 5, 100));
  PrescribedConfig config;
  config.standstill = 0;
  config.motion = FileMotion{.path = file.path()};
  const auto vehicle = MakePrescribed(config, "vehicle0");
  const base::Duration step = base::Milliseconds(1);
  BodyState state = vehicle->Prescribed({0});
  base::Transform X = state.X_WB;
  Vec3 v = state.v_WB;
  for (base::Time t{}; t + step <= *vehicle->PrescribedEnd(); t += step) {
    const BodyState a = vehicle->Prescribed(t), b = vehicle->Prescribed(t + step);
    // Specific force of the step's mean acceleration in the body, and the gyro's mean reading.
    const Vec3 gyro = 0.5 * (a.w_B + b.w_B);
    const Quat middle = (a.X_WB.q * base::Exp(0.5 * step.Seconds() * gyro)).normalized();
    const Vec3 force = middle.conjugate() * ((b.v_WB - a.v_WB) / step.Seconds() + Vec3(0, 0, base::kGravity));
    const Quat own_middle = (X.q * base::Exp(0.5 * step.Seconds() * gyro)).normalized();
    const Vec3 acceleration = own_middle * force - Vec3(0, 0, base::kGravity);
    X.p += step.Seconds() * v + 0.5 * step.Seconds() * step.Seconds() * acceleration;
    v += step.Seconds() * acceleration;
    X.q = (X.q * base::Exp(step.Seconds() * gyro)).normalized();
  }
  const BodyState end = vehicle->Prescribed(*vehicle->PrescribedEnd());
  // The mid-point rule's error is of second order: 5 s · (1 ms)²/12 · w″ (noise makes w″ up to 500 rad/s³): 2e-4 rad,
  // which tilts gravity by 2e-3 m/s² for 5 s.
  EXPECT_LT(base::Log(end.X_WB.q.conjugate() * X.q).norm(), 2e-4);
  EXPECT_LT((v - end.v_WB).norm(), 2e-3);
  EXPECT_LT((X.p - end.X_WB.p).norm(), 5e-3);
}

TEST(FileMotion, StandsStillBeforeItSetsOff) {
  // Sets off smoothly from rest: s = t⁴/(1 + t³) m.
  const auto from_rest = [](double t) {
    return base::Transform{base::FromYaw(0.1 * t * t * t / (1 + t * t)), {t * t * t * t / (1 + t * t * t), 1, 2}};
  };
  const TrajectoryText file(Tum(from_rest, 3, 100));
  const FittedMotion motion({.path = file.path()}, 2.0);
  // Leaving the standstill, the fit rings by less than 1e-3 h²; that dies down by 0.43 from knot to knot (the largest
  // root of the quintic's Euler–Frobenius polynomial): 4e-5 of it after twelve.
  for (double t = -2; t < -1.2; t += 0.01) {
    EXPECT_LT((motion.Position(t) - Vec3(0, 1, 2)).norm(), 1e-7);
    EXPECT_LT(motion.Velocity(t).norm(), 1e-6);
    EXPECT_LT(motion.Attitude(t).w_B.norm(), 1e-6);
  }
  for (double t = 0; t < 2.9; t += 0.01) EXPECT_LT((motion.Position(t) - from_rest(t).p).norm(), 1e-5);
}

TEST(FileMotion, PosesOfAnotherFrameInAnotherWorld) {
  const Vec3 p_BS(0.02, -0.03, 0.01), angles(0.3, -0.2, 1.1), origin(4, -2, 0.5);
  const base::Transform X_BS{base::FromYawPitchRoll(angles.x(), angles.y(), angles.z()), p_BS};
  const base::Transform X_WF{base::FromYaw(0.7), origin};
  const TrajectoryText file(Tum([&](double t) { return X_WF.Inverse() * EightPose(t) * X_BS; }, 4, 100));
  const FittedMotion motion(
      {.path = file.path(), .frame_position = p_BS, .frame_orientation = angles, .origin = origin, .yaw = 0.7}, 0);
  for (double t = 0.1; t < 3.9; t += 0.05) {
    EXPECT_LT((motion.Position(t) - FigureOfEight(t).p).norm(), 2e-6);
    EXPECT_LT(base::Log(FigureOfEight(t).q.conjugate() * motion.Attitude(t).q_WB).norm(), 2e-6);
  }
}

TEST(FileMotion, BridgesShortGaps) {
  std::string text = Tum(EightPose, 4, 100, 0.0), thinned = "";
  int line = 0;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = text.find('\n', begin) + 1;
    if (line < 150 || line >= 168) thinned += text.substr(begin, end - begin);  // 0.18 s are missing
    begin = end;
  }
  const TrajectoryText file(thinned);
  const FittedMotion motion({.path = file.path()}, 0);
  for (double t = 1.4; t < 1.8; t += 0.01) EXPECT_LT((motion.Position(t) - FigureOfEight(t).p).norm(), 1e-4);
}

TEST(FileMotion, RefusesWhatItCannotFollow) {
  const std::string good = Tum(EightPose, 2, 100, 0.0);
  struct Bad {
    std::string text, message;
    double standstill = 0;
  };
  const std::vector<Bad> table = {
      {"", "holds 0 poses"},
      {"0 0 0 0 0 0 0 1\n", "holds 1 poses"},
      {"0 0 0 0 0 0 1\n", ":1: q_w: is missing"},
      {"0 0 0 nan 0 0 0 1\n", ":1: p_z: `nan`"},
      {"# c\n0 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n", ":3: timestamp: is not later than that of line 2"},
      {"0 0 0 0 0 0 0 1\n-1 0 0 0 0 0 0 1\n", ":2: timestamp: is not later"},
      {"0 0 0 0 1 1 0 1\n", ":1: quaternion: has the length 1.73"},
      {"0,0,0,0,1,0,0,0\n0.5,0,0,0,1,0,0,0\n", ":2: timestamp: `0.5` is not a whole number"},
      {"0 0 0 0 0 0 0 1\n9 0 0 0 0 0 0 1\n", ":2: timestamp: follows 9 s after the last one"},
      {"0 0 0 0 0 0 0 1\n0.05 0 0 0 0 0 0 1\n", "covers 0.05 s"},
      {good, "begins in motion", 1.0},
      {Tum(
           [](double t) {
             return base::Transform{Quat::Identity(), {0, 0, 0.2 * std::sin(70 * t)}};
           },
           2, 100),
       "misses the file's positions by"},
      {Tum(
           [](double t) {
             return base::Transform{base::FromYaw(0.2 * std::sin(70 * t)), {0, 0, 1}};
           },
           2, 100),
       "misses the file's attitudes by"},
  };
  for (const Bad& bad : table) {
    const TrajectoryText file(bad.text);
    const std::string said = Complaint({.path = file.path()}, bad.standstill);
    EXPECT_NE(said.find(bad.message), std::string::npos) << "wanted: " << bad.message << "\nsaid: " << said;
    EXPECT_NE(said.find(file.path()), std::string::npos) << said;
  }
  EXPECT_NE(Complaint({.path = "/nowhere"}, 0).find("/nowhere: cannot be read"), std::string::npos);
  const TrajectoryText file(good);
  EXPECT_EQ(Complaint({.path = file.path()}, 0), "");
  PrescribedConfig config{
      .standstill = 0, .motion = FileMotion{.path = file.path()}, .attitude = SineAttitude{}, .body = {}};
  EXPECT_THROW(MakePrescribed(config, "vehicle0"), base::InputError);
}

TEST(SplineFit, SolvesItsNormalEquations) {
  // Against the dense solution of the same problem.
  base::RandomStream random(1, "fit");
  std::vector<double> u;
  std::vector<Vec3> samples;
  for (int i = 0; i < 60; ++i) {
    u.push_back(i * 7.0 / 59);
    samples.push_back(random.GaussianVec3());
  }
  const SplineFit fit(u, 7);
  const int n = fit.controls();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(60 + n - 3, n), b = Eigen::MatrixXd::Zero(60 + n - 3, 3);
  for (int i = 0; i < 60; ++i) {
    const SplineFit::Place& place = fit.places()[static_cast<std::size_t>(i)];
    for (int j = 0; j < 6; ++j) A(i, place.segment + j) = place.basis.value[static_cast<std::size_t>(j)];
    b.row(i) = samples[static_cast<std::size_t>(i)].transpose();
  }
  const double root = std::sqrt(1e-6 * 60 / 7);
  for (int r = 0; r < n - 3; ++r) A.block(60 + r, r, 1, 4) = root * Eigen::RowVector4d(-1, 3, -3, 1);
  const Eigen::MatrixXd dense = (A.transpose() * A).ldlt().solve(A.transpose() * b);
  const std::vector<Vec3> banded = fit.Solve(samples);
  for (int i = 0; i < n; ++i) {
    // The condition number of the normal equations is some 1e6.
    EXPECT_LT((banded[static_cast<std::size_t>(i)] - dense.row(i).transpose()).norm(), 1e-8 * dense.norm());
  }
}

TEST(QuinticBasis, IsThatOfTheSpline) {
  for (double t = 0; t <= 1; t += 0.125) {
    const QuinticBasis basis = QuinticBasisAt(t);
    for (std::size_t j = 0; j < 6; ++j) {
      std::vector<double> control(6, 0.0);
      control[j] = 1;
      EXPECT_NEAR(basis.value[j], QuinticSpline<double>(control).Derivative(t, 0), 1e-15);
      EXPECT_NEAR(basis.slope[j], QuinticSpline<double>(control).Derivative(t, 1), 1e-14);
    }
  }
}

}  // namespace
}  // namespace alula::vehicles

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "stack/estimation/imu_preintegration.h"
#include "tests/stack/estimation/data.h"
#include "tests/stack/estimation/flight.h"

namespace alula::stack::estimation::test {
namespace {

using base::Log;

/// A smooth, strong motion: angular rate and specific force as functions of time.
TimedImu Smooth(double t) {
  return {base::Seconds(t).ns == 0 ? Time{} : Time{base::Seconds(t).ns},
          {std::sin(2 * t), 1.3 * std::cos(1.7 * t), 0.8 * std::sin(3 * t + 1)},
          {2 * std::sin(4 * t), 1.5 * std::cos(3 * t), 9.8 + std::sin(5 * t)}};
}

std::vector<TimedImu> Sampled(double rate, double seconds) {
  std::vector<TimedImu> samples;
  for (int i = 0; i <= static_cast<int>(std::lround(seconds * rate)); ++i) samples.push_back(Smooth(i / rate));
  return samples;
}

const ImuNoise kNoise{1.7e-4, 2.0e-3, 2.0e-5, 3.0e-3, 0, 0, 0, 0};

TEST(Preintegration, AgreesWithFineIntegration) {
  const Vec3 gyro_bias(0.01, -0.02, 0.005), accel_bias(0.1, 0.05, -0.08);
  ImuPreintegration coarse(kNoise, gyro_bias, accel_bias), fine(kNoise, gyro_bias, accel_bias);
  coarse.Append(Sampled(200, 1.0));
  fine.Append(Sampled(20000, 1.0));
  // The trapezoidal rule errs by dt²/12 times second derivatives of about 50 /s².
  EXPECT_LT(Log(fine.dR().conjugate() * coarse.dR()).norm(), 1e-4);
  EXPECT_LT((fine.dv() - coarse.dv()).norm(), 3e-4);
  EXPECT_LT((fine.dp() - coarse.dp()).norm(), 3e-4);
}

TEST(Preintegration, AppendingPiecesEqualsTheWhole) {
  const std::vector<TimedImu> all = Sampled(200, 0.5);
  ImuPreintegration whole(kNoise, Vec3::Zero(), Vec3::Zero()), pieces(kNoise, Vec3::Zero(), Vec3::Zero());
  whole.Append(all);
  pieces.Append(Cut(all, Time{}, Time{200'000'000}));
  pieces.Append(Cut(all, Time{200'000'000}, Time{500'000'000}));
  EXPECT_NEAR(whole.dt(), pieces.dt(), 1e-12);
  EXPECT_LT((whole.dp() - pieces.dp()).norm(), 1e-12);
  EXPECT_LT((whole.covariance() - pieces.covariance()).norm(), 1e-15);
}

TEST(Preintegration, BiasJacobiansByPerturbation) {
  const std::vector<TimedImu> samples = Sampled(200, 0.5);
  const Vec3 gyro_bias(0.01, -0.02, 0.005), accel_bias(0.1, 0.05, -0.08);
  ImuPreintegration integral(kNoise, gyro_bias, accel_bias);
  integral.Append(samples);
  constexpr double kStep = 1e-5;
  for (int axis = 0; axis < 6; ++axis) {
    base::Vec6 shift = base::Vec6::Zero();
    shift[axis] = kStep;
    ImuPreintegration plus(kNoise, gyro_bias + shift.head<3>(), accel_bias + shift.tail<3>());
    ImuPreintegration minus(kNoise, gyro_bias - shift.head<3>(), accel_bias - shift.tail<3>());
    plus.Append(samples);
    minus.Append(samples);
    Eigen::Matrix<double, 9, 1> numeric;
    numeric << (Log(integral.dR().conjugate() * plus.dR()) - Log(integral.dR().conjugate() * minus.dR())),
        plus.dv() - minus.dv(), plus.dp() - minus.dp();
    numeric /= 2 * kStep;
    EXPECT_LT((integral.jacobian().block<9, 1>(0, 9 + axis) - numeric).cwiseAbs().maxCoeff(), 1e-6) << axis;
  }
}

TEST(Preintegration, CovarianceByMonteCarlo) {
  constexpr double kRate = 200.0;
  const std::vector<TimedImu> clean = Sampled(kRate, 0.5);
  ImuPreintegration truth(kNoise, Vec3::Zero(), Vec3::Zero());
  truth.Append(clean);
  base::RandomStream random(7, "test/preintegration");
  constexpr int kRuns = 3000;
  Mat15 sum = Mat15::Zero();
  for (int run = 0; run < kRuns; ++run) {
    Vec3 gyro_bias = Vec3::Zero(), accel_bias = Vec3::Zero();
    std::vector<TimedImu> noisy = clean;
    for (TimedImu& s : noisy) {
      s.gyro += gyro_bias + kNoise.gyro_noise * std::sqrt(kRate) * random.GaussianVec3();
      s.accel += accel_bias + kNoise.accelerometer_noise * std::sqrt(kRate) * random.GaussianVec3();
      if (&s == &noisy.back()) break;
      gyro_bias += kNoise.gyro_bias_walk / std::sqrt(kRate) * random.GaussianVec3();
      accel_bias += kNoise.accelerometer_bias_walk / std::sqrt(kRate) * random.GaussianVec3();
    }
    ImuPreintegration integral(kNoise, Vec3::Zero(), Vec3::Zero());
    integral.Append(noisy);
    Vec15 e;
    e << Log(integral.dR().conjugate() * truth.dR()), truth.dv() - integral.dv(), truth.dp() - integral.dp(), gyro_bias,
        accel_bias;
    sum += e * e.transpose() / kRuns;
  }
  // Normalised by the predicted σ: variances to 4 standard errors of √(2/N), plus the dt/T ≈ 1 % by which a chain of
  // samples differs from a continuum.
  const Vec15 sigma = truth.covariance().diagonal().cwiseSqrt();
  const double bound = 4 * std::sqrt(2.0 / kRuns) + 0.02;
  for (int i = 0; i < 15; ++i) {
    for (int j = 0; j <= i; ++j) {
      EXPECT_NEAR(sum(i, j) / (sigma[i] * sigma[j]), truth.covariance()(i, j) / (sigma[i] * sigma[j]), bound)
          << i << ' ' << j;
    }
  }
}

TEST(Preintegration, CutHoldsTheEndsAndInterpolates) {
  const std::vector<TimedImu> samples = {{Time{10}, Vec3(1, 0, 0), Vec3::Zero()},
                                         {Time{20}, Vec3(3, 0, 0), Vec3::Zero()}};
  const std::vector<TimedImu> cut = Cut(samples, Time{5}, Time{15});
  ASSERT_EQ(cut.size(), 3U);
  EXPECT_EQ(cut[0].time, Time{5});
  EXPECT_DOUBLE_EQ(cut[0].gyro.x(), 1.0);
  EXPECT_DOUBLE_EQ(cut[2].gyro.x(), 2.0);
}

/// Real IMU under aggressive motion against the official ground truth: half-second pieces with the biases of the truth.
TEST(Preintegration, EurocV103) {
  const auto folder = DataFolder("euroc_v103_imu");
  if (!folder) GTEST_SKIP() << "ALULA_DATA is not set: no euroc_v103_imu";
  const std::vector<CsvRow> truth = ReadCsv(*folder / "V1_03_difficult.csv");
  const std::int64_t origin = truth.front().stamp;
  const std::vector<TimedImu> imu = ReadImu(*folder / "imu_V103.csv", origin);
  std::vector<double> rotation, velocity, position;
  constexpr std::size_t kPiece = 100;  // rows of 5 ms
  for (std::size_t i = 0; i + kPiece < truth.size(); i += kPiece) {
    const auto state = [&](std::size_t k) {
      const std::vector<double>& v = truth[k].values;
      return std::pair(Transform{Quat(v[3], v[4], v[5], v[6]).normalized(), Vec3(v[0], v[1], v[2])},
                       Vec3(v[7], v[8], v[9]));
    };
    const auto [X_i, v_i] = state(i);
    const auto [X_j, v_j] = state(i + kPiece);
    const std::vector<double>& b = truth[i].values;
    ImuPreintegration integral(kNoise, Vec3(b[10], b[11], b[12]), Vec3(b[13], b[14], b[15]));
    integral.Append(Cut(imu, Time{truth[i].stamp - origin}, Time{truth[i + kPiece].stamp - origin}));
    const double dt = integral.dt();
    const Vec3 g(0, 0, -base::kGravity);
    rotation.push_back(Log((X_i.q * integral.dR()).conjugate() * X_j.q).norm());
    velocity.push_back((v_i + g * dt + X_i.q * integral.dv() - v_j).norm());
    position.push_back((X_i.p + v_i * dt + 0.5 * g * dt * dt + X_i.q * integral.dp() - X_j.p).norm());
  }
  const auto median = [](std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
  };
  ASSERT_GT(rotation.size(), 150U);
  // The ground truth itself is good to about 0.1° and a few cm/s.
  EXPECT_LT(median(rotation), 0.005);
  EXPECT_LT(median(velocity), 0.06);
  EXPECT_LT(median(position), 0.03);
}

}  // namespace
}  // namespace alula::stack::estimation::test

#include "vehicles/error_state_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "base/random.h"
#include "vehicles/prescribed.h"

namespace alula::vehicles {
namespace {

using base::Milliseconds;
using base::Time;
using base::Vec3;
using L = ErrorLayout;

NavigationState SomeState() {
  return {.p_OB = {1, -2, 3},
          .v_OB = {0.5, 2, -0.7},
          .q_OB = base::FromYawPitchRoll(0.8, -0.3, 0.4),
          .accelerometer_bias = {0.05, -0.02, 0.1},
          .gyro_bias = {0.01, 0.02, -0.015},
          .barometer_offset = 0.3};
}

TEST(ErrorModel, PlusAndMinusAreInverse) {
  base::RandomStream random(1, "delta");
  for (int i = 0; i < 20; ++i) {
    ErrorVector delta;
    for (int k = 0; k < L::kSize; ++k) delta[k] = 0.3 * random.Gaussian();
    EXPECT_LT((Minus(Plus(SomeState(), delta), SomeState()) - delta).norm(), 1e-12);
  }
}

TEST(ErrorModel, TransitionIsTheDerivativeOfPropagation) {
  // Ten samples of one stretch while turning fast; central differences of the exact nominal propagation.
  const auto fly = [](NavigationState x, InertialStretch* stretch) {
    for (int i = 0; i < 10; ++i) {
      const stack::ImuSample imu{{2.0 - 0.1 * i, -1.5, 0.8}, {1.0, -2.0 + 0.2 * i, 12.0}};
      if (stretch) stretch->Add(x, imu, 1e-3);
      Propagate(x, imu, 1e-3);
    }
    return x;
  };
  const NavigationState x = SomeState();
  InertialStretch stretch;
  fly(x, &stretch);
  const ErrorMatrix F = Transition(x.q_OB, stretch);
  const double h = 1e-6;
  for (int k = 0; k < L::kSize; ++k) {
    ErrorVector d = ErrorVector::Zero();
    d[k] = h;
    const ErrorVector column = Minus(fly(Plus(x, d), nullptr), fly(Plus(x, -d), nullptr)) / (2 * h);
    // Bias columns leave out third order in the stretch, |f| |w| t³, and how the rate changes within it.
    EXPECT_LT((column - F.col(k)).norm(), 3e-5) << "column " << k;
  }
}

/// A flight along exact motion, its IMU (noise as the filter believes it) and late estimates.
class Flight {
 public:
  struct Options {
    bool noise = true;
    double position_noise = 0.02, attitude_noise = 0.01, velocity_noise = 0.05;
    base::Duration vision_delay = Milliseconds(30);
    bool velocity = true;
  };
  Flight(std::uint64_t seed, const Options& options, const ErrorStateFilterConfig& config)
      : filter(config), options_(options), config_(config), random_(seed, "flight") {
    const SineMotion sines{.start = {1, 2, 1.5},
                           .terms = {{.amplitude = {2, 1.5, 0.3}, .frequency = 0.2, .phase = {0, 1.6, 0}},
                                     {.amplitude = {0.4, 0.5, 0.2}, .frequency = 0.45, .phase = {1, 0, 2}}},
                           .yaw = 0.5,
                           .yaw_amplitude = 1.5,
                           .ramp = 2,
                           .flight_time = 60};
    vehicle_ = MakePrescribed({.standstill = 1.5, .motion = sines, .attitude = ThrustAttitude{}, .body = {}}, "v");
    if (options.noise) {
      gyro_bias = config.gyro_turn_on_bias * random_.GaussianVec3();
      accelerometer_bias = config.accelerometer_turn_on_bias * random_.GaussianVec3();
    }
  }

  BodyState Truth(Time t) const { return vehicle_->Prescribed(t); }

  /// One millisecond; `vision`: whether an estimate may start now.
  void Step(bool vision) {
    const base::Duration dt = Milliseconds(1);
    const BodyState a = Truth(now), b = Truth(now + dt);
    now += dt;
    const double s = dt.Seconds(), root = std::sqrt(s), on = options_.noise ? 1.0 : 0.0;
    const Vec3 turn = base::Log(a.X_WB.q.conjugate() * b.X_WB.q);
    const Vec3 f_W = (b.v_WB - a.v_WB) / s + Vec3(0, 0, base::kGravity);
    stack::ImuSample imu;
    imu.angular_velocity = turn / s + gyro_bias + on * config_.gyro_noise / root * random_.GaussianVec3();
    imu.specific_force = (a.X_WB.q * base::Exp(0.5 * turn)).conjugate() * f_W + accelerometer_bias +
                         on * config_.accelerometer_noise / root * random_.GaussianVec3();
    gyro_bias += on * config_.gyro_bias_walk * root * random_.GaussianVec3();
    accelerometer_bias += on * config_.accelerometer_bias_walk * root * random_.GaussianVec3();
    filter.AddInertial(now, imu, std::nullopt);
    if (vision && now.ns % 20'000'000 == 0) late_.push_back(Estimate());
    while (!late_.empty() && late_.front().stamp + options_.vision_delay <= now) {
      filter.AddEstimate(now, late_.front());
      late_.pop_front();
    }
  }

  stack::Estimate Estimate() {
    const BodyState truth = Truth(now);
    const double on = options_.noise ? 1.0 : 0.0;
    stack::Estimate e;
    e.stamp = now;
    e.X_OB.p = X_OW * truth.X_WB.p + on * options_.position_noise * random_.GaussianVec3();
    e.X_OB.q = X_OW.q * truth.X_WB.q * base::Exp(on * options_.attitude_noise * random_.GaussianVec3());
    e.pose_covariance.diagonal() << Vec3::Constant(std::pow(options_.position_noise, 2)),
        Vec3::Constant(std::pow(options_.attitude_noise, 2));
    if (options_.velocity) {
      e.v_OB = X_OW.q * truth.v_WB + on * options_.velocity_noise * random_.GaussianVec3();
      e.velocity_covariance.diagonal().setConstant(std::pow(options_.velocity_noise, 2));
    }
    e.reset_counter = reset_counter;
    return e;
  }

  ErrorVector Error(const NavigationState& x, Time at) const {
    const BodyState truth = Truth(at);
    const NavigationState exact{.p_OB = X_OW * truth.X_WB.p,
                                .v_OB = X_OW.q * truth.v_WB,
                                .q_OB = X_OW.q * truth.X_WB.q,
                                .accelerometer_bias = accelerometer_bias,
                                .gyro_bias = gyro_bias,
                                .barometer_offset = x.barometer_offset};
    return Minus(exact, x);
  }

  Time now;
  ErrorStateFilter filter;
  Vec3 gyro_bias = Vec3::Zero(), accelerometer_bias = Vec3::Zero();
  base::Transform X_OW;
  std::uint32_t reset_counter = 0;

 private:
  Options options_;
  ErrorStateFilterConfig config_;
  base::RandomStream random_;
  std::unique_ptr<VehicleModel> vehicle_;
  std::deque<stack::Estimate> late_;
};

TEST(ErrorStateFilter, IsConsistentOverManyRuns) {
  // NEES of the 15 inertial states at the instant where the filter stands, 40 runs. The mean of 40 × 15 degrees of
  // freedom lies in [13.4, 16.7] with 95 %; bounds hold on average over time, and for nearly all instants.
  constexpr int kRuns = 40, kSamples = 30;
  std::vector<double> mean(kSamples, 0.0);
  std::uint64_t rejected = 0;
  for (int run = 0; run < kRuns; ++run) {
    Flight flight(static_cast<std::uint64_t>(run + 1), {}, {});
    for (int i = 0; i < kSamples; ++i) {
      for (int k = 0; k < 400; ++k) flight.Step(true);
      if (i < 3) continue;
      ASSERT_TRUE(flight.filter.initialised());
      const Eigen::Matrix<double, 15, 1> e =
          flight.Error(flight.filter.delayed_state(), flight.filter.delayed_time()).head<15>();
      const Eigen::Matrix<double, 15, 15> P = flight.filter.covariance().topLeftCorner<15, 15>();
      mean[static_cast<std::size_t>(i)] += e.dot(P.ldlt().solve(e)) / kRuns;
    }
    rejected += flight.filter.rejected();
  }
  EXPECT_LE(rejected, 4U);  // 40 runs × 500 estimates at a false-alarm rate of 3e-5
  double total = 0;
  int inside = 0;
  for (int i = 3; i < kSamples; ++i) {
    const double m = mean[static_cast<std::size_t>(i)];
    total += m / (kSamples - 3);
    inside += m > 13.35 && m < 16.74;
  }
  RecordProperty("mean_nees", std::to_string(total));
  EXPECT_GT(total, 13.4);
  EXPECT_LT(total, 16.7);
  EXPECT_GE(inside, 22);  // of 27 at 95 %: fewer than 22 has a probability below 1 % even if neighbours correlate
}

TEST(ErrorStateFilter, LateEstimatesAreFusedWhereTheyBelong) {
  // Without noise the state at the present is exact, although every estimate is up to 300 ms old and the vehicle
  // accelerates: nothing of the delay is left. At up to 4 m/s an undelayed fusion would be off by a metre.
  for (const int delay : {0, 13, 100, 300}) {
    Flight flight(1, {.noise = false, .vision_delay = Milliseconds(delay)}, {});
    double worst = 0;
    for (int k = 0; k < 15'000; ++k) {
      flight.Step(true);
      if (flight.filter.initialised()) {
        worst = std::max(worst, flight.Error(flight.filter.state(), flight.now).head<6>().norm());
      }
    }
    EXPECT_TRUE(flight.filter.initialised());
    EXPECT_LT(worst, 2e-3) << delay;  // one-millisecond quadrature of the IMU
  }
}

TEST(ErrorStateFilter, WaitsForStandstillAndAnEstimate) {
  ErrorStateFilter filter{ErrorStateFilterConfig{}};
  stack::Estimate e;
  e.pose_covariance.setIdentity();
  Time t;
  const auto feed = [&](int ms, double shake) {
    for (int k = 0; k < ms; ++k) {
      t += Milliseconds(1);
      const double s = shake * std::sin(0.1 * k);
      filter.AddInertial(t, {{s, -s, 0}, {10 * s, 0, base::kGravity}}, std::nullopt);
    }
  };
  feed(600, 1.0);
  e.stamp = t;
  filter.AddEstimate(t, e);
  EXPECT_FALSE(filter.initialised());  // it is being shaken
  feed(1100, 0.0);
  EXPECT_FALSE(filter.initialised());  // nobody has said where it is
  e.stamp = t;
  filter.AddEstimate(t, e);
  EXPECT_TRUE(filter.initialised());
}

TEST(ErrorStateFilter, InitialAttitudeComesFromGravityAndHeadingFromTheEstimate) {
  const base::Quat q = base::FromYawPitchRoll(1.1, 0.05, -0.08);
  ErrorStateFilter filter{ErrorStateFilterConfig{}};
  Time t;
  for (int k = 0; k < 600; ++k) {
    t += Milliseconds(1);
    filter.AddInertial(t, {Vec3(0.01, -0.02, 0.005), q.conjugate() * Vec3(0, 0, base::kGravity)}, std::nullopt);
  }
  stack::Estimate e;
  e.stamp = t;
  e.X_OB = {base::FromYawPitchRoll(1.1, 0, 0), {3, 4, 5}};  // its tilt is not believed
  e.pose_covariance = 1e-4 * base::Mat6::Identity();
  filter.AddEstimate(t, e);
  ASSERT_TRUE(filter.initialised());
  EXPECT_LT(base::Log(q.conjugate() * filter.state().q_OB).norm(), 1e-9);
  EXPECT_LT((filter.state().gyro_bias - Vec3(0.01, -0.02, 0.005)).norm(), 1e-12);
}

TEST(ErrorStateFilter, ObeysTheResetCounter) {
  Flight flight(3, {}, {});
  for (int k = 0; k < 8000; ++k) flight.Step(true);
  const Vec3 before = flight.filter.state().p_OB;
  flight.X_OW = {base::FromYaw(1.0), {5, -3, 0.5}};
  flight.reset_counter = 1;
  for (int k = 0; k < 60; ++k) flight.Step(true);
  EXPECT_EQ(flight.filter.jumps(), 1U);
  EXPECT_NEAR(flight.filter.last_jump().yaw, 1.0, 0.05);
  EXPECT_GT((flight.filter.state().p_OB - before).norm(), 1.0);
  for (int k = 0; k < 1000; ++k) flight.Step(true);
  EXPECT_LT(flight.Error(flight.filter.state(), flight.now).head<3>().norm(), 0.08);
  EXPECT_EQ(flight.filter.rejected(), 0U);
}

TEST(ErrorStateFilter, RejectsOutliersAndGivesInWhenTheyPersist) {
  Flight flight(4, {}, {});
  for (int k = 0; k < 8000; ++k) flight.Step(true);
  flight.X_OW.p += Vec3(2, 0, 0);  // without a word
  for (int k = 0; k < 300; ++k) flight.Step(true);
  EXPECT_GT(flight.filter.rejected(), 5U);
  EXPECT_EQ(flight.filter.jumps(), 0U);
  for (int k = 0; k < 1000; ++k) flight.Step(true);
  EXPECT_EQ(flight.filter.jumps(), 1U);
  EXPECT_LT(flight.Error(flight.filter.state(), flight.now).head<3>().norm(), 0.08);
}

/// An IMU that was knocked: the tilt drifts until no estimate fits; then the filter doubts itself and learns the bias.
TEST(ErrorStateFilter, LearnsABiasThatStepsInFlight) {
  Flight flight(6, {}, {});
  for (int k = 0; k < 8000; ++k) flight.Step(true);
  flight.gyro_bias += Vec3(0.02, 0.087, -0.01);  // 5 deg/s
  for (int k = 0; k < 8000; ++k) flight.Step(true);
  EXPECT_GE(flight.filter.jumps(), 1U);
  const ErrorVector e = flight.Error(flight.filter.state(), flight.now);
  EXPECT_LT(e.head<3>().norm(), 0.1);
  EXPECT_LT(e.segment<3>(ErrorLayout::kRotation).norm(), 0.03);
  EXPECT_LT(e.segment<3>(ErrorLayout::kGyroBias).norm(), 0.02);
}

TEST(ErrorStateFilter, DeadReckonsHonestlyThroughSilence) {
  Flight flight(5, {}, {});
  for (int k = 0; k < 10'000; ++k) flight.Step(true);
  for (int k = 0; k < 2000; ++k) flight.Step(false);
  const ErrorVector e = flight.Error(flight.filter.state(), flight.now);
  EXPECT_LT(e.head<3>().norm(), 0.5);
  const base::Mat3 P = flight.filter.covariance().topLeftCorner<3, 3>();
  EXPECT_GT(P.trace(), 1e-4);  // it knows less than before
  EXPECT_GE((flight.now - flight.filter.delayed_time()), ErrorStateFilterConfig{}.horizon);
  for (int k = 0; k < 500; ++k) flight.Step(true);
  EXPECT_LT(flight.Error(flight.filter.state(), flight.now).head<3>().norm(), 0.08);
}

TEST(ErrorStateFilter, BarometerNeverFightsVision) {
  // A barometer that drifts by 3 m in 10 s under a resting vehicle moves the height by centimetres only.
  ErrorStateFilter filter{ErrorStateFilterConfig{}};
  stack::Estimate e;
  e.pose_covariance = 1e-4 * base::Mat6::Identity();
  Time t;
  for (int k = 0; k < 11'000; ++k) {
    t += Milliseconds(1);
    const double height = 3e-4 * std::max(0, k - 1000);
    filter.AddInertial(t, {Vec3::Zero(), {0, 0, base::kGravity}}, k % 40 ? std::nullopt : std::optional(height));
    e.stamp = t;
    if (k % 20 == 0) filter.AddEstimate(t, e);
  }
  EXPECT_LT(std::abs(filter.state().p_OB.z()), 0.05);
}

}  // namespace
}  // namespace alula::vehicles

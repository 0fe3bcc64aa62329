#include <gtest/gtest.h>

#include "base/error.h"
#include "stack/estimation/imu_propagator.h"
#include "stack/estimation/static_initialiser.h"
#include "tests/stack/estimation/flight.h"

namespace alula::stack::estimation::test {
namespace {

FrameResult Truth(const Flight& flight, Time stamp) {
  const Motion m = flight.At(stamp);
  FrameResult r;
  r.initialised = true;
  r.state.stamp = stamp;
  r.state.X_OB = m.X_WB;
  r.state.v_OB = m.v_W;
  return r;
}

class Propagator : public ::testing::Test {
 protected:
  Propagator() : flight({0, 0, 0.1}, 0.3, {{5, 0, 1.5}, {8, 4, 1.5}}, 2.0, 1.0, false) {
    calibration = TrueCalibration();
    calibration.imu->X_BI = {base::Exp(Vec3(0.1, -0.2, 0.3)), Vec3(0.05, -0.03, 0.02)};
    calibration.imu->noise = {};
    imu = SimulateImu(flight, *calibration.imu, 1);
  }
  Flight flight;
  Calibration calibration;
  std::vector<TimedImu> imu;
};

TEST_F(Propagator, CarriesTheStateThroughAFlight) {
  ImuPropagator propagator(calibration);
  EXPECT_FALSE(propagator.At(Time{}).has_value());
  constexpr std::int64_t kLatency = 60'000'000;
  std::size_t next = 0;
  for (Time now{}; now < Time{9'000'000'000}; now += base::Milliseconds(1)) {
    while (next < imu.size() && imu[next].time <= now) propagator.AddImu(imu[next++]);
    if (now.ns % 50'000'000 == 0 && now.ns > kLatency) propagator.Correct(Truth(flight, Time{now.ns - kLatency}));
    const auto e = propagator.At(now);
    if (!e) continue;
    const Motion m = flight.At(now);
    ASSERT_LT((e->X_OB.p - m.X_WB.p).norm(), 2e-3) << now.Seconds();
    ASSERT_LT((e->v_OB - m.v_W).norm(), 2e-2) << now.Seconds();
    ASSERT_LT(base::Log(m.X_WB.q.conjugate() * e->X_OB.q).norm(), 5e-3) << now.Seconds();
    ASSERT_LT((e->w_B - m.w_B).norm(), 0.1) << now.Seconds();
  }
}

/// Samples added one by one and samples integrated again after a late correction give the same.
TEST_F(Propagator, CorrectionIntegratesTheBufferedSamplesAgain) {
  ImuPropagator early(calibration), late(calibration);
  const Time stamp{3'012'000'000}, now{3'200'000'000};
  bool corrected = false;
  for (const TimedImu& s : imu) {
    if (s.time > now) break;
    if (!corrected && s.time > stamp) {
      early.Correct(Truth(flight, stamp));
      corrected = true;
    }
    early.AddImu(s);
    late.AddImu(s);
  }
  late.Correct(Truth(flight, stamp));
  EXPECT_LT((early.At(now)->X_OB.p - late.At(now)->X_OB.p).norm(), 1e-4);
  // An older or uninitialised result changes nothing.
  const Vec3 before = late.At(now)->X_OB.p;
  late.Correct(Truth(flight, Time{2'000'000'000}));
  late.Correct({});
  EXPECT_EQ(before, late.At(now)->X_OB.p);
}

TEST(StaticInitialiser, FindsTiltHeadingAndGyroscopeBias) {
  const Quat q_BI = base::Exp(Vec3(0.2, -0.4, 1.0));
  const Quat q_OB = base::FromYawPitchRoll(0.7, 0.03, -0.05);
  const Quat q_OI = q_OB * q_BI;
  const Vec3 bias(0.01, -0.004, 0.002);
  std::vector<TimedImu> samples(200, {Time{}, bias, q_OI.conjugate() * Vec3(0, 0, base::kGravity)});
  const auto state = FromStandstill(samples, q_BI, base::Yaw(q_OB));
  ASSERT_TRUE(state.has_value());
  EXPECT_LT(base::Log(q_OI.conjugate() * state->q_OI).norm(), 1e-12);
  EXPECT_LT((state->gyro_bias - bias).norm(), 1e-15);
  for (TimedImu& s : samples) s.accel *= 1.3;
  EXPECT_FALSE(FromStandstill(samples, q_BI, 0.0).has_value());
}

TEST(ImuPropagator, RefusesACalibrationWithoutAnImu) {
  Calibration c = TrueCalibration();
  c.imu.reset();
  EXPECT_THROW(ImuPropagator{c}, base::InputError);
}

}  // namespace
}  // namespace alula::stack::estimation::test

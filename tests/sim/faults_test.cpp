// Each kind of fault does what it says, in its window and nowhere else.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <set>

#include "base/error.h"
#include "render/camera_renderer.h"
#include "sim/faults/scope.h"
#include "sim/run_digest.h"
#include "tests/sim/fault_rig.h"

namespace alula::sim {
namespace {

using base::Milliseconds;
using base::Time;
using base::Vec3;
using stack::Measurement;
using testing::FaultyFlight;
using testing::Fly;

Time Ms(std::int64_t ms) { return Time{ms * 1'000'000}; }
bool Within(Time t, std::int64_t from_ms, std::int64_t to_ms) { return t >= Ms(from_ms) && t < Ms(to_ms); }

const stack::ImuSample& Imu(const Measurement& m) { return std::get<stack::ImuSample>(m.data); }
double Pressure(const Measurement& m) { return std::get<stack::BaroSample>(m.data).pressure; }

bool SameImu(const stack::ImuSample& a, const stack::ImuSample& b) {
  return a.angular_velocity == b.angular_velocity && a.specific_force == b.specific_force;
}

TEST(Faults, AnEmptyListChangesNothingAndNeitherDoOnesThatNeverBegin) {
  const FaultyFlight none = Fly("[]");
  EXPECT_EQ(
      Fly("[{type: drop, sensor: imu, at: 1 min}, {type: freeze, sensor: '*', when: {height_above: 1 km}}]").digest,
      none.digest);
  EXPECT_TRUE(none.events.empty());
  EXPECT_TRUE(none.impairments.empty());
}

TEST(Faults, TheSameSeedGivesTheSameRun) {
  const std::string faults =
      "[{type: drop, sensor: imu, rate: 20 Hz, duration: 9 ms, share: 0.5}, "
      "{type: spike, sensor: barometer, at: 0.1 s, pressure: 100 Pa, share: 0.3}]";
  EXPECT_EQ(Fly(faults).digest, Fly(faults).digest);
  EXPECT_NE(Fly(faults).digest, Fly("[]").digest);
  EXPECT_NE(Fly(faults).digest, Fly(faults, {.seed = 2}).digest);
}

TEST(Faults, DroppedMeasurementsDoNotArriveAndAllOthersDo) {
  const FaultyFlight good = Fly("[]");
  const FaultyFlight bad = Fly("[{type: drop, sensor: barometer, at: 200 ms, duration: 100 ms}]");
  std::set<std::uint32_t> seen;
  for (const Measurement& m : bad.Of(testing::kBarometer)) {
    EXPECT_FALSE(Within(m.captured, 200, 300)) << m.captured.ns;
    seen.insert(m.seq);
  }
  std::size_t lost = 0;
  for (const Measurement& m : good.Of(testing::kBarometer)) {
    if (Within(m.captured, 200, 300)) ++lost;
    EXPECT_EQ(seen.contains(m.seq), !Within(m.captured, 200, 300));
  }
  EXPECT_EQ(lost, 5U);  // 50 Hz
  const auto imu_good = good.Of(testing::kImu), imu_bad = bad.Of(testing::kImu);
  ASSERT_EQ(imu_good.size(), imu_bad.size());
  for (std::size_t i = 0; i < imu_good.size(); ++i) EXPECT_TRUE(SameImu(Imu(imu_good[i]), Imu(imu_bad[i])));
}

TEST(Faults, AShareOfMeasurementsIsDropped) {
  const FaultyFlight good = Fly("[]", {.steps = 4000});
  const FaultyFlight bad = Fly("[{type: drop, sensor: imu, at: 0 s, share: 0.25}]", {.steps = 4000});
  const auto kept = static_cast<double>(bad.Of(testing::kImu).size());
  const auto all = static_cast<double>(good.Of(testing::kImu).size());
  EXPECT_NEAR(kept / all, 0.75, 4 * std::sqrt(0.25 * 0.75 / all));  // 4 σ of a binomial share
}

TEST(Faults, DelayedMeasurementsArriveLaterWithTheirStampsAndStillInOrder) {
  const FaultyFlight good = Fly("[]");
  const FaultyFlight bad = Fly("[{type: delay, sensor: imu, by: 33 ms, at: 200 ms, duration: 100 ms}]");
  std::map<std::uint32_t, Measurement> before;
  for (const Measurement& m : good.Of(testing::kImu)) before[m.seq] = m;
  for (const Measurement& m : bad.Of(testing::kImu)) {
    const bool late = Within(before.at(m.seq).available, 200, 300);
    EXPECT_EQ((m.available - before.at(m.seq).available).ns, late ? 33'000'000 : 0);
    EXPECT_EQ(m.captured, before.at(m.seq).captured);
    EXPECT_TRUE(SameImu(Imu(m), Imu(before.at(m.seq))));
  }
  EXPECT_EQ(bad.Of(testing::kImu).size(), before.size());
  for (std::size_t step = 0; step < bad.given.size(); ++step) {
    const auto& given = bad.given[step];
    for (std::size_t i = 0; i < given.size(); ++i) {
      EXPECT_LE(given[i].available, Ms(static_cast<std::int64_t>(step)));
      EXPECT_TRUE(i == 0 || ArrivesBefore(given[i - 1], given[i]));
    }
  }
}

TEST(Faults, AFrozenSensorRepeatsItsLastMeasurementToTheBit) {
  const FaultyFlight bad = Fly("[{type: freeze, sensor: imu, at: 200 ms, duration: 100 ms}]");
  const FaultyFlight good = Fly("[]");
  const auto frozen = bad.Of(testing::kImu), free = good.Of(testing::kImu);
  ASSERT_EQ(frozen.size(), free.size());
  const stack::ImuSample* last = nullptr;
  int repeated = 0;
  for (std::size_t i = 0; i < free.size(); ++i) {
    EXPECT_EQ(frozen[i].captured, free[i].captured);
    if (Within(frozen[i].available, 200, 300)) {
      ASSERT_NE(last, nullptr);
      EXPECT_EQ(std::memcmp(&Imu(frozen[i]), last, sizeof *last), 0);
      ++repeated;
    } else {
      EXPECT_TRUE(SameImu(Imu(frozen[i]), Imu(free[i])));
      last = &Imu(free[i]);
    }
  }
  EXPECT_EQ(repeated, 20);  // 200 Hz
}

TEST(Faults, ABiasIsExactlyWhatIsAdded) {
  const FaultyFlight good = Fly("[]");
  const FaultyFlight bad = Fly(
      "[{type: bias, sensor: imu, angular_velocity: [1, -2, 3] deg/s, specific_force: [0.1, 0, 0] m/s^2, at: 200 ms}, "
      "{type: bias, sensor: position_reference, position: [1, 0, 0] m, attitude: [0, 0, 90] deg, at: 200 ms}]");
  const auto g = good.Of(testing::kImu), b = bad.Of(testing::kImu);
  ASSERT_EQ(g.size(), b.size());
  const Vec3 gyro = Vec3(1, -2, 3) * (M_PI / 180), force(0.1, 0, 0);
  for (std::size_t i = 0; i < g.size(); ++i) {
    const bool off = g[i].available >= Ms(200);
    EXPECT_LT((Imu(b[i]).angular_velocity - Imu(g[i]).angular_velocity - (off ? gyro : Vec3::Zero())).norm(), 1e-15);
    EXPECT_LT((Imu(b[i]).specific_force - Imu(g[i]).specific_force - (off ? force : Vec3::Zero())).norm(), 1e-14);
  }
  const auto fix_good = good.Of(testing::kPositionReference), fix_bad = bad.Of(testing::kPositionReference);
  for (std::size_t i = 0; i < fix_good.size(); ++i) {
    if (fix_good[i].captured < Ms(200)) continue;
    const base::Transform& a = std::get<stack::PositionFix>(fix_good[i].data).X_WB;
    const base::Transform& c = std::get<stack::PositionFix>(fix_bad[i].data).X_WB;
    EXPECT_LT((c.p - a.p - Vec3(1, 0, 0)).norm(), 1e-15);
    EXPECT_LT((base::Log(a.q.conjugate() * c.q) - Vec3(0, 0, M_PI / 2)).norm(), 1e-12);
  }
}

TEST(Faults, TheyActOnTheMagnetometerAsOnEverySensor) {
  const auto field = [](const Measurement& m) { return std::get<stack::MagSample>(m.data).magnetic_field; };
  const auto good = Fly("[]").Of(testing::kMagnetometer);
  ASSERT_EQ(good.size(), 30U);  // 50 Hz for 600 ms
  const auto off = Fly("[{type: bias, sensor: magnetometer, magnetic_field: [1, -2, 3] uT, at: 200 ms}]");
  const auto frozen = Fly("[{type: freeze, sensor: magnetometer, at: 200 ms}]").Of(testing::kMagnetometer);
  const auto dropped = Fly("[{type: drop, sensor: magnetometer, at: 200 ms}]").Of(testing::kMagnetometer);
  const auto late = Fly("[{type: delay, sensor: magnetometer, by: 40 ms, at: 200 ms}]").Of(testing::kMagnetometer);
  const auto spiky = Fly("[{type: spike, sensor: magnetometer, magnetic_field: [0, 0, 50] uT, share: 1, at: 200 ms}]");
  const auto biased = off.Of(testing::kMagnetometer), struck = spiky.Of(testing::kMagnetometer);
  ASSERT_EQ(biased.size(), 30U);
  ASSERT_EQ(frozen.size(), 30U);
  ASSERT_EQ(struck.size(), 30U);
  EXPECT_EQ(dropped.size(), 10U);
  EXPECT_EQ(late.size(), 28U);
  for (std::size_t i = 0; i < 30; ++i) {
    const bool acts = i >= 10;
    const Vec3 added = acts ? Vec3(1e-6, -2e-6, 3e-6) : Vec3(0, 0, 0);
    EXPECT_LT((field(biased[i]) - field(good[i]) - added).norm(), 1e-19);
    EXPECT_EQ(field(frozen[i]), field(good[acts ? 9 : i]));
    EXPECT_NEAR(std::abs(field(struck[i]).z() - field(good[i]).z()), acts ? 50e-6 : 0.0, 1e-19);
  }
  for (std::size_t i = 0; i < late.size(); ++i) {
    EXPECT_EQ((late[i].available - late[i].captured).ns, i >= 10 ? 40'000'000 : 0);
  }
}

TEST(Faults, ABiasOnSatellitesLeavesTheOtherReferenceAlone) {
  const std::string list = "[{type: bias, sensor: gnss, position: [10, 0, 0] m, at: 0 s}]";
  const FaultyFlight good = Fly("[]"), bad = Fly(list);
  const auto place = [](const Measurement& m) { return std::get<stack::PositionFix>(m.data).X_WB.p; };
  const auto g = good.Of(testing::kGnss), b = bad.Of(testing::kGnss);
  ASSERT_EQ(g.size(), b.size());
  EXPECT_EQ(g.size(), 3U);  // 5 Hz, 120 ms on its way
  for (std::size_t i = 0; i < g.size(); ++i) EXPECT_LT((place(b[i]) - place(g[i]) - Vec3(10, 0, 0)).norm(), 1e-12);
  const auto other_good = good.Of(testing::kPositionReference), other_bad = bad.Of(testing::kPositionReference);
  ASSERT_EQ(other_good.size(), other_bad.size());
  for (std::size_t i = 0; i < other_good.size(); ++i) EXPECT_EQ(place(other_good[i]), place(other_bad[i]));
}

TEST(Faults, SpikesStrikeAShareToBothSidesAndLeaveTheRest) {
  const FaultyFlight good = Fly("[]", {.steps = 8000});
  const FaultyFlight bad =
      Fly("[{type: spike, sensor: barometer, pressure: 1 kPa, share: 0.3, at: 0 s}]", {.steps = 8000});
  const auto g = good.Of(testing::kBarometer), b = bad.Of(testing::kBarometer);
  ASSERT_EQ(g.size(), b.size());
  int up = 0, down = 0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double off = Pressure(b[i]) - Pressure(g[i]);
    if (off > 0) ++up;
    if (off < 0) ++down;
    EXPECT_TRUE(off == 0.0 || std::abs(std::abs(off) - 1000.0) < 1e-9);
  }
  const auto n = static_cast<double>(g.size());
  EXPECT_NEAR(up / n, 0.15, 4 * std::sqrt(0.15 * 0.85 / n));  // 4 σ
  EXPECT_NEAR(down / n, 0.15, 4 * std::sqrt(0.15 * 0.85 / n));
}

TEST(Faults, PixelsAreShiftedAndCutOffAndFrozenFramesKeepTheirBytes) {
  faults::Scope scope;
  const stack::SensorId left{10}, depth{201};
  scope.sensors = {{"camera.left", left, stack::Image{}}, {"camera.depth", depth, stack::DepthImage{}}};
  faults::Injector injector(testing::Read("[{type: bias, sensor: 'camera.*', brightness: 30, depth: 1 m, at: 0 s},"
                                          " {type: freeze, sensor: camera.left, at: 2 s}]"),
                            scope, 1);
  const auto image = [](std::vector<std::uint8_t> bytes, Time start) {
    stack::Image made;
    made.width = made.stride = 3;
    made.height = 1;
    made.exposure_start = start;
    made.bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
    return made;
  };
  const auto pass = [&](stack::SensorId id, Time now, decltype(Measurement::data) data) {
    injector.Advance({.now = now});
    Measurement m{id, 0, now, now, std::move(data)};
    faults::Numbers struck_by;
    EXPECT_TRUE(injector.Take(m, struck_by));
    injector.Arrive(m, struck_by);
    return m;
  };
  const auto bytes = [](const Measurement& m) { return *std::get<stack::Image>(m.data).bytes; };
  const std::vector<std::uint8_t> shifted{30, 130, 255};
  EXPECT_EQ(bytes(pass(left, Ms(1000), image({0, 100, 250}, Ms(999)))), shifted);
  const Measurement again = pass(left, Ms(2000), image({7, 8, 9}, Ms(1999)));
  EXPECT_EQ(bytes(again), shifted);  // the picture that was delivered last, the bias in it
  EXPECT_EQ(std::get<stack::Image>(again.data).exposure_start, Ms(1999));
  stack::DepthImage far;
  far.width = 3;
  far.height = 1;
  far.millimetres = std::make_shared<const std::vector<std::uint16_t>>(std::vector<std::uint16_t>{0, 500, 65000});
  const Measurement measured = pass(depth, Ms(3000), far);
  EXPECT_EQ(*std::get<stack::DepthImage>(measured.data).millimetres, (std::vector<std::uint16_t>{0, 1500, 65535}));
}

TEST(Faults, TheAutopilotsOwnSensorsFailToo) {
  const FaultyFlight good = Fly("[]");
  const FaultyFlight dropped = Fly("[{type: drop, sensor: 'autopilot.*', at: 200 ms, duration: 100 ms}]");
  const FaultyFlight late = Fly("[{type: delay, sensor: autopilot.imu, by: 7 ms, at: 200 ms}]");
  const FaultyFlight off = Fly("[{type: bias, sensor: autopilot.barometer, pressure: 50 Pa, at: 200 ms}]");
  for (std::size_t i = 0; i < good.sensors.size(); ++i) {
    const bool lost = i >= 200 && i < 300;
    EXPECT_EQ(dropped.sensors[i].imu_fresh, !lost);
    EXPECT_TRUE(SameImu(dropped.sensors[i].imu, good.sensors[lost ? 199 : i].imu));
    EXPECT_EQ(dropped.sensors[i].barometer.has_value(), good.sensors[i].barometer.has_value() && !lost);
    EXPECT_EQ(dropped.sensors[i].battery_voltage, 16.0);
    EXPECT_TRUE(SameImu(late.sensors[i].imu, good.sensors[i < 200 ? i : std::max<std::size_t>(i - 7, 199)].imu));
    EXPECT_EQ(late.sensors[i].imu_fresh, i < 200 || i >= 207);
    if (!good.sensors[i].barometer) continue;
    EXPECT_NEAR(off.sensors[i].barometer->pressure - good.sensors[i].barometer->pressure, i < 200 ? 0.0 : 50.0, 1e-9);
  }
}

TEST(Faults, MotorsAndBatteryAreImpairedWhileFaultsLast) {
  const FaultyFlight flight =
      Fly("[{type: motor, motor: 2, thrust: 0.5, at: 100 ms, duration: 200 ms},"
          " {type: motor, motor: 2, thrust: 0.4, at: 200 ms, duration: 200 ms},"
          " {type: battery, resistance: 3, voltage: 0.75, at: 500 ms}]");
  ASSERT_EQ(flight.impairments.size(), 5U);
  EXPECT_EQ(flight.impairments[0].motor_thrust, (std::vector<double>{1, 1, 0.5}));
  EXPECT_EQ(flight.impairments[1].motor_thrust, (std::vector<double>{1, 1, 0.2}));  // both
  EXPECT_EQ(flight.impairments[2].motor_thrust, (std::vector<double>{1, 1, 0.4}));
  EXPECT_TRUE(flight.impairments[3].motor_thrust.empty());
  EXPECT_EQ(flight.impairments[4].battery_resistance, 3.0);
  EXPECT_EQ(flight.impairments[4].battery_voltage, 0.75);
}

TEST(Faults, ALostLinkIsSilentInItsDirection) {
  const FaultyFlight up = Fly("[{type: link, direction: up, at: 200 ms, duration: 100 ms}]");
  ASSERT_EQ(up.commands.size(), up.estimates.size());
  EXPECT_EQ(up.commands.size(), 50U);  // of 60, one every 10 ms
  for (const auto& [received, issued] : up.commands) {
    EXPECT_FALSE(Within(issued, 200, 300));
    EXPECT_EQ(received - issued, Milliseconds(5));
  }
  const FaultyFlight down = Fly("[{type: link, direction: down, at: 200 ms, duration: 100 ms}]");
  EXPECT_EQ(down.commands.size(), 60U);
  for (const Measurement& m : down.Of(testing::kStatus)) EXPECT_FALSE(Within(m.captured, 200, 300));
  EXPECT_EQ(down.Of(testing::kStatus).size(), 25U);  // 50 Hz
  const FaultyFlight both = Fly("[{type: link, direction: both, at: 200 ms, duration: 100 ms}]");
  EXPECT_EQ(both.commands.size(), 50U);
  EXPECT_EQ(both.Of(testing::kStatus).size(), 25U);
}

TEST(Faults, ASlowComputerStretchesTheStackOrIsSaidToBeIgnored) {
  const std::string fault = "[{type: computer, factor: 5, at: 100 ms, duration: 50 ms}]";
  const FaultyFlight heeds = Fly(fault);
  ASSERT_EQ(heeds.factors.size(), 2U);
  EXPECT_EQ(heeds.factors[0].second, 5.0);
  EXPECT_EQ(heeds.factors[1].second, 1.0);
  EXPECT_EQ(heeds.events.size(), 2U);
  const FaultyFlight ignores = Fly(fault, {.stack_declares = false});
  ASSERT_EQ(ignores.events.size(), 3U);
  EXPECT_EQ(ignores.events[1].kind, "fault_ignored");
}

TEST(Faults, BeginsAndEndsAreEventsOfTheDigest) {
  const FaultyFlight flight = Fly("[{type: drop, sensor: battery, at: 123 ms, duration: 100 ms, name: gauge}]");
  ASSERT_EQ(flight.events.size(), 2U);
  EXPECT_EQ(flight.events[0].kind, "fault_begin");
  EXPECT_EQ(flight.events[0].time, Ms(123));
  EXPECT_EQ(flight.events[0].text, "gauge: battery: every measurement is lost");
  EXPECT_EQ(flight.events[1].kind, "fault_end");
  EXPECT_EQ(flight.events[1].time, Ms(223));
  base::RollingHash hash;
  for (const stack::StackEvent& event : flight.events) {
    hash.Add(event.time);
    hash.Add(std::string_view(event.kind));
    hash.Add(std::string_view(event.text));
  }
  EXPECT_EQ(flight.events_digest, hash.Hex());
}

/// A lens wholly behind mud gives black pictures; a camera's dirt of its own comes back after it.
TEST(Faults, AnObscuredLensIsDarkInItsWindowAndAsBeforeOutsideIt) {
  const worlds::World world = testing::GroundAndCrate();
  SensorsConfig config;
  config.stereo = StereoCameraConfig{};
  config.stereo->width = 160;
  config.stereo->height = 120;
  const auto record = [&](bool obscured, int workers) {
    const auto renderer = render::MakeRenderer("raster", world, {});
    SensorSuite suite(config, testing::PlateOnLegs(), Milliseconds(1), 9, "vehicle0", renderer.get(), workers);
    std::map<Time, std::vector<std::uint8_t>> left;
    std::vector<Measurement> arrived;
    TruthWindow window{{0}, {0}, testing::At({0, 0, 1}), testing::At({0, 0, 1})};
    for (int i = 0; i < 330; ++i) {
      if (obscured && i == 90) suite.Soil({{stack::SensorId{10}, {.obscured = 1.0}}});
      if (obscured && i == 240) suite.Soil({});
      suite.Measure(window, {});
      suite.Collect(window.end, arrived);
      for (const Measurement& m : arrived) {
        if (m.sensor == stack::SensorId{10}) left[m.captured] = *std::get<stack::Image>(m.data).bytes;
      }
      window = {window.end, window.end + Milliseconds(1), window.at_end, window.at_end};
    }
    return left;
  };
  const auto good = record(false, 1), bad = record(true, 1);
  EXPECT_EQ(bad, record(true, 2));
  ASSERT_EQ(good.size(), bad.size());
  for (const auto& [captured, bytes] : good) {
    const double mean =
        std::accumulate(bad.at(captured).begin(), bad.at(captured).end(), 0.0) / static_cast<double>(bytes.size());
    if (Within(captured, 90, 240)) {
      EXPECT_LT(mean, 2.0);  // read noise of 0.8 grey levels, cut off at 0
    } else {
      EXPECT_EQ(bad.at(captured), bytes);
    }
  }
}

std::string Refusal(const std::string& list) {
  try {
    Fly(list, {.steps = 0});
  } catch (const base::InputError& e) {
    return e.what();
  }
  return "was not refused";
}

TEST(Faults, WhatDoesNotFitIsRefusedWithItsPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {"[{type: drop, sensor: camera.left, at: 1 s}]",
       "f.yaml:1:31: faults.0.sensor: no sensor of this scenario is called `camera.left`; known sensors: "},
      {"[{type: drop, sensor: barometr, at: 1 s}]",
       "f.yaml:1:31: faults.0.sensor: no sensor of this scenario is called"
       " `barometr`; did you mean `barometer`?"},
      {"[{type: drop, at: 1 s}]", "f.yaml:1:10: faults.0.sensor: is missing"},
      {"[{type: motor, motor: 4, at: 1 s}]",
       "f.yaml:1:31: faults.0.motor: there is no motor 4; this vehicle has the motors 0 to 3"},
      {"[{type: motor, motor: -1, at: 1 s}]", "f.yaml:1:31: faults.0.motor: `-1` is out of range"},
      {"[{type: motor, motor: 0}]", "f.yaml:1:10: faults.0.at: never begins; add one of `at`"},
      {"[{type: motor, motor: 0, at: 1 s, rate: 1 Hz}]",
       "f.yaml:1:38: faults.0.at: begins in more than one way; keep one"},
      {"[{type: motor, motor: 0, at: 1 s, every: 2 s}]",
       "f.yaml:1:50: faults.0.every: repeats a fault that never ends"},
      {"[{type: motor, motor: 0, at: 1 s, every: 2 s, duration: 3 s}]", "faults.0.every: is shorter than the fault's"},
      {"[{type: motor, motor: 0, at: 1 s, times: 3}]", "faults.0.times: counts repetitions; add `every`"},
      {"[{type: motor, motor: 0, when: {}}]", "faults.0.when.height_above: states no condition"},
      {"[{type: motor, motor: 0, when: {height_above: 2 m, height_below: 1 m}}]",
       "faults.0.when.height_above: height_above is not less than height_below: this can never hold"},
      {"[{type: motor, motor: 0, when: {gates_passed: 1}}]",
       "f.yaml:1:55: faults.0.when.gates_passed: can never be: this world has 0 gates"},
      {"[{type: motor, motor: 0, when: {mode: flying}}]", "faults.0.when.mode: `flying` is none of the choices"},
      {"[{type: bias, sensor: imu, pressure: 1 Pa, at: 1 s}]",
       "f.yaml:1:31: faults.0.sensor: nothing is added to `imu`; give angular_velocity, specific_force"},
      {"[{type: bias, sensor: imu, angular_velocity: [1, 0, 0] rad/s, pressure: 1 Pa, at: 1 s}]",
       "f.yaml:1:31: faults.0.sensor: `pressure` is nothing that imu measures; drop it"},
      {"[{type: bias, sensor: magnetometer, pressure: 1 Pa, at: 1 s}]",
       "f.yaml:1:31: faults.0.sensor: nothing is added to `magnetometer`; give magnetic_field"},
      {"[{type: bias, sensor: status, pressure: 1 Pa, at: 1 s}]", "`status` measures nothing that could be shifted"},
      {"[{type: lens, sensor: imu, obscured: 0.5, at: 1 s}]", "`imu` has no lens that could be obscured"},
      {"[{type: lens, sensor: imu, at: 1 s}]", "faults.0.obscured: nothing lies on the lens; give obscured or smudged"},
      {"[{type: battery, at: 1 s}]", "faults.0.voltage: the battery is as good as ever"},
      {"[{type: computer, at: 1 s}]", "faults.0.factor: is missing"},
      {"[{type: link, at: 1 s}]", "faults.0.direction: is missing"},
      {"[{type: gremlin, at: 1 s}]",
       "f.yaml:1:17: faults.0.type: `gremlin` is none of the choices; choose one of drop"},
      {"[{type: drop, sensor: imu, at: 1 s, name: a}, {type: freeze, sensor: imu, at: 1 s, name: a}]",
       "f.yaml:1:98: faults.1.name: two faults are called `a`; rename one"},
  };
  for (const auto& [list, message] : cases) {
    const std::string said = Refusal(list);
    EXPECT_NE(said.find(message), std::string::npos) << list << "\n  " << said;
  }
}

TEST(Faults, PatternsMatchAsTheySay) {
  using faults::Matches;
  EXPECT_TRUE(Matches("camera.*", "camera.left"));
  EXPECT_TRUE(Matches("*", ""));
  EXPECT_TRUE(Matches("*.imu", "autopilot.imu"));
  EXPECT_TRUE(Matches("c*l*t", "camera.left"));
  EXPECT_FALSE(Matches("imu", "autopilot.imu"));
  EXPECT_FALSE(Matches("camera.", "camera.left"));
  EXPECT_FALSE(Matches("c*x", "camera.left"));
  EXPECT_FALSE(Matches("", "imu"));
}

}  // namespace
}  // namespace alula::sim

#include "sim/interval_digests.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "sim/simulation.h"
#include "tests/scenarios/temporary_folder.h"
#include "tests/sim/test_world.h"

namespace alula::sim {
namespace {

using scenarios::testing::ReadText;
using scenarios::testing::TemporaryFolder;

/// Stands where it was put.
class StillVehicle : public vehicles::VehicleModel {
 public:
  StillVehicle() : body_(testing::PlateOnLegs()) {}
  const vehicles::VehicleBody& body() const override { return body_; }
  vehicles::Wrench Step(const vehicles::BodyState&, const vehicles::ActuatorCommand&, const base::Vec3&,
                        base::Duration) override {
    return {};
  }
  stack::BatterySample Battery() const override { return {16.0, 1.0}; }
  std::vector<vehicles::TelemetryValue> Telemetry() const override { return {}; }

 private:
  vehicles::VehicleBody body_;
};

/// Steps a standing vehicle under the eyes of `digests`.
void Step(IntervalDigests& digests, int steps) {
  SimulationParts parts;
  parts.world = std::make_shared<const worlds::World>(testing::GroundAndCrate());
  parts.vehicle = std::make_unique<StillVehicle>();
  parts.observers = {&digests};
  Simulation simulation(std::move(parts));
  for (int i = 0; i < steps; ++i) simulation.Step();
}

std::vector<DigestRow> RowsOf(base::Duration interval, int steps) {
  std::vector<DigestRow> rows;
  IntervalDigests digests(interval, nullptr, [&rows](const DigestRow& row) { rows.push_back(row); });
  Step(digests, steps);
  digests.Finish();
  for (std::size_t i = 0; i < kStreams && !rows.empty(); ++i) {
    EXPECT_EQ(rows.back().streams[i], digests.digest().streams[i].value()) << kStreamNames[i];
  }
  return rows;
}

TEST(IntervalDigests, ARowAnIntervalAndOneAtTheEnd) {
  const std::vector<DigestRow> rows = RowsOf(base::Milliseconds(20), 50);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].time, base::Time{} + base::Milliseconds(20));
  EXPECT_EQ(rows[1].time, base::Time{} + base::Milliseconds(40));
  EXPECT_EQ(rows[2].time, base::Time{} + base::Milliseconds(50));
  EXPECT_EQ(RowsOf(base::Milliseconds(20), 40).size(), 2U);  // the end of an interval is the end of the run: one row
  EXPECT_EQ(RowsOf(base::Milliseconds(20), 0).size(), 0U);
}

TEST(IntervalDigests, AnIntervalThatIsNoMultipleOfTheStepEndsWithTheStepThatPassesIt) {
  const std::vector<DigestRow> rows = RowsOf(base::Microseconds(1500), 4);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].time, base::Time{} + base::Milliseconds(2));
  EXPECT_EQ(rows[1].time, base::Time{} + base::Milliseconds(3));
  EXPECT_EQ(rows[2].time, base::Time{} + base::Milliseconds(4));
}

TEST(IntervalDigests, FileReadsBackToTheRows) {
  const TemporaryFolder temporary("interval_digests");
  std::vector<DigestRow> rows;
  RunFolder folder(temporary.path());
  IntervalDigests digests(base::Milliseconds(10), &folder, [&rows](const DigestRow& row) { rows.push_back(row); });
  Step(digests, 35);
  EXPECT_EQ(ReadDigests(folder.PathOf(kDigestsFile)), rows) << "not yet finished";
  EXPECT_EQ(rows.size(), 3U);
  digests.Finish();
  EXPECT_EQ(ReadDigests(folder.PathOf(kDigestsFile)), rows);
  EXPECT_EQ(rows.size(), 4U);
  EXPECT_TRUE(ReadText(folder.PathOf(kDigestsFile))
                  .starts_with("time_s,truth,estimates,commands,events,measurements\n"
                               "0.010000000,"));
}

constexpr const char* kHeader = "time_s,truth,estimates,commands,events,measurements\n";
constexpr const char* kHash = ",0123456789abcdef,0123456789abcdef,0123456789abcdef,0123456789abcdef,0123456789abcdef";

TEST(IntervalDigests, ALineThatWasCutOffIsLeftOut) {
  const TemporaryFolder temporary("cut_digests");
  const std::filesystem::path file = temporary.path() / "digests.csv";
  std::ofstream(file) << kHeader << "1.000000000" << kHash << "\n2.000000000,0123456789abcdef,0123";
  const std::vector<DigestRow> rows = ReadDigests(file);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].time, base::Time{} + base::Seconds(1.0));
  EXPECT_EQ(rows[0].streams[4], 0x0123456789abcdefU);
}

TEST(IntervalDigests, WhatIsNoTableOfDigestsIsBadInput) {
  const TemporaryFolder temporary("bad_digests");
  const std::filesystem::path file = temporary.path() / "digests.csv";
  const auto message = [&file](const std::string& text) -> std::string {
    std::ofstream(file) << text;
    try {
      ReadDigests(file);
    } catch (const base::InputError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_NE(message("").find("digests.csv:1: is no table of digests"), std::string::npos) << message("");
  EXPECT_NE(message("time_s,truth\n").find("is no table of digests"), std::string::npos);
  const std::string cut = std::string(kHeader) + "1.0,0123\n";
  EXPECT_NE(message(cut).find("digests.csv:2: truth: '0123' is no hash"), std::string::npos) << message(cut);
  EXPECT_THROW(ReadDigests(temporary.path() / "none.csv"), base::InputError);
  EXPECT_THROW(IntervalDigests(base::Duration{}, nullptr, {}), base::InputError);
}

}  // namespace
}  // namespace alula::sim

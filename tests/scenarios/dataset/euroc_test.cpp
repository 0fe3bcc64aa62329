// What is written in EuRoC's layout reads back as it was.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "scenarios/dataset/dataset_writer.h"
#include "scenarios/dataset/euroc_reader.h"
#include "scenarios/dataset/image_file.h"
#include "tests/scenarios/dataset/synthetic.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::dataset {
namespace {

namespace fs = std::filesystem;
using scenarios::testing::ReadText;
using scenarios::testing::TemporaryFolder;
using testing::Complaint;

base::Time At(int milliseconds) { return base::Time{} + base::Milliseconds(milliseconds); }

stack::Measurement Measured(int sensor, int milliseconds, decltype(stack::Measurement::data) data) {
  return {static_cast<stack::SensorId>(sensor), 0, At(milliseconds), At(milliseconds + 10), std::move(data)};
}

/// What was given to the writer.
struct Given {
  std::vector<stack::Measurement> images;  // in the order of cam0, cam1, …, each ascending
  std::vector<stack::ImuSample> imu;
  std::vector<BodyTruth> truth;
};

Given Write(const fs::path& folder, const stack::Calibration& calibration) {
  using stack::PixelFormat;
  const auto writer = MakeEurocWriter(folder, calibration, "a \"test\"");
  base::RandomStream random(9, "euroc");
  Given given;
  for (const int sensor : {10, 11, 14, 12}) {  // the pair first, then as the calibration lists them
    for (int k = 0; k < 3; ++k) {
      const PixelFormat format = sensor == 14 ? PixelFormat::kRgb8 : PixelFormat::kGrey8;
      given.images.push_back(Measured(sensor, 50 * k, testing::RandomImage(24 + sensor, 16, format, 100 * sensor + k)));
    }
  }
  std::vector<stack::Measurement> order = given.images;
  std::swap(order[1], order[2]);  // the second left image comes late
  for (const stack::Measurement& m : order) writer->Add(m);
  writer->Add(Measured(13, 0, stack::DepthImage{}));  // no place for it
  writer->Add(Measured(7, 0, stack::BaroSample{}));
  for (int i = 0; i < 50; ++i) {
    given.imu.push_back({random.GaussianVec3(), random.GaussianVec3()});
    writer->Add(Measured(1, 5 * i, given.imu.back()));
    BodyTruth truth;
    truth.time = At(5 * i);
    truth.X_WB = {base::Exp(random.GaussianVec3()), random.GaussianVec3()};
    truth.v_WB = random.GaussianVec3();
    truth.w_B = random.GaussianVec3();
    truth.gyro_bias = random.GaussianVec3();
    truth.accelerometer_bias = random.GaussianVec3();
    given.truth.push_back(truth);
    writer->Add(truth);
  }
  writer->Finish();
  return given;
}

TEST(Euroc, WhatIsWrittenReadsBack) {
  const TemporaryFolder folder("euroc");
  const stack::Calibration calibration = testing::EverySensor();
  const Given given = Write(folder.path(), calibration);
  const Recording back = ReadEuroc(folder.path());
  EXPECT_EQ(ReadEuroc(folder.path() / "mav0").imu.size(), back.imu.size());

  ASSERT_EQ(back.calibration.cameras.size(), 4u);
  const std::vector<std::size_t> order = {1, 2, 0, 3};
  std::size_t next = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const stack::CameraCalibration &read = back.calibration.cameras[i], &was = calibration.cameras[order[i]];
    EXPECT_EQ(read.name, was.name);
    const base::Transform X_IC = calibration.imu->X_BI.Inverse() * was.X_BC;
    EXPECT_LT((read.X_BC.p - X_IC.p).norm(), 1e-15);
    EXPECT_LT(base::Log(read.X_BC.q.conjugate() * X_IC.q).norm(), 1e-15);
    ASSERT_EQ(back.images[i].size(), 3u);
    for (const ImageFile& file : back.images[i]) {
      const stack::Measurement& m = given.images[next++];
      EXPECT_EQ(file.captured.ns, kEurocEpoch.ns + m.captured.ns);
      const stack::Image image = LoadImage(file, read);
      EXPECT_EQ(image.format, std::get<stack::Image>(m.data).format);
      EXPECT_EQ(testing::Pixels(image), testing::Pixels(std::get<stack::Image>(m.data)));
    }
  }
  EXPECT_EQ(back.missing_images, 0);
  EXPECT_EQ(back.calibration.imu->X_BI.p, base::Vec3::Zero());
  EXPECT_EQ(back.calibration.imu->X_BI.q.coeffs(), base::Quat::Identity().coeffs());

  ASSERT_EQ(back.imu.size(), given.imu.size());
  ASSERT_EQ(back.truth.size(), given.truth.size());
  for (std::size_t i = 0; i < given.imu.size(); ++i) {
    EXPECT_EQ(back.imu[i].time.ns, kEurocEpoch.ns + At(static_cast<int>(5 * i)).ns);
    EXPECT_EQ(back.imu[i].sample.angular_velocity, given.imu[i].angular_velocity);
    EXPECT_EQ(back.imu[i].sample.specific_force, given.imu[i].specific_force);
    const BodyTruth &read = back.truth[i], &was = given.truth[i];
    const base::Transform X_WI = was.X_WB * calibration.imu->X_BI;
    EXPECT_EQ(read.X_WB.p, X_WI.p);
    EXPECT_EQ(read.X_WB.q.coeffs(), X_WI.q.coeffs());
    // v_WI = v_WB + R_WB (w × p_BI), by hand.
    EXPECT_LT((read.v_WB - (was.v_WB + was.X_WB.R() * base::Hat(was.w_B) * calibration.imu->X_BI.p)).norm(), 1e-15);
    EXPECT_EQ(read.gyro_bias, was.gyro_bias);
    EXPECT_EQ(read.accelerometer_bias, was.accelerometer_bias);
  }
}

TEST(Euroc, NamesAndHeadersAreThoseOfEuroc) {
  const TemporaryFolder folder("euroc_names");
  Write(folder.path(), testing::EverySensor());
  const fs::path mav = folder.path() / "mav0";
  EXPECT_TRUE(ReadText(mav / "cam0" / "data.csv")
                  .starts_with("#timestamp [ns],filename\n1000000000000000,1000000000000000.png\n"));
  EXPECT_TRUE(ReadText(mav / "imu0" / "data.csv")
                  .starts_with("#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],a_RS_S_x "
                               "[m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n1000000000000000,"));
  const std::string truth = ReadText(mav / "state_groundtruth_estimate0" / "data.csv");
  const std::string row = truth.substr(truth.find('\n') + 1, truth.find('\n', truth.find('\n') + 1));
  EXPECT_EQ(std::count(truth.begin(), truth.begin() + static_cast<std::ptrdiff_t>(truth.find('\n')), ','), 16);
  for (const char* file : {"body.yaml", "cam0/sensor.yaml", "imu0/sensor.yaml"}) {
    EXPECT_TRUE(ReadText(mav / file).starts_with("%YAML:1.0\n")) << file;
  }
  EXPECT_FALSE(fs::exists(mav / "cam4"));  // the depth camera
}

TEST(Euroc, RefusesWhatTheLayoutCannotSay) {
  const TemporaryFolder folder("euroc_refused");
  EXPECT_NE(Complaint([&] { MakeEurocWriter(folder.path() / "a", {}, ""); }).find("neither"), std::string::npos);
  stack::Calibration calibration = testing::EverySensor();
  calibration.cameras[0].gimbal = 0;
  EXPECT_NE(Complaint([&] { MakeEurocWriter(folder.path() / "b", calibration, ""); }).find("gimbal"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder.path() / "b"));
}

TEST(Euroc, BrokenRecordingsNameFileAndLine) {
  struct Bad {
    const char* file;
    const char* text;  // in place of the file's own; null: the file is taken away
    const char* message;
  };
  const std::vector<Bad> table = {
      {"cam0/data.csv", "1,a.png\n1,a.png\n", "cam0/data.csv:2: timestamp: is not later"},
      {"cam0/data.csv", "1,../../../etc/passwd\n", "cam0/data.csv:1: filename: must be the plain name"},
      {"cam0/data.csv", "1\n", "cam0/data.csv:1: filename: is missing"},
      {"cam1/data.csv", "x,a.png\n", "cam1/data.csv:1: timestamp: `x`"},
      {"cam1/data.csv", nullptr, "cam1/data.csv: cannot be read"},
      {"cam1/sensor.yaml", nullptr, "cam1/sensor.yaml: cannot be read"},
      {"cam1/sensor.yaml", "- 1\n", "cam1/sensor.yaml:1"},
      {"imu0/data.csv", "# head\n1,2,3,4,5,6\n", "imu0/data.csv:2: a_RS_S: is missing"},
      {"imu0/data.csv", "1,2,3,4,5,6,inf\n", "imu0/data.csv:1: a_RS_S: `inf`"},
      {"imu0/sensor.yaml", "rate_hz: 200\n", "imu0/sensor.yaml"},
      {"state_groundtruth_estimate0/data.csv", "1,0,0,0,0,0,0,0\n", "data.csv:1: q_RS: is no unit quaternion"},
      {"state_groundtruth_estimate0/data.csv", "1,0,0,0,1,0,0\n", "data.csv:1: q_RS: is missing"},
  };
  for (const Bad& bad : table) {
    const TemporaryFolder folder("euroc_broken");
    Write(folder.path(), testing::EverySensor());
    const fs::path file = folder.path() / "mav0" / bad.file;
    fs::remove(file);
    if (bad.text != nullptr) std::ofstream(file) << bad.text;
    const std::string said = Complaint([&] { ReadEuroc(folder.path()); });
    EXPECT_NE(said.find(bad.message), std::string::npos) << "wanted: " << bad.message << "\nsaid: " << said;
  }
  const TemporaryFolder empty("euroc_empty");
  EXPECT_NE(Complaint([&] { ReadEuroc(empty.path()); }).find("holds no dataset"), std::string::npos);
}

TEST(Euroc, ImagesMustBeOfTheCamerasSize) {
  const TemporaryFolder folder("euroc_size");
  Write(folder.path(), testing::EverySensor());
  const Recording recording = ReadEuroc(folder.path());
  EXPECT_NE(Complaint([&] { LoadImage(recording.images[0][0], recording.calibration.cameras[1]); }).find("34x16"),
            std::string::npos);
}

}  // namespace
}  // namespace alula::scenarios::dataset

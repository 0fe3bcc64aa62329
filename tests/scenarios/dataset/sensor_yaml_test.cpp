#include "scenarios/dataset/sensor_yaml.h"

#include <gtest/gtest.h>

#include "tests/scenarios/dataset/synthetic.h"

namespace alula::scenarios::dataset {
namespace {

using testing::Complaint;

/// A matrix of a quaternion and back: a few roundings.
void ExpectSame(const base::Transform& a, const base::Transform& b) {
  EXPECT_EQ(a.p, b.p);
  EXPECT_LT(base::Log(a.q.conjugate() * b.q).norm(), 1e-15);
}

TEST(SensorYaml, CamerasComeBackAsTheyWere) {
  for (const stack::CameraCalibration& camera : testing::EverySensor().cameras) {
    const stack::CameraCalibration back = ReadCameraYaml(CameraYaml(camera), "sensor.yaml");
    EXPECT_EQ(back.name, camera.name);
    ExpectSame(back.X_BC, camera.X_BC);
    EXPECT_EQ(back.rate, camera.rate) << camera.rate.cycles << "/" << camera.rate.seconds;
    EXPECT_EQ(back.time_offset, camera.time_offset);
    EXPECT_EQ(back.row_delay, camera.row_delay);
    const stack::CameraIntrinsics &a = back.intrinsics, &b = camera.intrinsics;
    EXPECT_EQ(std::tie(a.width, a.height, a.fx, a.fy, a.cx, a.cy, a.model),
              std::tie(b.width, b.height, b.fx, b.fy, b.cx, b.cy, b.model));
    EXPECT_EQ(a.distortion, b.distortion);
  }
}

TEST(SensorYaml, InertialUnitsComeBackAsTheyWere) {
  const stack::ImuCalibration imu = *testing::EverySensor().imu;
  const stack::ImuCalibration back = ReadImuYaml(ImuYaml(imu), "sensor.yaml");
  ExpectSame(back.X_BI, imu.X_BI);
  EXPECT_EQ(back.rate, imu.rate);
  EXPECT_EQ(back.noise.gyro_noise, imu.noise.gyro_noise);
  EXPECT_EQ(back.noise.accelerometer_noise, imu.noise.accelerometer_noise);
  EXPECT_EQ(back.noise.gyro_bias_walk, imu.noise.gyro_bias_walk);
  EXPECT_EQ(back.noise.accelerometer_bias_walk, imu.noise.accelerometer_bias_walk);
}

/// The text with `from` replaced by `to`, which must be there.
std::string With(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(SensorYaml, BadValuesNameTheirPlace) {
  const std::string good = CameraYaml(testing::EverySensor().cameras[1]);
  struct Bad {
    std::string from, to, message;
  };
  const std::vector<Bad> table = {
      {"camera_model: pinhole", "camera_model: omni", "sensor.yaml:18:15: camera_model: `omni`"},
      {"rate_hz: 20", "rate_hz: nan", "sensor.yaml:16:10: rate_hz"},
      {"resolution: [34, 16]", "resolution: [34]", "must be [width, height]"},
      {"resolution: [34, 16]", "resolution: [34, 1e9]", "resolution"},
      {"resolution: [34, 16]", "resolution: 34", "resolution"},
      {"intrinsics: [30.1", "intrinsics: [-30.1", "positive focal lengths"},
      {"distortion_model: radial-tangential", "distortion_model: fov", "distortion_model: `fov`"},
      {"  cols: 4", "  cols: 3", "cols"},
      {"0.0, 0.0, 0.0, 1.0]", "0.0, 0.0, 0.0, 2.0]", "is no rigid transform"},
      {"0.0, 0.0, 0.0, 1.0]", "0.0, 0.0, 0.0]", "has 15 numbers"},
      {"T_BS:", "T_SB:", "T_SB"},
      {"sensor_type: camera", "", "sensor_type"},
  };
  for (const Bad& bad : table) {
    const std::string said = Complaint([&] { ReadCameraYaml(With(good, bad.from, bad.to), "sensor.yaml"); });
    EXPECT_NE(said.find(bad.message), std::string::npos) << "wanted: " << bad.message << "\nsaid: " << said;
    EXPECT_EQ(said.find("sensor.yaml"), 0u) << said;
  }
}

TEST(SensorYaml, MutationsEndInBadInputOrACalibration) {
  base::RandomStream random(1, "yaml");
  const std::string good[] = {CameraYaml(testing::EverySensor().cameras[3]), ImuYaml(*testing::EverySensor().imu)};
  constexpr std::string_view kBytes = "[]{},:#&*!|>'\"%@`- \n\t019.eEnai/\xc2\xb5\xff\\~?<";
  for (int i = 0; i < 2000; ++i) {
    std::string text = good[i % 2];
    for (std::uint64_t k = 1 + random.Index(4); k > 0; --k) {
      const std::size_t at = random.Index(text.size());
      if (random.Index(3) == 0) {
        text.erase(at, 1 + random.Index(8));
      } else {
        text[at] = kBytes[random.Index(kBytes.size())];
      }
    }
    SCOPED_TRACE(text);
    Complaint([&] {
      if (i % 2 == 0) ReadCameraYaml(text, "sensor.yaml");
      if (i % 2 == 1) ReadImuYaml(text, "sensor.yaml");
    });
  }
}

}  // namespace
}  // namespace alula::scenarios::dataset

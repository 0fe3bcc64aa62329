// TUM's RGB-D layout, from measurements that no simulator made.
#include <gtest/gtest.h>

#include "base/text_rows.h"
#include "scenarios/dataset/dataset_writer.h"
#include "scenarios/dataset/png.h"
#include "scenarios/dataset/sensor_yaml.h"
#include "tests/scenarios/dataset/synthetic.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::dataset {
namespace {

namespace fs = std::filesystem;
using scenarios::testing::ReadText;
using scenarios::testing::TemporaryFolder;
using testing::Complaint;

base::Time At(int milliseconds) { return base::Time{} + base::Milliseconds(milliseconds); }

stack::DepthImage Ramp() {
  std::vector<std::uint16_t> millimetres;
  for (int i = 0; i < 37 * 16; ++i) millimetres.push_back(static_cast<std::uint16_t>(i * 40));
  return {.width = 37,
          .height = 16,
          .exposure_start = {},
          .exposure = {},
          .millimetres = std::make_shared<const std::vector<std::uint16_t>>(std::move(millimetres))};
}

TEST(Tum, WritesImagesDepthAndPoses) {
  const TemporaryFolder folder("tum");
  stack::Calibration calibration = testing::EverySensor();
  calibration.cameras[0].time_offset = base::Milliseconds(2);  // colour
  const auto writer = MakeTumWriter(folder.path(), calibration, "test");
  const stack::Image colour = testing::RandomImage(38, 16, stack::PixelFormat::kRgb8, 1);
  const stack::DepthImage depth = Ramp();
  for (const int k : {0, 2, 1}) {  // one comes late
    writer->Add({stack::SensorId{14}, 0, At(100 * k), At(500), colour});
    writer->Add({stack::SensorId{13}, 0, At(100 * k), At(500), depth});
    writer->Add({stack::SensorId{10}, 0, At(100 * k), At(500), colour});  // the pair has no place
  }
  writer->Add({stack::SensorId{1}, 0, At(5), At(5), stack::ImuSample{{1, 2, 3}, {0.25, 0.5, 9.75}}});
  BodyTruth truth;
  truth.time = At(15);
  truth.X_WB = {base::FromYawPitchRoll(0.5, 0.1, 0.2), {1, 2, 3}};
  writer->Add(truth);
  writer->Finish();

  EXPECT_EQ(ReadText(folder.path() / "rgb.txt"),
            "# color images\n# test\n# timestamp filename\n0.002000000 rgb/0.002000000.png\n"
            "0.102000000 rgb/0.102000000.png\n0.202000000 rgb/0.202000000.png\n");
  EXPECT_EQ(ReadText(folder.path() / "depth.txt"),
            "# depth maps\n# test\n# timestamp filename\n0.000000000 depth/0.000000000.png\n"
            "0.100000000 depth/0.100000000.png\n0.200000000 depth/0.200000000.png\n");
  EXPECT_EQ(ReadText(folder.path() / "accelerometer.txt"),
            "# accelerometer data\n# test\n# timestamp ax ay az\n0.005000000 0.25 0.5 9.75\n");
  EXPECT_EQ(ReadPng(folder.path() / "rgb" / "0.102000000.png").bytes, testing::Pixels(colour));

  const PngImage map = ReadPng(folder.path() / "depth" / "0.100000000.png");
  ASSERT_EQ(map.depth, 16);
  const auto* values = reinterpret_cast<const std::uint16_t*>(map.bytes.data());
  for (std::size_t i = 0; i < depth.millimetres->size(); ++i) {
    const int mm = (*depth.millimetres)[i];
    ASSERT_EQ(values[i], mm <= 13107 ? 5 * mm : 0) << mm;  // 5000 a metre; 65535 is 13.107 m
  }

  int rows = 0;
  base::ForEachRowOf(folder.path() / "groundtruth.txt", [&](const base::TextRow& row) {
    ++rows;
    EXPECT_EQ(row.TimeInSeconds(0, "t"), truth.time);
    const base::Transform X_WC = truth.X_WB * calibration.cameras[0].X_BC;
    EXPECT_EQ(base::Vec3(row.Number(1, "x"), row.Number(2, "y"), row.Number(3, "z")), X_WC.p);
    const base::Quat q(row.Number(7, "w"), row.Number(4, "x"), row.Number(5, "y"), row.Number(6, "z"));
    EXPECT_EQ(q.coeffs(), X_WC.q.coeffs());
  });
  EXPECT_EQ(rows, 1);
  const auto yaml = ReadCameraYaml(ReadText(folder.path() / "depth.yaml"), "depth.yaml");
  const base::Transform X = calibration.cameras[0].X_BC.Inverse() * calibration.cameras[4].X_BC;
  EXPECT_LT((yaml.X_BC.p - X.p).norm(), 1e-15);
  EXPECT_EQ(ReadCameraYaml(ReadText(folder.path() / "rgb.yaml"), "rgb.yaml").time_offset.ns, 0);
}

TEST(Tum, NeedsADepthCameraAndAPicture) {
  const TemporaryFolder folder("tum_refused");
  stack::Calibration calibration = testing::EverySensor();
  calibration.cameras.pop_back();
  EXPECT_NE(Complaint([&] { MakeTumWriter(folder.path() / "a", calibration, ""); }).find("needs a depth camera"),
            std::string::npos);
  calibration = testing::EverySensor();
  calibration.cameras.erase(calibration.cameras.begin(), calibration.cameras.begin() + 4);
  EXPECT_NE(Complaint([&] { MakeTumWriter(folder.path() / "a", calibration, ""); }).find("colour or grey"),
            std::string::npos);
  calibration = testing::EverySensor();
  calibration.cameras[4].gimbal = 0;
  EXPECT_NE(Complaint([&] { MakeTumWriter(folder.path() / "a", calibration, ""); }).find("gimbal"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder.path() / "a"));
}

}  // namespace
}  // namespace alula::scenarios::dataset

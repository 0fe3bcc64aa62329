#include "tests/fuzz/dataset_entry.h"

#include <sstream>
#include <string>
#include <string_view>

#include "base/text_rows.h"
#include "base/trajectory_file.h"
#include "scenarios/dataset/png.h"
#include "scenarios/dataset/sensor_yaml.h"
#include "tests/fuzz/expect.h"

namespace alula::fuzz {

void ReadDatasetFile(const std::uint8_t* data, std::size_t size) {
  namespace dataset = scenarios::dataset;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  Try([&] {
    // What is read writes a file that reads; from there on numbers keep their bits.
    const stack::CameraCalibration camera = dataset::ReadCameraYaml(text, "camera");
    const auto again = dataset::ReadCameraYaml(dataset::CameraYaml(camera), "written");
    Expect(again.intrinsics.fx == camera.intrinsics.fx && again.X_BC.p == camera.X_BC.p, "a camera came back changed");
  });
  Try([&] { dataset::ReadImuYaml(text, "imu"); });
  Try([&] {
    const dataset::PngImage image = dataset::DecodePng(text, "image");
    const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    Expect(image.bytes.size() == pixels * static_cast<std::size_t>(image.channels * image.depth / 8),
           "number of bytes");
  });
  Try([&] {
    std::istringstream rows{std::string(text)};
    base::ReadTrajectory(rows, "trajectory");
  });
}

}  // namespace alula::fuzz

#include "tests/fuzz/dataset_entry.h"

#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/text_rows.h"
#include "scenarios/dataset/png.h"
#include "scenarios/dataset/sensor_yaml.h"
#include "vehicles/trajectory_file.h"

namespace alula::fuzz {
namespace {

template <typename Read>
void Try(const Read& read) {
  try {
    read();
  } catch (const base::InputError&) {
  }
}

}  // namespace

void ReadDatasetFile(const std::uint8_t* data, std::size_t size) {
  namespace dataset = scenarios::dataset;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  Try([&] {
    // What is read writes and reads back to the same text.
    const std::string written = dataset::CameraYaml(dataset::ReadCameraYaml(text, "camera"));
    if (dataset::CameraYaml(dataset::ReadCameraYaml(written, "written")).empty()) std::abort();
  });
  Try([&] { dataset::ReadImuYaml(text, "imu"); });
  Try([&] {
    const dataset::PngImage image = dataset::DecodePng(text, "image");
    const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    if (image.bytes.size() != pixels * static_cast<std::size_t>(image.channels * image.depth / 8)) std::abort();
  });
  Try([&] {
    std::istringstream rows{std::string(text)};
    vehicles::ReadTrajectory(rows, "trajectory");
  });
}

}  // namespace alula::fuzz

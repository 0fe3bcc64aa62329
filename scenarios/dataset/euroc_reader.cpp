#include "scenarios/dataset/euroc_reader.h"

#include <optional>
#include <utility>

#include "base/error.h"
#include "base/text_rows.h"
#include "scenarios/dataset/internal/files.h"
#include "scenarios/dataset/sensor_yaml.h"

namespace alula::scenarios::dataset {
namespace fs = std::filesystem;
namespace {

using base::TextRow;

constexpr stack::SensorId kImu{1};
constexpr int kMostCameras = 64;
constexpr std::string_view kWanted = "a folder of a sensor holds sensor.yaml and data.csv";

base::Vec3 Vector(const TextRow& row, std::size_t first, std::string_view name) {
  return {row.Number(first, name), row.Number(first + 1, name), row.Number(first + 2, name)};
}

/// The row's stamp, later than the last one.
base::Time NextTime(const TextRow& row, std::optional<base::Time> last) {
  return internal::Later(row, row.TimeInNanoseconds(0, "timestamp"), last);
}

std::vector<ImageFile> ReadImageList(const fs::path& folder, int& missing) {
  std::vector<ImageFile> images;
  std::optional<base::Time> last;
  base::ForEachRowOf(folder / "data.csv", [&](const TextRow& row) {
    last = NextTime(row, last);
    const fs::path name(row.Word(1, "filename"));
    if (name.empty() || name != name.filename()) row.Fail("filename", "must be the plain name of a file in data/");
    internal::AddIfThere({*last, folder / "data" / name}, images, missing);
  });
  return images;
}

std::vector<ImuReading> ReadImuRows(const fs::path& file) {
  std::vector<ImuReading> readings;
  base::ForEachRowOf(file, [&](const TextRow& row) {
    const base::Time time = NextTime(row, readings.empty() ? std::nullopt : std::optional(readings.back().time));
    readings.push_back({time, {Vector(row, 1, "w_RS_S"), Vector(row, 4, "a_RS_S")}});
  });
  return readings;
}

std::vector<BodyTruth> ReadTruthRows(const fs::path& file) {
  constexpr double kUnitLength = 0.01;
  constexpr std::size_t kAllColumns = 17;
  std::vector<BodyTruth> states;
  base::ForEachRowOf(file, [&](const TextRow& row) {
    BodyTruth state;
    state.time = NextTime(row, states.empty() ? std::nullopt : std::optional(states.back().time));
    state.X_WB.p = Vector(row, 1, "p_RS_R");
    const base::Vec3 xyz = Vector(row, 5, "q_RS");
    state.X_WB.q = base::Quat(row.Number(4, "q_RS"), xyz.x(), xyz.y(), xyz.z());
    if (!(std::abs(state.X_WB.q.norm() - 1.0) < kUnitLength)) row.Fail("q_RS", "is no unit quaternion (w x y z)");
    if (row.size() >= kAllColumns) {
      state.v_WB = Vector(row, 8, "v_RS_R");
      state.gyro_bias = Vector(row, 11, "b_w_RS_S");
      state.accelerometer_bias = Vector(row, 14, "b_a_RS_S");
    }
    states.push_back(state);
  });
  return states;
}

}  // namespace

Recording ReadEuroc(const fs::path& folder) {
  std::error_code error;
  const fs::path root = fs::is_directory(folder / "mav0", error) ? folder / "mav0" : folder;
  Recording recording;
  stack::Calibration& calibration = recording.calibration;
  for (int i = 0; i < kMostCameras; ++i) {
    const fs::path camera_folder = root / ("cam" + std::to_string(i));
    if (!fs::is_directory(camera_folder, error)) break;
    const fs::path yaml = camera_folder / "sensor.yaml";
    calibration.cameras.push_back(ReadCameraYaml(internal::ReadWhole(yaml, kWanted), yaml.string()));
    calibration.cameras.back().sensor = internal::CameraId(i);
    recording.images.push_back(ReadImageList(camera_folder, recording.missing_images));
  }
  if (calibration.cameras.size() >= 2) calibration.stereo = {0, 1};
  if (fs::is_directory(root / "imu0", error)) {
    const fs::path yaml = root / "imu0" / "sensor.yaml";
    calibration.imu = ReadImuYaml(internal::ReadWhole(yaml, kWanted), yaml.string());
    calibration.imu->sensor = kImu;
    recording.imu = ReadImuRows(root / "imu0" / "data.csv");
  }
  if (calibration.cameras.empty() && !calibration.imu) {
    throw base::InputError({folder.string()}, "",
                           "holds no dataset in EuRoC's layout; mav0/cam0 or mav0/imu0 is wanted");
  }
  const fs::path truth = root / "state_groundtruth_estimate0" / "data.csv";
  if (fs::exists(truth, error)) recording.truth = ReadTruthRows(truth);
  return recording;
}

}  // namespace alula::scenarios::dataset

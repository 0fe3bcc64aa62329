#include "scenarios/dataset/kitti_reader.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <string>

#include "base/error.h"
#include "base/text_rows.h"
#include "scenarios/dataset/image_file.h"
#include "scenarios/dataset/internal/files.h"
#include "scenarios/dataset/kitti_files.h"

namespace alula::scenarios::dataset {
namespace fs = std::filesystem;
namespace {

template <typename... More>
auto Parse(const fs::path& file, auto read, More... more) {
  std::ifstream stream = base::OpenText(file);
  return read(stream, file.string(), more...);
}

std::vector<ImageFile> ListImages(const fs::path& folder, const std::vector<base::Time>& times, int& missing) {
  std::vector<ImageFile> images;
  for (std::size_t k = 0; k < times.size(); ++k) {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "%06zu.png", k);
    internal::AddIfThere({times[k], folder / name.data()}, images, missing);
  }
  return images;
}

stack::CameraCalibration ToCalibration(int number, const KittiCamera& camera, const stack::Image& first,
                                       base::Rate rate) {
  stack::CameraCalibration c;
  c.sensor = internal::CameraId(number);
  c.name = "image_" + std::to_string(number);
  c.intrinsics = {
      .width = first.width, .height = first.height, .fx = camera.fx, .fy = camera.fy, .cx = camera.cx, .cy = camera.cy};
  const base::Quat q_BC = base::ForwardCameraRotation();
  c.X_BC = {q_BC, q_BC * camera.p};
  c.rate = rate;
  c.kind = number < 2 ? stack::CameraKind::kGrey : stack::CameraKind::kColour;
  return c;
}

void AddCamera(const fs::path& folder, int number, const KittiCamera& camera, const std::vector<base::Time>& times,
               Recording& recording) {
  std::vector<ImageFile> images =
      ListImages(folder / ("image_" + std::to_string(number)), times, recording.missing_images);
  if (images.empty()) {
    throw base::InputError({(folder / ("image_" + std::to_string(number))).string()}, "",
                           "holds none of the images 000000.png, 000001.png, … that times.txt has stamps of");
  }
  const stack::Image first = ReadImage(images.front().file);
  recording.calibration.cameras.push_back(ToCalibration(number, camera, first, internal::MedianRate(times)));
  recording.images.push_back(std::move(images));
}

void ChoosePair(stack::Calibration& calibration) {
  for (std::size_t i = 0; i + 1 < calibration.cameras.size(); ++i) {
    const stack::CameraCalibration &left = calibration.cameras[i], &right = calibration.cameras[i + 1];
    if (left.kind != right.kind) continue;
    calibration.stereo = {static_cast<int>(i), static_cast<int>(i) + 1};
    return;
  }
}

std::vector<BodyTruth> ReadTruth(const fs::path& folder, const std::vector<base::Time>& times) {
  const fs::path whole = fs::absolute(folder / "").parent_path();  // without a slash or a dot at the end
  std::error_code error;
  fs::path file = folder / "poses.txt";
  if (!fs::exists(file, error))
    file = whole.parent_path().parent_path() / "poses" / (whole.filename().string() + ".txt");
  if (!fs::exists(file, error)) return {};
  const std::vector<base::Transform> poses = Parse(file, ReadKittiPoses, times.size());
  const base::Transform X_BC{base::ForwardCameraRotation(), base::Vec3::Zero()};
  std::vector<BodyTruth> truth(poses.size());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    truth[k].time = times[k];
    truth[k].X_WB = X_BC * poses[k] * X_BC.Inverse();
  }
  return truth;
}

}  // namespace

Recording ReadKitti(const fs::path& folder) {
  Recording recording;
  recording.layout = Layout::kKitti;
  const auto cameras = Parse(folder / "calib.txt", ReadKittiCalibration);
  const auto times = Parse(folder / "times.txt", ReadKittiTimes);
  std::error_code error;
  for (const auto& [number, camera] : cameras) {
    if (fs::is_directory(folder / ("image_" + std::to_string(number)), error)) {
      AddCamera(folder, number, camera, times, recording);
    }
  }
  if (recording.images.empty()) {
    throw base::InputError({(folder / "calib.txt").string()}, "", "has no row P0: … of an image_0/ that is there");
  }
  ChoosePair(recording.calibration);
  recording.truth = ReadTruth(folder, times);
  return recording;
}

}  // namespace alula::scenarios::dataset

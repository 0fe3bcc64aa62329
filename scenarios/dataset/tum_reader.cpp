#include "scenarios/dataset/tum_reader.h"

#include <algorithm>
#include <fstream>
#include <utility>

#include "base/error.h"
#include "base/text_rows.h"
#include "base/trajectory_file.h"
#include "scenarios/dataset/internal/files.h"
#include "scenarios/dataset/sensor_yaml.h"
#include "scenarios/dataset/tum_files.h"

namespace alula::scenarios::dataset {
namespace fs = std::filesystem;
namespace {

/// As far apart as TUM's own tool lets colour and depth be: less than a period of 30 Hz.
constexpr base::Duration kLargestSkew = base::Milliseconds(20);
constexpr double kOurDepthScale = 5000;  // tum_writer.cpp

struct Cameras {
  stack::CameraCalibration picture, depth;
  double values_per_metre = kOurDepthScale;
};

std::vector<ImageFile> ListImages(const fs::path& folder, const char* list, int& missing) {
  std::ifstream stream = base::OpenText(folder / list);
  std::vector<ImageFile> images;
  for (const StampedName& entry : ReadTumList(stream, (folder / list).string())) {
    internal::AddIfThere({entry.time, folder / entry.name}, images, missing);
  }
  return images;
}

/// Our own exports: sensor.yaml of both, with the optical frame of rgb/ as body.
Cameras ReadOwnYaml(const fs::path& folder) {
  const auto read = [&](const char* name) {
    const fs::path file = folder / name;
    return ReadCameraYaml(internal::ReadWhole(file, "an export of Alula's has it beside rgb.txt"), file.string());
  };
  return {.picture = read("rgb.yaml"), .depth = read("depth.yaml")};
}

Cameras ReadOneYaml(const fs::path& file, base::Rate rate_of_stamps) {
  const std::string text = internal::ReadWhole(
      file,
      "TUM's layout has no calibration of its own: write there width, height, fx, fy, cx, cy and depth_scale (5000)");
  const RgbdCalibration read = ReadRgbdYaml(text, file.string());
  Cameras cameras;
  cameras.values_per_metre = read.values_per_metre;
  cameras.picture.intrinsics = read.colour;
  cameras.depth.intrinsics = read.depth;
  cameras.depth.X_BC = read.X_CD;
  cameras.picture.rate = cameras.depth.rate = read.rate.value_or(rate_of_stamps);
  cameras.picture.name = "rgb";
  cameras.depth.name = "depth";
  return cameras;
}

/// The turn that makes the world of the truth level; none where nothing says how it hangs.
base::Quat Levelling(const fs::path& folder) {
  std::error_code error;
  const fs::path file = folder / "gravity-direction.txt";
  if (!fs::exists(file, error)) return base::Quat::Identity();
  std::ifstream stream = base::OpenText(file);
  return base::Quat::FromTwoVectors(ReadGravityDirection(stream, file.string()), -base::Vec3::UnitZ());
}

std::vector<BodyTruth> ReadTruth(const fs::path& folder, const base::Transform& X_BC) {
  std::error_code error;
  const fs::path file = folder / "groundtruth.txt";
  if (!fs::exists(file, error)) return {};
  const base::Transform X_WF{Levelling(folder), base::Vec3::Zero()};
  std::vector<BodyTruth> truth;
  for (const base::StampedPose& pose : base::ReadTrajectory(file, 0)) {
    truth.emplace_back();
    truth.back().time = pose.time;
    truth.back().X_WB = X_WF * pose.X_FS * X_BC.Inverse();
  }
  return truth;
}

}  // namespace

std::vector<std::optional<std::size_t>> PairByStamp(const std::vector<ImageFile>& pictures,
                                                    const std::vector<ImageFile>& others, base::Duration apart) {
  struct Pair {
    std::int64_t ns;
    std::size_t picture, other;
  };
  std::vector<Pair> pairs;
  std::size_t first = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    while (first < others.size() && others[first].captured + apart < pictures[i].captured) ++first;
    for (std::size_t j = first; j < others.size() && others[j].captured <= pictures[i].captured + apart; ++j) {
      pairs.push_back({std::abs((others[j].captured - pictures[i].captured).ns), i, j});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.ns < b.ns; });
  std::vector<std::optional<std::size_t>> of_picture(pictures.size());
  std::vector<bool> taken(others.size());
  for (const Pair& pair : pairs) {
    if (of_picture[pair.picture] || taken[pair.other]) continue;
    of_picture[pair.picture] = pair.other;
    taken[pair.other] = true;
  }
  return of_picture;
}

Recording ReadTum(const fs::path& folder, const std::optional<fs::path>& camera_yaml) {
  Recording recording;
  recording.layout = Layout::kTum;
  std::error_code error;
  recording.images.push_back(ListImages(folder, "rgb.txt", recording.missing_images));
  const bool own = !camera_yaml && fs::exists(folder / "rgb.yaml", error);
  Cameras cameras = own ? ReadOwnYaml(folder)
                        : ReadOneYaml(camera_yaml.value_or(folder / "camera.yaml"),
                                      internal::MedianRate(StampsOf(recording.images[0])));
  const base::Transform X_BC{base::ForwardCameraRotation(), base::Vec3::Zero()};
  cameras.picture.X_BC = X_BC * cameras.picture.X_BC;
  cameras.depth.X_BC = X_BC * cameras.depth.X_BC;
  cameras.picture.kind = stack::CameraKind::kColour;
  cameras.depth.kind = stack::CameraKind::kDepth;
  cameras.picture.sensor = internal::CameraId(0);
  cameras.depth.sensor = internal::CameraId(1);
  recording.calibration.cameras = {cameras.picture};
  if (fs::exists(folder / "depth.txt", error)) {
    recording.calibration.cameras.push_back(cameras.depth);
    recording.images.push_back(ListImages(folder, "depth.txt", recording.missing_images));
    recording.depth = {.camera = 1,
                       .picture = 0,
                       .values_per_metre = cameras.values_per_metre,
                       .of_picture = PairByStamp(recording.images[0], recording.images[1], kLargestSkew)};
  }
  recording.truth = ReadTruth(folder, X_BC);
  return recording;
}

}  // namespace alula::scenarios::dataset

#include "tests/fuzz/recording_entry.h"

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

#include "base/trajectory_file.h"
#include "scenarios/dataset/kitti_files.h"
#include "scenarios/dataset/tum_files.h"
#include "tests/fuzz/expect.h"

namespace alula::fuzz {
namespace {

namespace dataset = scenarios::dataset;

void ReadKittiText(const std::string& text) {
  constexpr std::size_t kImages = 50;
  Try([&] {
    std::istringstream rows(text);
    for (const auto& [number, camera] : dataset::ReadKittiCalibration(rows, "calib.txt")) {
      Expect(number >= 0 && number < 4 && camera.fx > 0 && camera.fy > 0, "a camera that is none");
    }
  });
  Try([&] {
    std::istringstream rows(text);
    const auto times = dataset::ReadKittiTimes(rows, "times.txt");
    for (std::size_t i = 1; i < times.size(); ++i) Expect(times[i - 1] < times[i], "times do not ascend");
  });
  Try([&] {
    std::istringstream rows(text);
    const auto poses = dataset::ReadKittiPoses(rows, "poses.txt", kImages);
    Expect(poses.size() <= kImages, "more poses than images");
    for (const base::Transform& X : poses) Expect(std::abs(X.q.norm() - 1) < 1e-9, "a turn that is none");
  });
}

void ReadTumText(const std::string& text) {
  Try([&] {
    std::istringstream rows(text);
    for (const dataset::StampedName& entry : dataset::ReadTumList(rows, "rgb.txt")) {
      const auto whole = (std::filesystem::path("/d") / entry.name).lexically_normal().string();
      Expect(whole.starts_with("/d/"), "a name leads out of its folder");
    }
  });
  Try([&] {
    std::istringstream rows(text);
    Expect(std::abs(dataset::ReadGravityDirection(rows, "gravity").norm() - 1) < 1e-9, "a direction that is none");
  });
  Try([&] {
    const dataset::RgbdCalibration camera = dataset::ReadRgbdYaml(text, "camera.yaml");
    Expect(camera.colour.fx > 0 && camera.depth.width > 0 && camera.values_per_metre > 0, "a camera that is none");
  });
  Try([&] {
    std::istringstream rows(text);
    const auto poses = base::ReadTrajectory(rows, "estimate.tum", 0);
    std::string written;
    for (const base::StampedPose& pose : poses) written += base::TumRow(pose);
    std::istringstream again(written);
    const auto back = base::ReadTrajectory(again, "written", 0);
    Expect(back.size() == poses.size(), "poses were lost");
    for (std::size_t i = 0; i < back.size(); ++i) {
      Expect(back[i].time == poses[i].time && back[i].X_FS.p == poses[i].X_FS.p, "a pose came back changed");
    }
  });
}

}  // namespace

void ReadRecordingFile(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  ReadKittiText(text);
  ReadTumText(text);
}

}  // namespace alula::fuzz

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/trajectory_file.h"
#include "scenarios/dataset/dataset_writer.h"
#include "scenarios/dataset/png.h"
#include "scenarios/dataset/sensor_yaml.h"
#include "sim/run_folder.h"

namespace alula::scenarios::dataset {
namespace fs = std::filesystem;
namespace {

constexpr int kPerMillimetre = 5;  // TUM: 5000 a metre

std::vector<std::uint16_t> TumDepth(const std::vector<std::uint16_t>& millimetres) {
  std::vector<std::uint16_t> values(millimetres.size());
  std::transform(millimetres.begin(), millimetres.end(), values.begin(), [](std::uint16_t mm) {
    return static_cast<std::uint16_t>(mm <= UINT16_MAX / kPerMillimetre ? mm * kPerMillimetre : 0);
  });
  return values;
}

/// A folder of images and the list of them, which is written at the end, in the order of time.
class ImageFolder {
 public:
  ImageFolder(const fs::path& root, const std::string& name, std::string_view title, std::string_view comment)
      : root_(root), name_(name), header_(fmt::format("# {}\n# {}\n# timestamp filename\n", title, comment)) {
    std::error_code error;
    fs::create_directories(root_ / name_, error);
    if (error) throw base::FaultError("disk", "cannot make " + (root_ / name_).string() + ": " + error.message());
  }

  void Add(base::Time time, std::string_view png) {
    times_.push_back(time);
    sim::StreamFile file(root_ / name_ / (base::DecimalSeconds(time) + ".png"));
    file.Write(png);
    file.Close();
  }

  void Finish() {
    std::sort(times_.begin(), times_.end());
    times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
    sim::StreamFile list(root_ / (name_ + ".txt"));
    list.Write(header_);
    for (const base::Time time : times_)
      list.Write(fmt::format("{0} {1}/{0}.png\n", base::DecimalSeconds(time), name_));
    list.Close();
  }

 private:
  fs::path root_;
  std::string name_, header_;
  std::vector<base::Time> times_;
};

class TumWriter final : public DatasetWriter {
 public:
  TumWriter(const fs::path& folder, const stack::CameraCalibration& picture, const stack::CameraCalibration& depth,
            std::optional<stack::SensorId> imu, std::string_view comment)
      : picture_(picture),
        depth_(depth),
        imu_(imu),
        pictures_(folder, "rgb", "color images", comment),
        depths_(folder, "depth", "depth maps", comment),
        accelerometer_(folder / "accelerometer.txt"),
        truth_(folder / "groundtruth.txt") {
    accelerometer_.Write(fmt::format("# accelerometer data\n# {}\n# timestamp ax ay az\n", comment));
    truth_.Write(fmt::format("# ground truth trajectory\n# {}\n# timestamp tx ty tz qx qy qz qw\n", comment));
    WriteYaml(folder / "rgb.yaml", picture);
    WriteYaml(folder / "depth.yaml", depth);
  }

  void Add(const stack::Measurement& m) override {
    if (const auto* image = std::get_if<stack::Image>(&m.data)) {
      if (m.sensor == picture_.sensor) pictures_.Add(m.captured + picture_.time_offset, EncodePng(*image));
    } else if (const auto* map = std::get_if<stack::DepthImage>(&m.data)) {
      if (m.sensor != depth_.sensor) return;
      depths_.Add(m.captured + depth_.time_offset, EncodePng16(map->width, map->height, TumDepth(*map->millimetres)));
    } else if (const auto* sample = std::get_if<stack::ImuSample>(&m.data)) {
      if (m.sensor != imu_) return;
      const base::Vec3& f = sample->specific_force;
      accelerometer_.Write(fmt::format("{} {} {} {}\n", base::DecimalSeconds(m.captured), f.x(), f.y(), f.z()));
    }
  }

  void Add(const BodyTruth& truth) override { truth_.Write(base::TumRow({truth.time, truth.X_WB * picture_.X_BC})); }

  void Finish() override {
    pictures_.Finish();
    depths_.Finish();
    accelerometer_.Close();
    truth_.Close();
  }

 private:
  /// The dataset's body frame is the optical frame of rgb/, its stamps are true.
  void WriteYaml(const fs::path& file, stack::CameraCalibration camera) const {
    camera.X_BC = picture_.X_BC.Inverse() * camera.X_BC;
    camera.time_offset = {};
    sim::StreamFile stream(file);
    stream.Write(CameraYaml(camera));
    stream.Close();
  }

  stack::CameraCalibration picture_, depth_;
  std::optional<stack::SensorId> imu_;
  ImageFolder pictures_, depths_;
  sim::StreamFile accelerometer_, truth_;
};

/// How far two cameras are from seeing the same: metres between them plus radians between their axes.
double Apart(const stack::CameraCalibration& a, const stack::CameraCalibration& b) {
  return (a.X_BC.p - b.X_BC.p).norm() + base::Log(a.X_BC.q.conjugate() * b.X_BC.q).norm();
}

/// The camera of a kind that lies nearest to `place` (the first of equals); null where there is none.
const stack::CameraCalibration* Nearest(const stack::Calibration& truth, stack::CameraKind kind,
                                        const stack::CameraCalibration* place) {
  const stack::CameraCalibration* nearest = nullptr;
  for (const stack::CameraCalibration& camera : truth.cameras) {
    if (camera.kind != kind) continue;
    if (nearest == nullptr || (place != nullptr && Apart(camera, *place) < Apart(*nearest, *place))) nearest = &camera;
  }
  return nearest;
}

void Check(const stack::CameraCalibration* camera, const char* what) {
  if (camera == nullptr) {
    throw base::InputError(std::string("a TUM RGB-D dataset needs ") + what +
                           " and this vehicle has none; give it an RGB-D camera or write the format euroc");
  }
  if (camera->gimbal) {
    throw base::InputError("a TUM dataset cannot hold " + camera->name +
                           ": it sits on a gimbal, and the ground truth is of a camera fixed to the vehicle");
  }
}

}  // namespace

std::unique_ptr<DatasetWriter> MakeTumWriter(const fs::path& folder, const stack::Calibration& truth,
                                             std::string_view comment) {
  using stack::CameraKind;
  const stack::CameraCalibration* depth = Nearest(truth, CameraKind::kDepth, nullptr);
  Check(depth, "a depth camera");
  const stack::CameraCalibration* picture = Nearest(truth, CameraKind::kColour, depth);
  if (picture == nullptr) picture = Nearest(truth, CameraKind::kGrey, depth);
  Check(picture, "a colour or grey camera");
  const auto imu = truth.imu ? std::optional(truth.imu->sensor) : std::nullopt;
  return std::make_unique<TumWriter>(folder, *picture, *depth, imu, comment);
}

}  // namespace alula::scenarios::dataset

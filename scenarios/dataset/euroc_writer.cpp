#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "scenarios/dataset/dataset_writer.h"
#include "scenarios/dataset/png.h"
#include "scenarios/dataset/sensor_yaml.h"
#include "sim/run_folder.h"

namespace alula::scenarios::dataset {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kImuHeader =
    "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
    "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n";
constexpr std::string_view kTruthHeader =
    "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z [],"
    "v_RS_R_x [m s^-1],v_RS_R_y [m s^-1],v_RS_R_z [m s^-1],"
    "b_w_RS_S_x [rad s^-1],b_w_RS_S_y [rad s^-1],b_w_RS_S_z [rad s^-1],"
    "b_a_RS_S_x [m s^-2],b_a_RS_S_y [m s^-2],b_a_RS_S_z [m s^-2]\n";

std::int64_t Stamp(base::Time time) { return kEurocEpoch.ns + time.ns; }

/// As many digits as read back to the same bits.
std::string Numbers(const base::Vec3& v) { return fmt::format(",{},{},{}", v.x(), v.y(), v.z()); }

void WriteFile(const fs::path& file, std::string_view bytes) {
  sim::StreamFile stream(file);
  stream.Write(bytes);
  stream.Close();
}

fs::path MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw base::FaultError("disk", "cannot make " + folder.string() + ": " + error.message());
  return folder;
}

/// One camera's folder. The list of images is written at the end: a late image is no line out of order then.
class CameraFolder {
 public:
  CameraFolder(const fs::path& folder, const stack::CameraCalibration& camera)
      : folder_(folder), sensor_(camera.sensor) {
    MakeFolder(folder_ / "data");
    WriteFile(folder_ / "sensor.yaml", CameraYaml(camera));
  }

  stack::SensorId sensor() const { return sensor_; }

  void Add(base::Time captured, const stack::Image& image) {
    stamps_.push_back(Stamp(captured));
    WriteFile(folder_ / "data" / (std::to_string(stamps_.back()) + ".png"), EncodePng(image));
  }

  void Finish() {
    std::sort(stamps_.begin(), stamps_.end());
    stamps_.erase(std::unique(stamps_.begin(), stamps_.end()), stamps_.end());
    sim::StreamFile list(folder_ / "data.csv");
    list.Write("#timestamp [ns],filename\n");
    for (const std::int64_t stamp : stamps_) list.Write(fmt::format("{},{}.png\n", stamp, stamp));
    list.Close();
  }

 private:
  fs::path folder_;
  stack::SensorId sensor_;
  std::vector<std::int64_t> stamps_;
};

/// Cameras with images, the stereo pair first.
std::vector<stack::CameraCalibration> ImageCameras(const stack::Calibration& truth) {
  std::vector<std::size_t> order;
  if (truth.stereo) {
    for (const int eye : *truth.stereo) order.push_back(static_cast<std::size_t>(eye));
  }
  for (std::size_t i = 0; i < truth.cameras.size(); ++i) {
    if (std::find(order.begin(), order.end(), i) == order.end()) order.push_back(i);
  }
  std::vector<stack::CameraCalibration> cameras;
  for (const std::size_t i : order) {
    if (truth.cameras[i].kind != stack::CameraKind::kDepth) cameras.push_back(truth.cameras[i]);
  }
  return cameras;
}

class EurocWriter final : public DatasetWriter {
 public:
  EurocWriter(const fs::path& folder, const stack::Calibration& truth, std::string_view comment)
      : imu_(truth.imu), root_(MakeFolder(folder / "mav0")) {
    WriteFile(root_ / "body.yaml", BodyYaml(comment));
    const base::Transform X_IB = imu_ ? imu_->X_BI.Inverse() : base::Transform{};
    for (stack::CameraCalibration& camera : ImageCameras(truth)) {
      camera.X_BC = X_IB * camera.X_BC;
      cameras_.emplace_back(root_ / ("cam" + std::to_string(cameras_.size())), camera);
    }
    if (imu_) StartImu();
    const fs::path state = MakeFolder(root_ / "state_groundtruth_estimate0");
    WriteFile(state / "sensor.yaml", GroundTruthYaml("the simulator's truth: pose and velocity of imu0, its biases"));
    truth_file_.emplace(state / "data.csv");
    truth_file_->Write(kTruthHeader);
  }

  void Add(const stack::Measurement& m) override {
    if (const auto* image = std::get_if<stack::Image>(&m.data)) {
      for (CameraFolder& camera : cameras_) {
        if (camera.sensor() == m.sensor) camera.Add(m.captured, *image);
      }
    } else if (const auto* sample = std::get_if<stack::ImuSample>(&m.data)) {
      if (!imu_ || imu_->sensor != m.sensor) return;
      imu_file_->Write(std::to_string(Stamp(m.captured)) + Numbers(sample->angular_velocity) +
                       Numbers(sample->specific_force) + '\n');
    }
  }

  void Add(const BodyTruth& truth) override {
    const base::Transform X_BI = imu_ ? imu_->X_BI : base::Transform{};
    const base::Transform X_WI = truth.X_WB * X_BI;
    const base::Vec3 v_WI = truth.v_WB + truth.X_WB.q * truth.w_B.cross(X_BI.p);
    truth_file_->Write(std::to_string(Stamp(truth.time)) + Numbers(X_WI.p) + fmt::format(",{}", X_WI.q.w()) +
                       Numbers(X_WI.q.vec()) + Numbers(v_WI) + Numbers(truth.gyro_bias) +
                       Numbers(truth.accelerometer_bias) + '\n');
  }

  void Finish() override {
    for (CameraFolder& camera : cameras_) camera.Finish();
    if (imu_file_) imu_file_->Close();
    truth_file_->Close();
  }

 private:
  void StartImu() {
    const fs::path folder = MakeFolder(root_ / "imu0");
    stack::ImuCalibration imu = *imu_;
    imu.X_BI = {};
    WriteFile(folder / "sensor.yaml", ImuYaml(imu));
    imu_file_.emplace(folder / "data.csv");
    imu_file_->Write(kImuHeader);
  }

  std::optional<stack::ImuCalibration> imu_;
  fs::path root_;
  std::vector<CameraFolder> cameras_;
  std::optional<sim::StreamFile> imu_file_, truth_file_;
};

}  // namespace

std::unique_ptr<DatasetWriter> MakeEurocWriter(const fs::path& folder, const stack::Calibration& truth,
                                               std::string_view comment) {
  const std::vector<stack::CameraCalibration> cameras = ImageCameras(truth);
  if (cameras.empty() && !truth.imu) {
    throw base::InputError("a EuRoC dataset holds images and inertial readings; this vehicle has neither sensor");
  }
  for (const stack::CameraCalibration& camera : cameras) {
    if (!camera.gimbal) continue;
    throw base::InputError("a EuRoC dataset cannot hold " + camera.name +
                           ": it sits on a gimbal, and sensor.yaml knows one constant T_BS");
  }
  return std::make_unique<EurocWriter>(folder, truth, comment);
}

}  // namespace alula::scenarios::dataset

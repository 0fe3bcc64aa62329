#include "scenarios/dataset/sensor_yaml.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "base/config.h"
#include "base/error.h"
#include "scenarios/dataset/internal/matrix_text.h"

namespace alula::scenarios::dataset {
namespace {

using internal::MatrixText;
using stack::DistortionModel;

/// The first line of every file, as EuRoC has it (OpenCV's FileStorage asks for it; to YAML it is an unknown
/// directive).
constexpr std::string_view kHeader = "%YAML:1.0\n";

/// A 4×4 matrix, row by row; numbers with as many digits as read back to the same bits.
std::string Matrix(const base::Transform& X) {
  const base::Mat3 R = X.R();
  std::string text = "T_BS:\n  cols: 4\n  rows: 4\n  data: [";
  for (int r = 0; r < 3; ++r)
    text += fmt::format("{:#}, {:#}, {:#}, {:#},\n         ", R(r, 0), R(r, 1), R(r, 2), X.p[r]);
  return text + "0.0, 0.0, 0.0, 1.0]\n";
}

std::string Quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return quoted + '"';
}

std::string General(std::string_view type, std::string_view comment) {
  return fmt::format("{}# General sensor definitions.\nsensor_type: {}\ncomment: {}\n\n", kHeader, type,
                     Quoted(comment));
}

/// The keys of all sensors.
struct SensorText {
  std::string sensor_type, comment;
  MatrixText T_BS;
  double rate_hz = 0;
};
void Describe(base::Description& d, SensorText& c) {
  d.Field("sensor_type", c.sensor_type, {.meaning = "what it is", .required = true});
  d.Field("comment", c.comment, {.meaning = "its name"});
  d.Field("T_BS", c.T_BS, {.meaning = "pose of the sensor in the body", .required = true});
  d.Field("rate_hz", c.rate_hz, {.meaning = "samples a second", .min = 1e-3, .max = 1e6, .required = true});
}

struct CameraText {
  SensorText sensor;
  std::vector<double> resolution, intrinsics, distortion;
  std::string camera_model = "pinhole";
  DistortionModel model = DistortionModel::kRadialTangential;
  double time_shift = 0, line_delay = 0;
};
void Describe(base::Description& d, CameraText& c) {
  Describe(d, c.sensor);
  d.Field("resolution", c.resolution, {.meaning = "width, height", .min = 1, .max = 32768, .required = true});
  d.Field("camera_model", c.camera_model, {.meaning = "projection", .required = true, .choices = {"pinhole"}});
  d.Field("intrinsics", c.intrinsics, {.meaning = "fu, fv, cu, cv", .min = -1e6, .max = 1e6, .required = true});
  d.Field("distortion_model", c.model,
          {.meaning = "lens", .required = true, .choices = {"radial-tangential", "equidistant"}});
  d.Field("distortion_coefficients", c.distortion, {.meaning = "in the model's order", .required = true});
  d.Field("timeshift_cam_imu", c.time_shift, {.meaning = "added to a stamp gives IMU time, s", .min = -10, .max = 10});
  d.Field("line_delay", c.line_delay, {.meaning = "between rows, s", .min = 0, .max = 1});
  d.Check("resolution", [&c] { return c.resolution.size() == 2 ? "" : "must be [width, height]"; });
  d.Check("intrinsics", [&c] {
    return c.intrinsics.size() == 4 && c.intrinsics[0] > 0 && c.intrinsics[1] > 0
               ? ""
               : "must be [fu, fv, cu, cv] with positive focal lengths";
  });
  d.Check("distortion_coefficients", [&c] {
    const bool fits =
        c.distortion.size() == 4 || (c.distortion.size() == 5 && c.model == DistortionModel::kRadialTangential);
    return fits ? "" : "must be [k1, k2, p1, p2] (or with k3), or four of an equidistant lens";
  });
}

struct ImuText {
  SensorText sensor;
  stack::ImuNoise noise;
};
void Describe(base::Description& d, ImuText& c) {
  Describe(d, c.sensor);
  d.Field("gyroscope_noise_density", c.noise.gyro_noise, {.meaning = "rad/s/sqrt(Hz)", .min = 0, .required = true});
  d.Field("gyroscope_random_walk", c.noise.gyro_bias_walk, {.meaning = "rad/s^2/sqrt(Hz)", .min = 0, .required = true});
  d.Field("accelerometer_noise_density", c.noise.accelerometer_noise,
          {.meaning = "m/s^2/sqrt(Hz)", .min = 0, .required = true});
  d.Field("accelerometer_random_walk", c.noise.accelerometer_bias_walk,
          {.meaning = "m/s^3/sqrt(Hz)", .min = 0, .required = true});
}

template <typename Text>
Text Read(std::string_view text, const std::string& file_name) {
  // The directive is blanked, so that lines keep their numbers.
  std::string yaml(text);
  if (yaml.starts_with('%')) {
    for (char& c : yaml) {
      if (c == '\n') break;
      c = ' ';
    }
  }
  return base::ReadConfig<Text>(base::YamlDocument::Parse(yaml, file_name), 0);
}

}  // namespace

std::string CameraYaml(const stack::CameraCalibration& camera) {
  const stack::CameraIntrinsics& c = camera.intrinsics;
  const bool fisheye = c.model == DistortionModel::kEquidistant;
  std::string text = General("camera", camera.name);
  text += "# Sensor extrinsics wrt. the body-frame.\n" + Matrix(camera.X_BC);
  text += fmt::format("\n# Camera specific definitions.\nrate_hz: {}\nresolution: [{}, {}]\ncamera_model: pinhole\n",
                      camera.rate.Hz(), c.width, c.height);
  text += fmt::format("intrinsics: [{:#}, {:#}, {:#}, {:#}] #fu, fv, cu, cv\n", c.fx, c.fy, c.cx, c.cy);
  text += fmt::format("distortion_model: {}\n", fisheye ? "equidistant" : "radial-tangential");
  const auto& k = c.distortion;
  text += fmt::format("distortion_coefficients: [{:#}, {:#}, {:#}, {:#}", k[0], k[1], k[2], k[3]);
  text += !fisheye && k[4] != 0 ? fmt::format(", {:#}]\n", k[4]) : "]\n";
  if (camera.time_offset.ns != 0) {
    text +=
        fmt::format("timeshift_cam_imu: {} # [ s ] t_imu = t_cam + timeshift_cam_imu\n", camera.time_offset.Seconds());
  }
  if (camera.row_delay.ns != 0) text += fmt::format("line_delay: {} # [ s ]\n", camera.row_delay.Seconds());
  return text;
}

std::string ImuYaml(const stack::ImuCalibration& imu) {
  std::string text = General("imu", imu.name);
  text += "# Sensor extrinsics wrt. the body-frame.\n" + Matrix(imu.X_BI);
  text += fmt::format("rate_hz: {}\n\n# inertial sensor noise model parameters (static)\n", imu.rate.Hz());
  text += fmt::format("gyroscope_noise_density: {} # [ rad / s / sqrt(Hz) ]\n", imu.noise.gyro_noise);
  text += fmt::format("gyroscope_random_walk: {} # [ rad / s^2 / sqrt(Hz) ]\n", imu.noise.gyro_bias_walk);
  text += fmt::format("accelerometer_noise_density: {} # [ m / s^2 / sqrt(Hz) ]\n", imu.noise.accelerometer_noise);
  text += fmt::format("accelerometer_random_walk: {} # [ m / s^3 / sqrt(Hz) ]\n", imu.noise.accelerometer_bias_walk);
  return text;
}

std::string GroundTruthYaml(std::string_view comment) {
  return General("visual-inertial", comment) + "# Sensor extrinsics wrt. the body-frame.\n" + Matrix({});
}

std::string BodyYaml(std::string_view comment) { return fmt::format("{}comment: {}\n", kHeader, Quoted(comment)); }

stack::CameraCalibration ReadCameraYaml(std::string_view text, const std::string& file_name) {
  const CameraText read = Read<CameraText>(text, file_name);
  stack::CameraCalibration camera;
  camera.name = read.sensor.comment;
  camera.X_BC = internal::ToTransform(read.sensor.T_BS);
  camera.rate = internal::ToRate(read.sensor.rate_hz);
  camera.time_offset = base::Seconds(read.time_shift);
  camera.row_delay = base::Seconds(read.line_delay);
  stack::CameraIntrinsics& c = camera.intrinsics;
  c.width = static_cast<int>(read.resolution[0]);
  c.height = static_cast<int>(read.resolution[1]);
  c.fx = read.intrinsics[0];
  c.fy = read.intrinsics[1];
  c.cx = read.intrinsics[2];
  c.cy = read.intrinsics[3];
  c.model = read.model;
  for (std::size_t i = 0; i < read.distortion.size(); ++i) c.distortion[i] = read.distortion[i];
  return camera;
}

stack::ImuCalibration ReadImuYaml(std::string_view text, const std::string& file_name) {
  const ImuText read = Read<ImuText>(text, file_name);
  stack::ImuCalibration imu;
  imu.name = read.sensor.comment;
  imu.X_BI = internal::ToTransform(read.sensor.T_BS);
  imu.rate = internal::ToRate(read.sensor.rate_hz);
  imu.noise = read.noise;
  return imu;
}

}  // namespace alula::scenarios::dataset

#include "scenarios/dataset/tum_files.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/config.h"
#include "base/error.h"
#include "base/text_rows.h"
#include "scenarios/dataset/internal/files.h"
#include "scenarios/dataset/internal/matrix_text.h"

namespace alula::scenarios::dataset {
namespace {

using internal::MatrixText;

constexpr double kLargestSide = 32768, kLargestFocal = 1e6;  // px

struct PinholeText {
  double fx = 0, fy = 0, cx = 0, cy = 0;
};
void Describe(base::Description& d, PinholeText& c) {
  d.Field("fx", c.fx, {.meaning = "focal length, px", .min = 1, .max = kLargestFocal, .required = true});
  d.Field("fy", c.fy, {.meaning = "focal length, px", .min = 1, .max = kLargestFocal, .required = true});
  d.Field("cx", c.cx, {.meaning = "centre, px", .min = -kLargestFocal, .max = kLargestFocal, .required = true});
  d.Field("cy", c.cy, {.meaning = "centre, px", .min = -kLargestFocal, .max = kLargestFocal, .required = true});
}

struct RgbdText {
  int width = 0, height = 0;
  PinholeText colour;
  std::vector<double> distortion;
  double depth_scale = 5000;
  std::optional<double> rate_hz;
  std::optional<PinholeText> depth;
  std::optional<MatrixText> T_CD;
};
void Describe(base::Description& d, RgbdText& c) {
  d.Field("width", c.width, {.meaning = "px", .min = 1, .max = kLargestSide, .required = true});
  d.Field("height", c.height, {.meaning = "px", .min = 1, .max = kLargestSide, .required = true});
  Describe(d, c.colour);
  d.Field("distortion", c.distortion, {.meaning = "k1, k2, p1, p2, k3 of the colour camera"});
  d.Field("depth_scale", c.depth_scale, {.meaning = "values of a depth image a metre", .min = 1, .max = 1e6});
  d.Field("rate_hz", c.rate_hz, {.meaning = "images a second", .min = 1e-3, .max = 1e6});
  d.Field("depth", c.depth, {.meaning = "the depth camera's focal lengths and centre"});
  d.Field("T_CD", c.T_CD, {.meaning = "pose of the depth camera in the colour camera"});
  d.Check("distortion", [&c] {
    const std::size_t n = c.distortion.size();
    return n == 0 || n == 4 || n == 5 ? "" : "must be [k1, k2, p1, p2], or with k3";
  });
}

stack::CameraIntrinsics ToIntrinsics(const RgbdText& text, const PinholeText& pinhole) {
  return {.width = text.width,
          .height = text.height,
          .fx = pinhole.fx,
          .fy = pinhole.fy,
          .cx = pinhole.cx,
          .cy = pinhole.cy};
}

/// True for a name that stays in the folder that it is looked for in.
bool StaysInside(const std::filesystem::path& name) {
  return !name.empty() && name.is_relative() && name.has_filename() &&
         std::none_of(name.begin(), name.end(), [](const std::filesystem::path& part) { return part == ".."; });
}

}  // namespace

std::vector<StampedName> ReadTumList(std::istream& text, const std::string& file_name) {
  std::vector<StampedName> names;
  base::ForEachRow(text, file_name, [&](const base::TextRow& row) {
    const auto last = names.empty() ? std::nullopt : std::optional(names.back().time);
    const base::Time time = internal::Later(row, row.TimeInSeconds(0, "timestamp"), last);
    const std::string name(row.Word(1, "filename"));
    if (!StaysInside(name)) row.Fail("filename", "must name a file in the dataset's folder (rgb/1.png)");
    names.push_back({time, name});
  });
  return names;
}

base::Vec3 ReadGravityDirection(std::istream& text, const std::string& file_name) {
  constexpr double kUnitLength = 0.01;  // as of quaternions
  std::vector<double> numbers;
  base::ForEachRow(text, file_name, [&](const base::TextRow& row) {
    for (std::size_t i = 0; i < row.size(); ++i) numbers.push_back(row.Number(i, "gravity"));
    if (numbers.size() > 3) row.Fail("gravity", "has more than three numbers");
  });
  const base::Vec3 direction =
      numbers.size() == 3 ? base::Vec3(numbers[0], numbers[1], numbers[2]) : base::Vec3::Zero();
  if (!(std::abs(direction.norm() - 1.0) < kUnitLength)) {
    throw base::InputError({file_name}, "", "must hold the three numbers of a unit vector along gravity");
  }
  return direction.normalized();
}

RgbdCalibration ReadRgbdYaml(std::string_view text, const std::string& file_name) {
  const auto read = base::ReadConfig<RgbdText>(base::YamlDocument::Parse(std::string(text), file_name), 0);
  RgbdCalibration calibration;
  calibration.colour = ToIntrinsics(read, read.colour);
  for (std::size_t i = 0; i < read.distortion.size(); ++i) calibration.colour.distortion[i] = read.distortion[i];
  // Without an entry of its own the depth image is one of the colour camera, lens and all.
  calibration.depth = read.depth ? ToIntrinsics(read, *read.depth) : calibration.colour;
  if (read.T_CD) calibration.X_CD = internal::ToTransform(*read.T_CD);
  calibration.values_per_metre = read.depth_scale;
  if (read.rate_hz) calibration.rate = internal::ToRate(*read.rate_hz);
  return calibration;
}

}  // namespace alula::scenarios::dataset

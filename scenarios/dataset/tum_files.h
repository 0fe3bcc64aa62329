#pragma once

#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "stack/interface/calibration.h"

namespace alula::scenarios::dataset {

/// A row of rgb.txt or depth.txt.
struct StampedName {
  base::Time time;
  std::string name;  // "rgb/1305031102.175304.png"
};

/// Rows `seconds name`, ascending in time. Throws base::InputError with file and line, also for names that lead out of
/// the dataset's folder.
std::vector<StampedName> ReadTumList(std::istream& text, const std::string& file_name);

/// gravity-direction.txt: a unit vector along gravity in the world of groundtruth.txt, three numbers in one row or
/// more. Throws base::InputError with file and line.
base::Vec3 ReadGravityDirection(std::istream& text, const std::string& file_name);

/// Both cameras of an RGB-D sensor.
struct RgbdCalibration {
  stack::CameraIntrinsics colour, depth;
  base::Transform X_CD;  // the depth camera in the colour camera
  double values_per_metre = 5000;
  std::optional<base::Rate> rate;
};

/// camera.yaml, which stands in for the calibration that TUM's layout lacks. Numbers are without units:
///   width, height, fx, fy, cx, cy   px, of the colour camera
///   distortion                      [k1, k2, p1, p2] or with k3 (radial-tangential)
///   depth_scale                     values a metre (5000, as TUM's, where it is not there)
///   rate_hz                         images a second
///   depth: {fx, fy, cx, cy}         px, of the depth camera; that of the colour camera where it is not there
///   T_CD                            pose of the depth camera in the colour camera, as EuRoC's T_BS; without it depth
///                                   images are taken to be registered to the colour camera
/// Throws base::InputError with file, line and column.
RgbdCalibration ReadRgbdYaml(std::string_view text, const std::string& file_name);

}  // namespace alula::scenarios::dataset

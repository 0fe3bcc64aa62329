#pragma once

#include <istream>
#include <map>
#include <string>
#include <vector>

#include "base/frames.h"
#include "base/time.h"

namespace alula::scenarios::dataset {

/// A rectified camera of calib.txt: P_i = K [I | −p], with p its place in the frame of the camera that the poses are
/// of.
struct KittiCamera {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  // px
  base::Vec3 p = base::Vec3::Zero();              // m
};

// KITTI's odometry files (Geiger et al. 2012). `file_name` goes into messages; base::InputError with file and line for
// rows that are short, not numbers, doubled or not ascending.

/// calib.txt: rows `P0: ` to `P3: ` of 3x4 projection matrices, row by row; other rows (`Tr:`) are not looked at.
std::map<int, KittiCamera> ReadKittiCalibration(std::istream& text, const std::string& file_name);

/// times.txt: seconds, one a row, ascending.
std::vector<base::Time> ReadKittiTimes(std::istream& text, const std::string& file_name);

/// poses.txt: 3x4 matrices [R | p] of X_C0Ck, row by row: the left camera in its first frame, one a row and at most
/// `images` of them.
std::vector<base::Transform> ReadKittiPoses(std::istream& text, const std::string& file_name, std::size_t images);

}  // namespace alula::scenarios::dataset

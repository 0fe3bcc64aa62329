#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

#include "base/frames.h"
#include "base/time.h"

namespace alula::vehicles {

/// A pose X_FS of a recorded trajectory: of some frame S in the file's own world F.
struct TimedPose {
  base::Time time;
  base::Transform X_FS;
  int line = 0;  // of the file, for messages
};

/// Reads a trajectory, at least two poses. What it is shows in its rows: with commas it is EuRoC's ground truth
/// (ns, p_x p_y p_z, q_w q_x q_y q_z; further columns are not looked at), with blanks TUM's
/// (s, p_x p_y p_z, q_x q_y q_z q_w).
/// Throws base::InputError with file and line for rows that are short, not numbers or not ascending in time and for
/// quaternions that are not of unit length.
std::vector<TimedPose> ReadTrajectory(const std::filesystem::path& file);
std::vector<TimedPose> ReadTrajectory(std::istream& text, const std::string& file_name);

}  // namespace alula::vehicles

#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

#include "base/frames.h"
#include "base/time.h"

namespace alula::base {

/// A pose X_FS of a recorded trajectory: of some frame S in the trajectory's own world F.
struct StampedPose {
  Time time;
  Transform X_FS;
  int line = 0;  // of the file that it was read from, for messages
};

/// Reads a trajectory of at least `fewest` poses. What it is shows in its rows: with commas it is EuRoC's ground truth
/// (ns, p_x p_y p_z, q_w q_x q_y q_z; further columns are not looked at), with blanks TUM's
/// (s, p_x p_y p_z, q_x q_y q_z q_w).
/// Throws InputError with file and line for rows that are short, not numbers or not ascending in time and for
/// quaternions that are not of unit length.
std::vector<StampedPose> ReadTrajectory(const std::filesystem::path& file, int fewest = 2);
std::vector<StampedPose> ReadTrajectory(std::istream& text, const std::string& file_name, int fewest = 2);

/// Seconds with all nine decimals, as TUM's files stamp: "1305031102.175304000".
std::string DecimalSeconds(Time time);

/// A row of a TUM file with its line's end: DecimalSeconds, and all other numbers with as many digits as read
/// back to the same bits.
std::string TumRow(const StampedPose& pose);

}  // namespace alula::base

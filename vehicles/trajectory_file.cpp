#include "vehicles/trajectory_file.h"

#include <cmath>
#include <fstream>

#include "base/text_rows.h"

namespace alula::vehicles {
namespace {

/// Of a written quaternion's length: four digits, as some tools print them, stay well inside.
constexpr double kUnitLength = 0.01;

TimedPose PoseOf(const base::TextRow& row) {
  const bool euroc = row.has_commas();
  TimedPose pose;
  pose.line = row.where().line;
  pose.time = euroc ? row.TimeInNanoseconds(0, "timestamp") : row.TimeInSeconds(0, "timestamp");
  pose.X_FS.p = {row.Number(1, "p_x"), row.Number(2, "p_y"), row.Number(3, "p_z")};
  const std::size_t w = euroc ? 4 : 7, x = euroc ? 5 : 4;
  pose.X_FS.q =
      base::Quat(row.Number(w, "q_w"), row.Number(x, "q_x"), row.Number(x + 1, "q_y"), row.Number(x + 2, "q_z"));
  const double length = pose.X_FS.q.norm();
  if (!(std::abs(length - 1.0) < kUnitLength)) {
    row.Fail("quaternion", "has the length " + std::to_string(length) + "; it must be 1 (" +
                               (euroc ? "EuRoC's order is w x y z" : "TUM's order is x y z w") + ")");
  }
  pose.X_FS.q.normalize();
  return pose;
}

}  // namespace

std::vector<TimedPose> ReadTrajectory(std::istream& text, const std::string& file_name) {
  std::vector<TimedPose> poses;
  base::ForEachRow(text, file_name, [&](const base::TextRow& row) {
    const TimedPose pose = PoseOf(row);
    if (!poses.empty() && pose.time <= poses.back().time) {
      row.Fail("timestamp",
               "is not later than that of line " + std::to_string(poses.back().line) + "; poses must ascend in time");
    }
    poses.push_back(pose);
  });
  if (poses.size() < 2) {
    throw base::InputError(
        {file_name}, "",
        "holds " + std::to_string(poses.size()) + " poses; a trajectory (TUM, or EuRoC's ground truth) needs two");
  }
  return poses;
}

std::vector<TimedPose> ReadTrajectory(const std::filesystem::path& file) {
  std::ifstream stream = base::OpenText(file);
  return ReadTrajectory(stream, file.string());
}

}  // namespace alula::vehicles

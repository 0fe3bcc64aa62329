#include "base/trajectory_file.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>

#include "base/text_rows.h"

namespace alula::base {
namespace {

/// Of a written quaternion's length: four digits, as some tools print them, stay well inside.
constexpr double kUnitLength = 0.01;

StampedPose PoseOf(const TextRow& row) {
  const bool euroc = row.has_commas();
  StampedPose pose;
  pose.line = row.where().line;
  pose.time = euroc ? row.TimeInNanoseconds(0, "timestamp") : row.TimeInSeconds(0, "timestamp");
  pose.X_FS.p = {row.Number(1, "p_x"), row.Number(2, "p_y"), row.Number(3, "p_z")};
  const std::size_t w = euroc ? 4 : 7, x = euroc ? 5 : 4;
  pose.X_FS.q = Quat(row.Number(w, "q_w"), row.Number(x, "q_x"), row.Number(x + 1, "q_y"), row.Number(x + 2, "q_z"));
  const double length = pose.X_FS.q.norm();
  if (!(std::abs(length - 1.0) < kUnitLength)) {
    row.Fail("quaternion", "has the length " + std::to_string(length) + "; it must be 1 (" +
                               (euroc ? "EuRoC's order is w x y z" : "TUM's order is x y z w") + ")");
  }
  pose.X_FS.q.normalize();
  return pose;
}

void Append(std::string& text, double value) {
  std::array<char, 32> digits{};  // the longest shortest form has 24
  text += ' ';
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

}  // namespace

std::vector<StampedPose> ReadTrajectory(std::istream& text, const std::string& file_name, int fewest) {
  std::vector<StampedPose> poses;
  ForEachRow(text, file_name, [&](const TextRow& row) {
    const StampedPose pose = PoseOf(row);
    if (!poses.empty() && pose.time <= poses.back().time) {
      row.Fail("timestamp",
               "is not later than that of line " + std::to_string(poses.back().line) + "; poses must ascend in time");
    }
    poses.push_back(pose);
  });
  if (static_cast<int>(poses.size()) < fewest) {
    throw InputError({file_name}, "",
                     "holds " + std::to_string(poses.size()) +
                         " poses; a trajectory (TUM, or EuRoC's ground truth) needs " + std::to_string(fewest));
  }
  return poses;
}

std::vector<StampedPose> ReadTrajectory(const std::filesystem::path& file, int fewest) {
  std::ifstream stream = OpenText(file);
  return ReadTrajectory(stream, file.string(), fewest);
}

std::string DecimalSeconds(Time time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  constexpr std::size_t kDigits = 9;
  const std::int64_t ns = std::abs(time.ns);
  const std::string fraction = std::to_string(ns % kSecond);
  return (time.ns < 0 ? "-" : "") + std::to_string(ns / kSecond) + '.' + std::string(kDigits - fraction.size(), '0') +
         fraction;
}

std::string TumRow(const StampedPose& pose) {
  std::string text = DecimalSeconds(pose.time);
  for (const double value : {pose.X_FS.p.x(), pose.X_FS.p.y(), pose.X_FS.p.z()}) Append(text, value);
  for (const double value : {pose.X_FS.q.x(), pose.X_FS.q.y(), pose.X_FS.q.z(), pose.X_FS.q.w()}) Append(text, value);
  return text + '\n';
}

}  // namespace alula::base

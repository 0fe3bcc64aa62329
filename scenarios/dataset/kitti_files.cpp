#include "scenarios/dataset/kitti_files.h"

#include <array>
#include <cmath>
#include <optional>

#include "base/text_rows.h"
#include "scenarios/dataset/internal/files.h"

namespace alula::scenarios::dataset {
namespace {

using base::TextRow;

/// Twelve numbers, row by row.
using Matrix34 = std::array<std::array<double, 4>, 3>;

Matrix34 ReadMatrix(const TextRow& row, std::size_t first, std::string_view name) {
  constexpr std::size_t kNumbers = 12;
  if (row.size() != first + kNumbers) {
    row.Fail(name, "has " + std::to_string(row.size() - first) + " numbers; a 3x4 matrix has 12");
  }
  Matrix34 matrix{};
  for (std::size_t i = 0; i < kNumbers; ++i) matrix[i / 4][i % 4] = row.Number(first + i, name);
  return matrix;
}

KittiCamera ToCamera(const TextRow& row, const Matrix34& P, std::string_view name) {
  const bool rectified =
      P[0][0] > 0 && P[1][1] > 0 && P[0][1] == 0 && P[1][0] == 0 && P[2][0] == 0 && P[2][1] == 0 && P[2][2] == 1;
  if (!rectified) row.Fail(name, "is no projection of a rectified camera (fx 0 cx .; 0 fy cy .; 0 0 1 .)");
  // K p = −(last column), from the bottom up.
  KittiCamera camera{.fx = P[0][0], .fy = P[1][1], .cx = P[0][2], .cy = P[1][2]};
  const double z = -P[2][3];
  camera.p = {(-P[0][3] - camera.cx * z) / camera.fx, (-P[1][3] - camera.cy * z) / camera.fy, z};
  return camera;
}

}  // namespace

std::map<int, KittiCamera> ReadKittiCalibration(std::istream& text, const std::string& file_name) {
  std::map<int, KittiCamera> cameras;
  base::ForEachRow(text, file_name, [&](const TextRow& row) {
    const std::string name(row.Word(0, "name"));
    if (name.size() != 3 || name[0] != 'P' || name[1] < '0' || name[1] > '3' || name[2] != ':') return;
    const KittiCamera camera = ToCamera(row, ReadMatrix(row, 1, name.substr(0, 2)), name.substr(0, 2));
    if (!cameras.emplace(name[1] - '0', camera).second) row.Fail(name.substr(0, 2), "stands there twice");
  });
  return cameras;
}

std::vector<base::Time> ReadKittiTimes(std::istream& text, const std::string& file_name) {
  std::vector<base::Time> times;
  base::ForEachRow(text, file_name, [&](const TextRow& row) {
    const auto last = times.empty() ? std::nullopt : std::optional(times.back());
    times.push_back(internal::Later(row, row.TimeInSeconds(0, "timestamp"), last));
  });
  return times;
}

std::vector<base::Transform> ReadKittiPoses(std::istream& text, const std::string& file_name, std::size_t images) {
  constexpr double kOrthonormal = 1e-3;  // four digits, as some tools print
  std::vector<base::Transform> poses;
  base::ForEachRow(text, file_name, [&](const TextRow& row) {
    if (poses.size() == images) {
      row.Fail("pose", "has no stamp: times.txt has " + std::to_string(images) + " rows");
    }
    const Matrix34 m = ReadMatrix(row, 0, "pose");
    base::Mat3 R;
    R << m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2], m[2][0], m[2][1], m[2][2];
    const double skew = (R * R.transpose() - base::Mat3::Identity()).cwiseAbs().maxCoeff();
    if (!(skew < kOrthonormal) || R.determinant() < 0) row.Fail("pose", "is no rotation and position [R | p]");
    poses.push_back({base::Quat(R).normalized(), {m[0][3], m[1][3], m[2][3]}});
  });
  return poses;
}

}  // namespace alula::scenarios::dataset

#include "scenarios/dataset/internal/matrix_text.h"

#include <cmath>
#include <string>

namespace alula::scenarios::dataset::internal {

void Describe(base::Description& d, MatrixText& c) {
  d.Field("cols", c.cols, {.meaning = "columns", .min = 4, .max = 4, .required = true});
  d.Field("rows", c.rows, {.meaning = "rows", .min = 4, .max = 4, .required = true});
  d.Field("data", c.data, {.meaning = "row by row", .required = true});
  d.Check("data", [&c]() -> std::string {
    if (c.data.size() != 16) return "has " + std::to_string(c.data.size()) + " numbers; a 4x4 matrix has 16";
    base::Mat3 R;
    for (int r = 0; r < 3; ++r) {
      for (int k = 0; k < 3; ++k) R(r, k) = c.data[static_cast<std::size_t>(4 * r + k)];
    }
    constexpr double kOrthonormal = 1e-3;  // four digits, as some calibrations are printed
    const bool bottom = c.data[12] == 0 && c.data[13] == 0 && c.data[14] == 0 && c.data[15] == 1;
    const bool rotation =
        (R * R.transpose() - base::Mat3::Identity()).cwiseAbs().maxCoeff() < kOrthonormal && R.determinant() > 0;
    return bottom && rotation ? "" : "is no rigid transform (rotation, position, and 0 0 0 1 at the bottom)";
  });
}

base::Transform ToTransform(const MatrixText& matrix) {
  base::Mat3 R;
  base::Vec3 p;
  for (int r = 0; r < 3; ++r) {
    for (int k = 0; k < 3; ++k) R(r, k) = matrix.data[static_cast<std::size_t>(4 * r + k)];
    p[r] = matrix.data[static_cast<std::size_t>(4 * r + 3)];
  }
  return {base::Quat(R).normalized(), p};
}

base::Rate ToRate(double hz) {
  for (std::int64_t seconds = 1; seconds <= 10'000; ++seconds) {
    const double cycles = hz * static_cast<double>(seconds);
    if (std::round(cycles) >= 1 && std::abs(cycles - std::round(cycles)) <= 1e-12 * cycles) {
      return {std::llround(cycles), seconds};
    }
  }
  return {std::llround(hz * 1e6), 1'000'000};
}

}  // namespace alula::scenarios::dataset::internal

#pragma once

#include <vector>

#include "base/config.h"
#include "base/frames.h"
#include "base/time.h"

namespace alula::scenarios::dataset::internal {

/// A 4x4 matrix of a rigid transform as EuRoC's files write it: cols, rows, data row by row.
struct MatrixText {
  int cols = 0, rows = 0;
  std::vector<double> data;
};
void Describe(base::Description& d, MatrixText& c);
base::Transform ToTransform(const MatrixText& matrix);

/// The fraction with the smallest denominator that prints as `hz`: 29.97002997002997 is 30000/1001.
base::Rate ToRate(double hz);

}  // namespace alula::scenarios::dataset::internal

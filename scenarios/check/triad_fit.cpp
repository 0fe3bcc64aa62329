#include "scenarios/check/triad_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "scenarios/check/rig.h"
#include "scenarios/check/statistics.h"

namespace alula::scenarios::check {
namespace {

using base::Mat3;
using base::Vec3;

/// M = diag(1 + k) (I + L) Exp(m)ᵀ: Mᵀ is a rotation times an upper triangle.
void TakeApart(const Mat3& M, TriadFit& fit) {
  const Eigen::HouseholderQR<Mat3> qr(M.transpose());
  Mat3 U = qr.matrixQR().triangularView<Eigen::Upper>();
  const Vec3 sign = U.diagonal().cwiseSign();
  U = sign.asDiagonal() * U;
  const Mat3 Q = Mat3(qr.householderQ()) * sign.asDiagonal();
  fit.scale = U.diagonal() - Vec3::Ones();
  fit.misalignment = base::Log(base::Quat(Q));
  fit.nonorthogonality = {U(0, 1) / U(1, 1), U(0, 2) / U(2, 2), U(1, 2) / U(2, 2)};
}

}  // namespace

TriadFit FitTriad(const std::vector<Vec3>& v, const std::vector<Vec3>& f, const std::vector<Vec3>& read,
                  bool with_force) {
  const auto n = static_cast<Eigen::Index>(v.size());
  const Eigen::Index columns = with_force ? 7 : 4;
  Eigen::MatrixXd A = Eigen::MatrixXd::Ones(n, columns);
  Eigen::MatrixX3d b(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    A.block<1, 3>(i, 0) = v[k].transpose();
    if (with_force) A.block<1, 3>(i, 3) = f[k].transpose();
    b.row(i) = read[k].transpose();
  }
  TriadFit fit;
  fit.G.setZero();
  for (int axis = 0; axis < 3; ++axis) {
    const Solution s = LeastSquares(A, b.col(axis));
    fit.M.row(axis) = s.x.head<3>().transpose();
    if (with_force) fit.G.row(axis) = s.x.segment<3>(3).transpose();
    fit.bias[axis] = s.x[columns - 1];
    fit.axes_sigma = std::max(fit.axes_sigma, s.sigma.head<3>().maxCoeff());
    if (with_force) fit.G_sigma = std::max(fit.G_sigma, s.sigma.segment<3>(3).maxCoeff());
    fit.bias_sigma = std::max(fit.bias_sigma, s.sigma[columns - 1]);
  }
  TakeApart(fit.M, fit);
  return fit;
}

void AddAxes(const char* sensor, const std::string& what, const sim::TriadErrors& claimed, const TriadFit& found,
             double least, Report& report) {
  constexpr const char* kAxes[] = {"x", "y", "z"};
  constexpr const char* kPairs[] = {"x in y", "x in z", "y in z"};
  const double tolerance = least + kSigmas * found.axes_sigma;
  for (int i = 0; i < 3; ++i) {
    report.Add(Compare(sensor, what + " scale " + kAxes[i], claimed.scale[i], found.scale[i], tolerance, "1"));
    report.Add(Compare(sensor, what + " misalignment " + kAxes[i], claimed.misalignment[i] / kDegree,
                       found.misalignment[i] / kDegree, tolerance / kDegree, "deg"));
    report.Add(Compare(sensor, what + " nonorthogonality, " + kPairs[i], claimed.nonorthogonality[i] / kDegree,
                       found.nonorthogonality[i] / kDegree, 2.0 * tolerance / kDegree, "deg"));
  }
}

double LeastStep(const std::vector<Vec3>& read, double rounding) {
  double least = INFINITY;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Vec3& r : read) values.push_back(r[axis]);
    std::sort(values.begin(), values.end());
    for (std::size_t i = 1; i < values.size(); ++i) {
      const double step = values[i] - values[i - 1];
      if (step > rounding) least = std::min(least, step);
    }
  }
  return least;
}

}  // namespace alula::scenarios::check

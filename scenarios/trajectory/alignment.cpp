#include "scenarios/trajectory/alignment.h"

#include <Eigen/SVD>
#include <numbers>
#include <utility>

#include "scenarios/trajectory/four_dof_alignment.h"

namespace alula::scenarios::trajectory {
namespace {

base::Transform AlignYaw(const std::vector<PosePair>& pairs) {
  FourDofAlignment alignment;
  for (const PosePair& pair : pairs) alignment.Add(pair.estimate.p, pair.truth.p);
  return alignment.X_TE();
}

/// Umeyama 1991, eqs. 40–43: with Σ = (1/n) Σ t' e'ᵀ = U D Vᵀ and S = diag(1, 1, det U det V),
/// R = U S Vᵀ, scale = tr(D S) / ((1/n) Σ |e'|²), p = t̄ − scale R ē.
Similarity AlignFully(const std::vector<PosePair>& pairs, bool with_scale) {
  const double n = static_cast<double>(pairs.size());
  base::Vec3 e = base::Vec3::Zero(), t = base::Vec3::Zero();
  for (const PosePair& pair : pairs) {
    e += pair.estimate.p / n;
    t += pair.truth.p / n;
  }
  base::Mat3 covariance = base::Mat3::Zero();
  double spread = 0.0;
  for (const PosePair& pair : pairs) {
    covariance += (pair.truth.p - t) * (pair.estimate.p - e).transpose() / n;
    spread += (pair.estimate.p - e).squaredNorm() / n;
  }
  const Eigen::JacobiSVD<base::Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const bool mirrored = svd.matrixU().determinant() * svd.matrixV().determinant() < 0;
  const base::Vec3 s(1.0, 1.0, mirrored ? -1.0 : 1.0);
  Similarity best;
  best.X_TE.q = base::Quat(base::Mat3(svd.matrixU() * s.asDiagonal() * svd.matrixV().transpose())).normalized();
  if (with_scale && spread > 0) best.scale = svd.singularValues().dot(s) / spread;
  best.X_TE.p = t - best.scale * (best.X_TE.q * e);
  return best;
}

}  // namespace

Similarity Align(const std::vector<PosePair>& pairs, Freedom freedom) {
  if (pairs.empty() || freedom == Freedom::kNone) return {};
  if (freedom == Freedom::kYaw) return {AlignYaw(pairs), 1.0};
  return AlignFully(pairs, freedom == Freedom::kSimilarity);
}

std::vector<PosePair> Aligned(std::vector<PosePair> pairs, const Similarity& alignment) {
  for (PosePair& pair : pairs) {
    pair.estimate = {(alignment.X_TE.q * pair.estimate.q).normalized(), alignment * pair.estimate.p};
  }
  return pairs;
}

AbsoluteError AbsoluteErrorOf(const std::vector<PosePair>& pairs, Freedom freedom) {
  AbsoluteError error{.alignment = Align(pairs, freedom), .position = {}, .rotation = {}};
  std::vector<double> metres, degrees;
  for (const PosePair& pair : Aligned(pairs, error.alignment)) {
    metres.push_back((pair.estimate.p - pair.truth.p).norm());
    degrees.push_back(base::Log(pair.truth.q.conjugate() * pair.estimate.q).norm() * 180.0 / std::numbers::pi);
  }
  error.position = StatisticsOf(std::move(metres));
  error.rotation = StatisticsOf(std::move(degrees));
  return error;
}

}  // namespace alula::scenarios::trajectory

#include "vehicles/spline_fit.h"

#include <algorithm>

namespace alula::vehicles {

QuinticBasis QuinticBasisAt(double t) {
  // Cox–de Boor on knots one apart: N_{p,j} = (t + p − j)/p N_{p−1,j−1} + (j + 1 − t)/p N_{p−1,j}.
  QuinticBasis basis;
  std::array<double, 6> lower{1.0};
  for (int p = 1; p <= 5; ++p) {
    for (int j = 0; j <= p; ++j) {
      const double left = j > 0 ? lower[static_cast<std::size_t>(j - 1)] : 0.0;
      const double right = j < p ? lower[static_cast<std::size_t>(j)] : 0.0;
      basis.value[static_cast<std::size_t>(j)] = ((t + p - j) * left + (j + 1 - t) * right) / p;
      basis.slope[static_cast<std::size_t>(j)] = left - right;
    }
    lower = basis.value;
  }
  return basis;
}

SplineFit::SplineFit(const std::vector<double>& u, int segments) {
  constexpr double kSmoothing = 1e-6;  // λ: moves a 1 m, 1 Hz sine on knots of 0.1 s by 0.1 µm
  constexpr std::array<double, 4> kThird{-1, 3, -3, 1};
  const std::size_t n = static_cast<std::size_t>(segments) + kBand;
  factor_.resize(n);
  places_.reserve(u.size());
  for (const double at : u) {
    const int segment = std::clamp(static_cast<int>(at), 0, segments - 1);
    places_.push_back({segment, QuinticBasisAt(at - segment)});
    for (int r = 0; r <= kBand; ++r) {
      for (int c = 0; c <= r; ++c) {
        factor_[static_cast<std::size_t>(segment + r)][static_cast<std::size_t>(r - c)] +=
            places_.back().basis.value[static_cast<std::size_t>(r)] *
            places_.back().basis.value[static_cast<std::size_t>(c)];
      }
    }
  }
  const double weight = kSmoothing * std::max(1.0, static_cast<double>(u.size()) / segments);
  for (std::size_t first = 0; first + kThird.size() <= n; ++first) {
    for (std::size_t r = 0; r < kThird.size(); ++r) {
      for (std::size_t c = 0; c <= r; ++c) factor_[first + r][r - c] += weight * kThird[r] * kThird[c];
    }
  }
  Factor();
}

void SplineFit::Factor() {
  for (std::size_t i = 0; i < factor_.size(); ++i) {
    const std::size_t reach = std::min<std::size_t>(i, kBand);
    for (std::size_t d = reach; d >= 1; --d) {  // L(i, i−d), leftmost first
      const std::size_t j = i - d;
      for (std::size_t k = j >= kBand ? std::max(j - kBand, i - reach) : i - reach; k < j; ++k) {
        factor_[i][d] -= factor_[i][i - k] * factor_[k][0] * factor_[j][j - k];
      }
      factor_[i][d] /= factor_[j][0];
    }
    for (std::size_t d = 1; d <= reach; ++d) factor_[i][0] -= factor_[i][d] * factor_[i][d] * factor_[i - d][0];
  }
}

std::vector<base::Vec3> SplineFit::Solve(const std::vector<base::Vec3>& samples) const {
  std::vector<base::Vec3> x(factor_.size(), base::Vec3::Zero());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    for (std::size_t j = 0; j <= kBand; ++j) {
      x[static_cast<std::size_t>(places_[i].segment) + j] += places_[i].basis.value[j] * samples[i];
    }
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t d = 1; d <= std::min<std::size_t>(i, kBand); ++d) x[i] -= factor_[i][d] * x[i - d];
  }
  for (std::size_t i = 0; i < x.size(); ++i) x[i] /= factor_[i][0];
  for (std::size_t i = x.size(); i-- > 0;) {
    for (std::size_t d = 1; d <= kBand && i + d < x.size(); ++d) x[i] -= factor_[i + d][d] * x[i + d];
  }
  return x;
}

}  // namespace alula::vehicles

#include "worlds/dryden.h"

#include <algorithm>
#include <cmath>

namespace alula::worlds {
namespace {

using base::Vec2;

/// Lower triangular root of ∫₀^U e^(−2u) [1 u; u u²] du: (l11, l21, l22). By series where the closed form cancels.
base::Vec3 NoiseRoot(double U) {
  double q11, q12, q22;
  if (U < 0.02) {  // the next terms are below 1e-7 of these
    const double U2 = U * U, U3 = U2 * U;
    q11 = U - U2 + 2.0 / 3.0 * U3 - U2 * U2 / 3.0;
    q12 = U2 / 2.0 - 2.0 / 3.0 * U3 + U2 * U2 / 2.0 - 4.0 / 15.0 * U2 * U3;
    q22 = U3 / 3.0 - U2 * U2 / 2.0 + 2.0 / 5.0 * U2 * U3 - 2.0 / 9.0 * U3 * U3;
  } else {
    const double e = std::exp(-2.0 * U);
    q11 = 0.5 * (1.0 - e);
    q12 = 0.25 * (1.0 - (1.0 + 2.0 * U) * e);
    q22 = 0.25 * (1.0 - (1.0 + 2.0 * U + 2.0 * U * U) * e);
  }
  const double l11 = std::sqrt(q11);
  const double l21 = l11 > 0.0 ? q12 / l11 : 0.0;
  return {l11, l21, std::sqrt(std::max(q22 - l21 * l21, 0.0))};
}

}  // namespace

DrydenScales ScalesAt(double height, double w20) {
  constexpr double kFoot = 0.3048;  // m
  const double feet = std::clamp(height / kFoot, 10.0, 1000.0);
  const double factor = 0.177 + 0.000823 * feet;
  DrydenScales scales;
  scales.length_w = kFoot * feet;
  scales.length_u = kFoot * feet / std::pow(factor, 1.2);
  scales.sigma_w = 0.1 * w20;
  scales.sigma_u = scales.sigma_w / std::pow(factor, 0.4);
  return scales;
}

DrydenTurbulence::DrydenTurbulence(base::RandomStream& random) : u_(random.Gaussian()) {
  for (Vec2& ab : chain_) {  // stationary covariance [½ ¼; ¼ ¼]
    const double n1 = random.Gaussian();
    const double n2 = random.Gaussian();
    ab = {std::sqrt(0.5) * n1, std::sqrt(0.125) * n1 + std::sqrt(0.125) * n2};
  }
}

base::Vec3 DrydenTurbulence::Advance(const Dryden& dryden, double height, double airspeed, base::Duration dt,
                                     base::RandomStream& random) {
  const DrydenScales scales = ScalesAt(height, dryden.w20);
  const double V = std::max(airspeed, dryden.airspeed_floor);
  const double decay_u = std::exp(-dt.Seconds() * V / scales.length_u);
  u_ = decay_u * u_ + std::sqrt(1.0 - decay_u * decay_u) * random.Gaussian();
  std::array<double, 2> out{};
  for (std::size_t i = 0; i < 2; ++i) {
    const double U = dt.Seconds() * V / (i == 0 ? scales.length_u : scales.length_w);
    const double decay = std::exp(-U);
    const base::Vec3 root = NoiseRoot(U);
    const double n1 = random.Gaussian();
    const double n2 = random.Gaussian();
    Vec2& ab = chain_[i];
    ab = {decay * ab.x() + root.x() * n1, decay * (ab.y() + U * ab.x()) + root.y() * n1 + root.z() * n2};
    out[i] = std::sqrt(3.0) * ab.x() + (1.0 - std::sqrt(3.0)) * ab.y();
  }
  return {scales.sigma_u * u_, scales.sigma_u * out[0], scales.sigma_w * out[1]};
}

}  // namespace alula::worlds

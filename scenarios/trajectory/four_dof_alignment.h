#pragma once

#include <cstdint>

#include "base/frames.h"

namespace alula::scenarios::trajectory {

/// RMSE of position pairs, as they are and after the best shift and turn about the vertical; running sums only.
///
/// With centred e' (estimate) and t' (truth), C = Σ e'·t' and S = Σ e' × t' in the horizontal plane, the best yaw is
/// atan2(S, C) and  n·RMSE² = Σ|t'|² + Σ|e'|² − 2 (√(C² + S²) + Σ e'_z t'_z)  (Umeyama 1991, restricted to yaw).
class FourDofAlignment {
 public:
  void Add(const base::Vec3& estimate, const base::Vec3& truth);
  std::int64_t count() const { return n_; }
  /// Infinite for no pair, as is UnalignedRmse.
  double AlignedRmse() const;
  double UnalignedRmse() const;
  double yaw() const;  // that turns estimate into truth, rad
  /// What turns and shifts the estimate onto the truth; identity for no pair.
  base::Transform X_TE() const;

 private:
  struct Centred {
    double ee, tt, cos_sum, sin_sum, zz;
  };
  Centred Centre() const;

  std::int64_t n_ = 0;
  base::Vec3 origin_ = base::Vec3::Zero();  // the first truth, subtracted so that the sums stay small
  base::Vec3 e_ = base::Vec3::Zero(), t_ = base::Vec3::Zero();
  base::Mat3 et_ = base::Mat3::Zero();
  double ee_ = 0.0, tt_ = 0.0, difference_ = 0.0;
};

}  // namespace alula::scenarios::trajectory

#pragma once

#include <deque>
#include <utility>

#include "base/describe.h"
#include "scenarios/criteria/criterion.h"

namespace alula::scenarios {

/// RMSE of position pairs, as they are and after the best shift and turn about the vertical; running sums only.
///
/// With centred e' (estimate) and t' (truth), C = Σ e'·t' and S = Σ e' × t' in the horizontal plane, the best yaw is
/// atan2(S, C) and  n·RMSE² = Σ|t'|² + Σ|e'|² − 2 (√(C² + S²) + Σ e'_z t'_z)  (Umeyama 1991, restricted to yaw).
class FourDofAlignment {
 public:
  void Add(const base::Vec3& estimate, const base::Vec3& truth);
  std::int64_t count() const { return n_; }
  double AlignedRmse() const;
  double UnalignedRmse() const;
  double yaw() const;  // that turns estimate into truth, rad

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

/// Absolute trajectory error of the published map-frame pose, online, from take-off on.
struct AteConfig {
  double aligned = 0.5;    // m, limit of the RMSE after 4-DoF alignment
  double unaligned = 1.0;  // m, limit of the RMSE as it is
  base::Rate rate{50, 1};  // pairs a second, at most
};
void Describe(base::Description& d, AteConfig& c);

class Ate : public Criterion {
 public:
  explicit Ate(const AteConfig& config) : config_(config) {}
  std::optional<std::string> Observe(const sim::StepView& step) override;
  std::vector<Check> Checks() const override;
  void AddMetrics(Metrics& metrics) const override;

 private:
  std::optional<base::Vec3> TruthAt(base::Time stamp) const;

  AteConfig config_;
  FourDofAlignment pairs_;
  std::deque<std::pair<base::Time, base::Vec3>> truth_;  // of the last second
  std::int64_t next_ = 0;
  bool flying_ = false;
  double largest_ = 0.0;
  base::Vec3 last_error_ = base::Vec3::Zero();
};

}  // namespace alula::scenarios

#pragma once

#include <deque>
#include <utility>

#include "base/describe.h"
#include "scenarios/criteria/criterion.h"
#include "scenarios/trajectory/four_dof_alignment.h"

namespace alula::scenarios {

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
  trajectory::FourDofAlignment pairs_;
  std::deque<std::pair<base::Time, base::Vec3>> truth_;  // of the last second
  std::int64_t next_ = 0;
  bool flying_ = false;
  double largest_ = 0.0;
  base::Vec3 last_error_ = base::Vec3::Zero();
};

}  // namespace alula::scenarios

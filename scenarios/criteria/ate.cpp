#include "scenarios/criteria/ate.h"

#include <algorithm>
#include <cmath>

namespace alula::scenarios {
namespace {

constexpr double kTakeOffHeight = 0.1;  // m above standing: before that there is no trajectory to be wrong about
constexpr base::Duration kMemory = base::Seconds(1.0);

}  // namespace

void Describe(base::Description& d, AteConfig& c) {
  d.Field("aligned", c.aligned, {.unit = "m", .meaning = "limit of the RMSE after 4-DoF alignment", .min = 0});
  d.Field("unaligned", c.unaligned, {.unit = "m", .meaning = "limit of the RMSE as published", .min = 0});
  d.Field("rate", c.rate, {.unit = "Hz", .meaning = "pairs compared, at most"});
}

std::optional<base::Vec3> Ate::TruthAt(base::Time stamp) const {
  const auto after = std::lower_bound(truth_.begin(), truth_.end(), stamp,
                                      [](const auto& entry, base::Time t) { return entry.first < t; });
  if (after == truth_.end() || (after == truth_.begin() && after->first != stamp)) return std::nullopt;
  if (after->first == stamp) return after->second;
  const auto before = std::prev(after);
  const double s = (stamp - before->first).Seconds() / (after->first - before->first).Seconds();
  return base::Vec3((1.0 - s) * before->second + s * after->second);
}

std::optional<std::string> Ate::Observe(const sim::StepView& step) {
  const base::Vec3& p_WB = step.truth.at_end.X_WB.p;
  if (truth_.empty()) truth_.emplace_back(step.truth.begin, step.truth.at_begin.X_WB.p);
  truth_.emplace_back(step.time, p_WB);
  while (step.time - truth_.front().first > kMemory) truth_.pop_front();
  if (p_WB.z() - step.world.X_WB_start.p.z() - step.vehicle.body().standing_height > kTakeOffHeight) flying_ = true;
  if (!flying_ || step.output == nullptr || !step.output->estimate || config_.rate.SampleTime(next_) > step.time) {
    return std::nullopt;
  }
  const stack::Estimate& estimate = *step.output->estimate;
  const std::optional<base::Vec3> truth = TruthAt(estimate.stamp);
  if (!truth) return std::nullopt;
  while (config_.rate.SampleTime(next_) <= step.time) ++next_;
  const base::Vec3 p_MB = estimate.X_MO * estimate.X_OB.p;
  pairs_.Add(p_MB, *truth);
  last_error_ = p_MB - *truth;
  largest_ = std::max(largest_, last_error_.norm());
  return std::nullopt;
}

std::vector<Check> Ate::Checks() const {
  return {AtMost("ate_online", pairs_.AlignedRmse(), config_.aligned, "m"),
          AtMost("ate_unaligned", pairs_.UnalignedRmse(), config_.unaligned, "m")};
}

void Ate::AddMetrics(Metrics& metrics) const {
  if (pairs_.count() == 0) return;
  metrics["ate_online_m"] = pairs_.AlignedRmse();
  metrics["ate_unaligned_m"] = pairs_.UnalignedRmse();
  metrics["estimate_yaw_error_deg"] = pairs_.yaw() * 180.0 / 3.14159265358979323846;
  metrics["estimate_largest_error_m"] = largest_;
  metrics["estimate_last_error_m"] = last_error_.norm();
}

}  // namespace alula::scenarios

#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/trajectory/alignment.h"
#include "scenarios/trajectory/completeness.h"
#include "scenarios/trajectory/relative_error.h"

namespace alula::scenarios::trajectory {

/// All that is said of one estimated trajectory.
struct TrajectoryReport {
  Completeness completeness;
  std::int64_t pairs = 0;  // poses with a truth
  double path = 0.0;       // m, true, from the first pair to the last
  AbsoluteError yaw_aligned, rigidly_aligned, unaligned;
  std::optional<AbsoluteError> scaled;  // where scale is free; all that follows is then of the scaled estimate
  RelativeError second, metre, ten_metres;
  PathDrift drift;
  EndError end;
};

struct ReportRequest {
  std::vector<base::Time> images;  // of the recording's first camera
  bool scale_is_free = false;      // one camera without an IMU
};

/// Judges an estimate of the body's pose against the truth of it. Both ascend in time.
TrajectoryReport Judge(const std::vector<base::StampedPose>& estimate, const std::vector<base::StampedPose>& truth,
                       const ReportRequest& request);

/// A report under a name: "online", "final".
struct NamedReport {
  std::string name;
  TrajectoryReport report;
};

/// Numbers with names as verdict.json has them, of one report: ate_<name>_m (4-DoF), ate_se3_<name>_m, …. Only finite
/// ones.
std::map<std::string, double> MetricsOf(const NamedReport& named);

/// A table for a person: a row a figure, a column a trajectory. Without any truth only what needs none.
std::string ToTable(const std::vector<NamedReport>& reports);

}  // namespace alula::scenarios::trajectory

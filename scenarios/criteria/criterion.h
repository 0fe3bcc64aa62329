#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/observer.h"

namespace alula::scenarios {

/// One line of a verdict: what was measured against which limit. A check without a limit of its own says 0 and 1.
struct Check {
  std::string name;
  double measured = 0.0;
  double limit = 0.0;
  std::string unit;
  bool passed = false;
  std::string relation = "<=";  // how measured must stand to limit
};

/// Numbers of a run, names with units ("path_length_m").
using Metrics = std::map<std::string, double>;

/// Judges a run from the truth and Bullet's geometry alone (an ATE also from the published estimate that it judges).
class Criterion : public sim::Observer {
 public:
  virtual std::vector<Check> Checks() const = 0;
  virtual void AddMetrics(Metrics&) const {}
};

Check AtMost(std::string name, double measured, double limit, std::string unit);
Check AtLeast(std::string name, double measured, double limit, std::string unit);

}  // namespace alula::scenarios

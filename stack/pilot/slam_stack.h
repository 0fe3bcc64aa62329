#pragma once

#include <cstdint>
#include <memory>

#include "base/describe.h"
#include "base/time.h"
#include "stack/interface/calibration.h"
#include "stack/interface/mission.h"
#include "stack/interface/navigation_stack.h"
#include "stack/slam/slam_config.h"

namespace alula::stack::pilot {

struct SlamStackConfig {
  slam::SlamConfig slam;
  base::Duration latency = base::Milliseconds(40);          // declared, of a frame
  base::Duration estimate_period = base::Milliseconds(10);  // 100 Hz
};
void Describe(base::Description& d, SlamStackConfig& c);

/// The estimator alone: it watches, publishes where it believes to be, and commands nothing. For prescribed flights.
/// Throws base::InputError where the calibration does not hold what the estimator needs.
std::unique_ptr<NavigationStack> MakeSlamStack(const Calibration& calibration, const Mission& mission,
                                               const SlamStackConfig& config, int workers);

}  // namespace alula::stack::pilot

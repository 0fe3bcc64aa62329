#pragma once

#include <optional>
#include <vector>

#include "base/frames.h"
#include "stack/planning/global_planner.h"

namespace alula::stack::planning::internal {

/// Informed-RRT* (Gammell, Srinivasa, Barfoot 2014) of OMPL on one checker, `config.iterations` rounds; the path found
/// with its interior points, or nothing. Seeds OMPL's global generator, under a lock.
std::optional<std::vector<base::Vec3>> SearchInformedRrtStar(const PlanRequest& request, const SegmentChecker& checker,
                                                             const GlobalPlannerConfig& config);

}  // namespace alula::stack::planning::internal

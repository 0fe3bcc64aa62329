#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "stack/interface/navigation_stack.h"
#include "stack/planning/route_planner.h"

namespace alula::stack::pilot {

/// What the mission is told each tick.
struct MissionInput {
  base::Time now;
  bool initialised = false;  // the odometry runs
  bool healthy = false;      // … and may be trusted
  base::Transform X_OB;      // now
  base::Vec3 v_OB = base::Vec3::Zero();
  VehicleStatus status;
  bool status_known = false;
};

struct MissionOutput {
  std::vector<Command> commands;
  std::vector<StackEvent> events;
  /// A route to plan; the answer comes through OnRoute.
  std::optional<planning::RouteRequest> request;
};

inline void Say(MissionOutput& out, base::Time now, std::string kind, std::string text) {
  out.events.push_back({now, std::move(kind), std::move(text)});
}

}  // namespace alula::stack::pilot

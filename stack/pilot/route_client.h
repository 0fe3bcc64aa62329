#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/time.h"
#include "stack/planning/route_planner.h"

namespace alula::stack::pilot {

/// What is known of the last routes asked for.
struct RouteAnswer {
  bool ok = true;                                              // the last answer was a route
  std::string reason;                                          // … or else why it was not
  planning::RouteEnd end = planning::RouteEnd::kUnknownSpace;  // of the last route
  bool to_target = false;                                      // the last route was asked to lead to the target
};

/// Asks for routes, one at a time, and judges the answers. Planning takes a while: an answer counts only when the
/// trajectory has the generation that it had when the route was asked for.
class RouteClient {
 public:
  /// No route is being planned, and the map is new or the last question is a while ago.
  bool Due(base::Time now, bool new_map) const;
  /// Numbers the request and remembers what the answer will be judged by.
  void Ask(base::Time now, std::uint64_t generation, planning::RouteRequest& request);
  /// True when the result is a route to be flown.
  bool Accept(std::uint64_t generation, const planning::RouteResult& result);

  bool asked() const { return count_ > 0; }
  const RouteAnswer& last() const { return last_; }
  /// The passages of the last request.
  const std::vector<planning::Passage>& passages() const { return passages_; }
  /// How the last route's legs went: the next one goes the same way where it can.
  const std::vector<planning::Leg>& legs() const { return legs_; }
  void ForgetLegs() { legs_.clear(); }

 private:
  bool in_flight_ = false;
  std::uint64_t count_ = 0;
  base::Time asked_at_;
  std::uint64_t asked_generation_ = 0;
  bool asked_target_ = false;
  std::vector<planning::Passage> passages_;
  RouteAnswer last_;
  std::vector<planning::Leg> legs_;
};

}  // namespace alula::stack::pilot

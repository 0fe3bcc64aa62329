#include "stack/pilot/route_client.h"

namespace alula::stack::pilot {

namespace {

constexpr base::Duration kIdleReplan = base::Milliseconds(400);  // without a new map a route is asked for this often

}  // namespace

bool RouteClient::Due(base::Time now, bool new_map) const {
  return !in_flight_ && (new_map || now - asked_at_ >= kIdleReplan);
}

void RouteClient::Ask(base::Time now, std::uint64_t generation, planning::RouteRequest& request) {
  request.number = ++count_;
  passages_ = request.passages;
  asked_target_ = request.target_O.has_value();
  asked_generation_ = generation;
  asked_at_ = now;
  in_flight_ = true;
}

bool RouteClient::Accept(std::uint64_t generation, const planning::RouteResult& result) {
  in_flight_ = false;
  if (asked_generation_ != generation) return false;  // the vehicle has braked or turned since: out of date
  last_.ok = result.ok;
  last_.reason = result.reason;
  if (!result.ok) return false;
  last_.end = result.end;
  last_.to_target = asked_target_;
  legs_ = result.legs;
  return true;
}

}  // namespace alula::stack::pilot

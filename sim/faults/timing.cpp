#include "sim/faults/timing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace alula::sim::faults {
namespace {

using base::Time;

/// Empty, or what is wrong with a pair of bounds.
std::string Contradiction(const std::optional<double>& above, const std::optional<double>& below,
                          const std::string& what) {
  if (!above || !below || *above < *below) return {};
  return what + "_above is not less than " + what + "_below: this can never hold; swap or drop one";
}

bool StatesNothing(const Condition& c) {
  return !c.height_above && !c.height_below && !c.speed_above && !c.speed_below && !c.target_within &&
         !c.gates_passed && !c.mode;
}

constexpr double kLongest = 1e9;  // s: far beyond any run

std::string WrongBegin(const Timing& c) {
  const int given = (c.at ? 1 : 0) + (c.when ? 1 : 0) + (c.rate ? 1 : 0);
  if (given == 1) return {};
  return given == 0 ? "never begins; add one of `at` (a time), `when` (a condition) and `rate` (at random)"
                    : "begins in more than one way; keep one of `at`, `when` and `rate`";
}

std::string WrongPeriod(const Timing& c) {
  if (!c.every) return {};
  if (!c.at) return "repeats what begins at a time; add `at`, or drop it";
  if (!c.duration) return "repeats a fault that never ends; add `duration`, or drop it";
  return *c.every < *c.duration ? "is shorter than the fault's own duration; lengthen it" : "";
}

std::string WrongTimes(const Timing& c) {
  if (!c.times || *c.times == 1) return {};
  if (c.at && !c.every) return "counts repetitions; add `every`, or drop it";
  return c.duration ? "" : "counts repetitions of a fault that never ends; add `duration`, or drop it";
}

}  // namespace

void Describe(base::Description& d, Condition& c) {
  d.Field("height_above", c.height_above, {.unit = "m", .meaning = "the body origin is higher above the pad"});
  d.Field("height_below", c.height_below, {.unit = "m", .meaning = "… lower above the pad"});
  d.Field("speed_above", c.speed_above, {.unit = "m/s", .meaning = "it moves faster", .min = 0});
  d.Field("speed_below", c.speed_below, {.unit = "m/s", .meaning = "… slower", .min = 0});
  d.Field("target_within", c.target_within, {.unit = "m", .meaning = "the course's end is nearer", .min = 0});
  d.Field("gates_passed", c.gates_passed,
          {.meaning = "so many gates are behind, in order and forward", .min = 1, .origin = &c.gates_origin});
  d.Field("mode", c.mode,
          {.meaning = "the autopilot is in this mode",
           .choices = {"disarmed", "ready", "following", "holding", "landing"},
           .origin = &c.mode_origin});
  d.Check("height_above", [&c] {
    return StatesNothing(c) ? std::string("states no condition; add one")
                            : Contradiction(c.height_above, c.height_below, "height");
  });
  d.Check("speed_above", [&c] { return Contradiction(c.speed_above, c.speed_below, "speed"); });
}

void DescribeTiming(base::Description& d, Timing& c) {
  d.Field("name", c.name, {.meaning = "in events; none: its type and number", .origin = &c.name_origin});
  d.Field("at", c.at, {.unit = "s", .meaning = "begins at this time", .min = 0, .max = kLongest});
  d.Field("when", c.when, {.meaning = "begins when this comes to hold"});
  d.Field("rate", c.rate, {.unit = "Hz", .meaning = "begins at random, so often in the mean", .min = 1e-9, .max = 1e3});
  d.Field("duration", c.duration,
          {.unit = "s", .meaning = "lasts so long; none: to the end", .min = 1e-6, .max = kLongest});
  d.Field("every", c.every,
          {.unit = "s", .meaning = "with `at`: begins again so long after it began", .min = 1e-3, .max = kLongest});
  d.Field("times", c.times, {.meaning = "begins so often at most", .min = 1, .max = 1e9});
  d.Check("at", [&c] { return WrongBegin(c); });
  d.Check("every", [&c] { return WrongPeriod(c); });
  d.Check("times", [&c] { return WrongTimes(c); });
}

void CheckTiming(const Timing& timing, const Scope& scope) {
  if (!timing.when) return;
  const Condition& c = *timing.when;
  if (c.gates_passed && *c.gates_passed > scope.gates) {
    throw base::InputError(c.gates_origin.where, c.gates_origin.path,
                           "can never be: this world has " + std::to_string(scope.gates) + " gates");
  }
  if (c.mode && !scope.autopilot) {
    throw base::InputError(c.mode_origin.where, c.mode_origin.path, "can never be: this scenario has no autopilot");
  }
}

bool Holds(const Condition& c, const Situation& s) {
  return (!c.height_above || s.height > *c.height_above) && (!c.height_below || s.height < *c.height_below) &&
         (!c.speed_above || s.speed > *c.speed_above) && (!c.speed_below || s.speed < *c.speed_below) &&
         (!c.target_within || s.target_distance < *c.target_within) &&
         (!c.gates_passed || s.gates_passed >= *c.gates_passed) && (!c.mode || s.mode == *c.mode);
}

Onset::Onset(const Timing& timing, std::uint64_t seed, const std::string& name)
    : timing_(timing), stream_(seed, "faults/" + name + "/onset") {
  const bool again = timing.every || timing.rate;
  left_ = timing.times ? *timing.times : again ? std::numeric_limits<std::int64_t>::max() : 1;
  if (timing.at) next_ = Time{} + *timing.at;
  if (timing.rate) next_ = Time{} + Gap();
}

/// Exponential, within what nanoseconds can count.
base::Duration Onset::Gap() {
  return base::Seconds(std::min(kLongest, -std::log1p(-stream_.Uniform()) / *timing_.rate));
}

std::optional<Time> Onset::Begin(const Situation& s, bool rises) const {
  if (timing_.when) return rises ? std::optional(s.now) : std::nullopt;
  if (s.now < *next_) return std::nullopt;
  return timing_.at ? next_ : s.now;
}

bool Onset::Lasts(const Situation& s) {
  const bool holds = timing_.when && Holds(*timing_.when, s);
  const bool rises = holds && !held_;
  held_ = holds;
  if (lasts_ && until_ && s.now >= *until_) {
    lasts_ = false;
    if (timing_.every) *next_ += *timing_.every;
    if (timing_.rate) next_ = *until_ + Gap();
  }
  if (lasts_ || left_ == 0) return lasts_;
  const std::optional<Time> begin = Begin(s, rises);
  if (!begin) return false;
  lasts_ = true;
  --left_;
  if (timing_.duration) until_ = *begin + *timing_.duration;
  return true;
}

}  // namespace alula::sim::faults

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/time.h"

namespace alula::scenarios::replay {

/// Where two runs, A and B, first part.
struct Difference {
  base::Time time;        // of measurements, estimates, commands, events: the step's begin; of the truth: its end
  std::int64_t step = 0;  // counted from 0
  std::string stream;     // "measurements", "estimates", "commands", "events", "truth"; "run" where one of them ends
  std::string record;     // "vehicle0/imu seq 812", "position_setpoint", an event's kind; empty for estimate and truth
  std::string field;      // "p_OB.z"; empty where one run has no such record
  std::optional<std::string> a, b;  // the values, doubles with round-trip digits; none: that run has no such record
  std::string note;                 // of images: how much of them differs

  bool operator==(const Difference&) const = default;
};

/// "5.000 s": at least three decimals, all that are not zero.
std::string TimeText(base::Time time);

}  // namespace alula::scenarios::replay

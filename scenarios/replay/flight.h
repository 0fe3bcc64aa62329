#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "scenarios/replay/compare_steps.h"
#include "scenarios/replay/run_case.h"

namespace alula::scenarios::replay {

/// A run flown again, to its end or as far as was asked for.
struct Flight {
  std::vector<sim::DigestRow> rows;
  bool complete = false;  // it came to its own end
  std::string digest;     // of all that was flown
  std::string numeric_class;
  Stretch last;  // steps of its last interval; none where it ended with one
};

/// Asked after every whole interval, with the rows so far: true ends the flight.
using StopRule = std::function<bool(const std::vector<sim::DigestRow>&)>;

/// Flies the case in this process and writes nothing. Holds the records of one interval at a time. Throws as
/// RunScenario does.
Flight FlyAgain(const RunCase& run, base::Duration interval, const StopRule& stop);

}  // namespace alula::scenarios::replay

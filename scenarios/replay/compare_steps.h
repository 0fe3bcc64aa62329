#pragma once

#include <optional>
#include <vector>

#include "scenarios/replay/difference.h"
#include "scenarios/replay/records.h"

namespace alula::scenarios::replay {

/// A stretch of one run: its steps and how its sensors are called.
struct Stretch {
  std::vector<KeptStep> steps;
  SensorNames sensors;
  std::string end;  // why the run ended after these steps; empty where it goes on
};

/// The first record, in the order of the loop, in which two stretches that begin at the same time differ: step by step,
/// measurements before estimates, commands, events and the truth that follows from them. Measurements are paired by
/// their sensors' names; the numbers that a run gives its sensors, and so the order within a step, count only where
/// nothing else differs (a run with one more sensor numbers others anew).
std::optional<Difference> CompareSteps(const Stretch& a, const Stretch& b);

}  // namespace alula::scenarios::replay

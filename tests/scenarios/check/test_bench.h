#pragma once

#include <set>
#include <string>

#include "scenarios/check/camera_bench.h"
#include "scenarios/check/rig.h"
#include "scenarios/check/row.h"
#include "tests/sim/test_world.h"

namespace alula::scenarios::check::testing {

/// A suite with nothing in it, on a plate.
inline Rig EmptyRig() {
  Rig rig;
  rig.sensors.imu.reset();
  rig.sensors.barometer.reset();
  rig.body = sim::testing::PlateOnLegs();
  return rig;
}

/// Quantities whose rows did not pass.
inline std::set<std::string> Failed(const Report& report) {
  std::set<std::string> failed;
  for (const Row& row : report.rows) {
    if (!row.passed) failed.insert(row.quantity);
  }
  return failed;
}

using Names = std::set<std::string>;

}  // namespace alula::scenarios::check::testing

#pragma once

#include <string>
#include <vector>

#include "scenarios/scenario.h"

namespace alula::scenarios::replay {

/// A key in which two scenarios differ.
struct ConfigDifference {
  std::string path;  // "world.objects.2.shape.size": as --set takes it
  std::string a, b;  // as in scenario.yaml; "absent" where a scenario has no such key
};

/// All keys in which two resolved scenarios differ, in the order of A's file, then those that only B has, map by map.
/// `meaning` is none: no run depends on it.
std::vector<ConfigDifference> DifferentKeys(const ScenarioConfig& a, const ScenarioConfig& b);

}  // namespace alula::scenarios::replay

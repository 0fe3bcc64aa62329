#pragma once

#include "base/describe.h"
#include "stack/estimation/odometry_config.h"
#include "stack/slam/map_config.h"

namespace alula::stack::slam {

/// Everything that the estimator can be told.
struct SlamConfig {
  estimation::OdometryConfig odometry;
  MapConfig map;
};
void Describe(base::Description& d, SlamConfig& c);

}  // namespace alula::stack::slam

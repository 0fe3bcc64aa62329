#pragma once

#include <cstdint>
#include <memory>

#include "base/describe.h"
#include "stack/estimation/odometry.h"
#include "stack/interface/navigation_stack.h"
#include "stack/mapping/occupancy_map.h"
#include "stack/mapping/stereo_depth.h"
#include "stack/perception/gate_finder.h"
#include "stack/pilot/gate_mission.h"
#include "stack/pilot/map_alignment.h"
#include "stack/pilot/sensor_watch.h"
#include "stack/planning/route_planner.h"

namespace alula::stack::pilot {

/// How long each stage takes by declaration; the benchmark fails when the measured p99 is longer.
struct DeclaredLatencies {
  base::Duration odometry = base::Milliseconds(40);
  base::Duration mapping = base::Milliseconds(80);  // depth, map and gates together
  base::Duration planning = base::Milliseconds(100);
};
void Describe(base::Description& d, DeclaredLatencies& c);

struct VisualInertialConfig {
  estimation::OdometryConfig odometry;
  mapping::StereoDepthConfig depth;
  mapping::OccupancyMapConfig map;
  perception::GateFinderConfig gate_finder;
  planning::RouteConfig route;
  MapAlignmentConfig alignment;
  GateMissionConfig mission;
  SensorWatchConfig watch;
  DeclaredLatencies latency;
  int depth_every = 2;  // every this many-th stereo pair goes into the map: 10 Hz of 20 Hz
  base::Duration estimate_period = base::Milliseconds(10);  // 100 Hz
  double map_margin = 1.0;                                  // m of map around the mission's bounds
  bool publish_alignment = false;  // send X_MO as the gates suggest it; off: identity (O is the mission's frame)
};
void Describe(base::Description& d, VisualInertialConfig& c);

/// Stereo-inertial odometry, stereo depth, occupancy map, gates, planning and the gate mission as one stack. Slow work
/// runs as jobs (job_queue.h) on `workers` threads; the result does not depend on their number.
/// Throws base::InputError when the calibration lacks a stereo pair or an IMU.
std::unique_ptr<NavigationStack> MakeVisualInertialStack(const Calibration& calibration, const Mission& mission,
                                                         const VisualInertialConfig& config, std::uint64_t seed,
                                                         int workers);

}  // namespace alula::stack::pilot

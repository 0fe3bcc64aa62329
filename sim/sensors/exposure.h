#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim/sensors/auto_exposure.h"
#include "sim/sensors/camera_config.h"

namespace alula::sim {

/// Where the camera and the vehicle are at one instant, and the links of the world's actors where there are some.
struct Instant {
  base::Transform X_WC, X_WB;
  base::Time time{};
  std::vector<base::Transform> X_WL{};
};

/// All that one picture depends on besides the camera itself. A slice is a band of rows that are drawn as if they were
/// exposed together; its pictures at the instants are averaged.
struct Exposure {
  struct Slice {
    int first_row = 0;
    int rows = 0;
    std::vector<Instant> instants;
  };
  std::uint32_t seq = 0;
  base::Time captured;  // middle of the exposure of the middle row
  ExposureSetting setting;
  std::vector<Slice> slices;
};

/// When an exposure begins and ends: half its length and half the rolling of the rows about `captured`.
base::Duration HalfSpan(const CameraConfig& config, base::Duration length);

/// Cuts an exposure into bands of rows and instants so that between neighbouring instants nothing 1.5 m away or farther
/// moves more than `step` px in the picture, and between neighbouring bands a third of that: without blur one instant a
/// band, without rolling shutter one band. `seen_speed`: of what moves by itself, as the camera sees it, rad/s.
Exposure PlanExposure(const CameraConfig& config, double focal, const ExposureSetting& setting, base::Time captured,
                      const std::function<Instant(base::Time)>& at, double step = 0.75, double seen_speed = 0.0);

}  // namespace alula::sim

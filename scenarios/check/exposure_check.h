#pragma once

#include <vector>

#include "scenarios/check/camera_bench.h"
#include "scenarios/check/row.h"

namespace alula::scenarios::check {

/// Exposure control as configured, before a dark wall and then a bright one: the mean that it settles at, the frames
/// until it answers, and the share of the error that it takes away. Nothing where the camera has none.
void CheckExposureControl(const Rig& rig, const CameraGroup& group, const sim::CameraConfig& claimed, Report& report);

}  // namespace alula::scenarios::check

#pragma once

#include "scenarios/check/camera_bench.h"
#include "scenarios/check/row.h"

namespace alula::scenarios::check {

/// The depth camera of an RGB-D group before walls at known distances: bias and spread against range, range limits,
/// share of holes, the shadow beside an edge, the slant and the light at which depth is lost, read-out and, where depth
/// is registered, its edges against those of the colour picture.
void CheckDepth(const Rig& isolated, const CameraGroup& group, const sim::RgbdCameraConfig& claimed, Report& report);

}  // namespace alula::scenarios::check

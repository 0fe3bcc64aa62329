#pragma once

#include "scenarios/check/camera_bench.h"
#include "scenarios/check/row.h"

namespace alula::scenarios::check {

/// Rate, read-out time, and the shares of frames that are lost, late or frozen. Pictures are drawn small for it: what
/// becomes of a frame does not depend on its size.
void CheckFrameFaults(const Rig& rig, const CameraGroup& group, const sim::CameraConfig& claimed, Report& report);

}  // namespace alula::scenarios::check

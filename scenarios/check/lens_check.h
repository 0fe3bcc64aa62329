#pragma once

#include <vector>

#include "scenarios/check/calibration.h"
#include "scenarios/check/row.h"

namespace alula::scenarios::check {

/// Calibrates each camera of a group on pictures of the board and compares focal lengths, centre, coefficients, the
/// pixels that they give, the camera's place on the body and, of a pair, its baseline and turn with those of `claimed`
/// (as GeometryOf gives it). Gives the geometry as measured; where it could not be, the row says so and the geometry is
/// as claimed.
std::vector<CameraGeometry> CheckLens(const Rig& isolated, const CameraGroup& group,
                                      const std::vector<CameraGeometry>& claimed, Report& report);

}  // namespace alula::scenarios::check

#pragma once

#include <cstdint>
#include <vector>

#include "scenarios/check/camera_bench.h"
#include "scenarios/check/row.h"

namespace alula::scenarios::check {

/// Where a vertical edge lies in some rows of a picture, and how wide it is.
struct EdgeRow {
  int row = 0;
  double place = 0.0;     // centroid of the grey value's derivative, px
  double variance = 0.0;  // of the same, px²
};
/// Looks in the given rows within `window` px of `around`.
std::vector<EdgeRow> FindEdge(const Frame& frame, const std::vector<double>& around, const std::vector<int>& rows,
                              int window);

/// The camera swings past an edge at a constant rate, once a frame, beside the same frames at rest. Of both pictures'
/// edges: the growth of the variance is (speed · exposure)²/12, the slant is speed · row delay, the shift of the middle
/// row is speed · offset of the stamps. Speeds come from the known motion and the geometry.
void CheckShutter(const Rig& isolated, const CameraGroup& group, const sim::SensorsConfig& claimed,
                  const std::vector<CameraGeometry>& cameras, Report& report);

/// A frame of a moving camera (the first of the group) against the mean of 64 pictures over the exposure (and 64 bands
/// of rows over the rolling): mean difference below one grey level. Nothing where the camera has neither blur nor
/// rolling shutter.
void CheckSubFrames(const Rig& isolated, const CameraGroup& group, sim::CameraConfig config,
                    const CameraGeometry& camera, Report& report);

}  // namespace alula::scenarios::check

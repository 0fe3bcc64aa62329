#pragma once

#include <vector>

#include "scenarios/check/camera_bench.h"
#include "scenarios/check/row.h"

namespace alula::scenarios::check {

/// The line variance = read² + shot · mean, in grey levels.
struct PhotonTransfer {
  double read_variance = 0.0, shot = 0.0;
  double read_variance_sigma = 0.0, shot_sigma = 0.0;
  double levels = 0.0;  // bins of one grey level that the line went through
};

/// Photon-transfer curve (Janesick 2007; EMVA 1288, section 6.6) from frames of one unmoving scene: mean and variance
/// of each pixel (of each colour) over the frames, pooled by mean. Levels at which any pixel touches 0 or 255 are left
/// out, and such whose spread is below half a level, where rounding is no noise.
PhotonTransfer MeasurePhotonTransfer(const std::vector<Frame>& frames);

/// Photon transfer of each camera of a group before a grey wall, within 5 %.
void CheckPhotonTransfer(const Rig& isolated, const sim::CameraConfig& claimed,
                         const std::vector<CameraGeometry>& cameras, Report& report);

}  // namespace alula::scenarios::check

#pragma once

#include <deque>

#include "sim/sensors/camera_config.h"

namespace alula::sim {

/// Length of an exposure and gain; their product against the nominal exposure is the picture's brightness.
struct ExposureSetting {
  base::Duration length;
  double gain = 1.0;
};

/// The controller of AutoExposureConfig; without one the setting never changes.
class ExposureControl {
 public:
  explicit ExposureControl(const CameraConfig& config);
  ExposureSetting Current() const { return current_; }
  /// A frame taken with `setting` came out with this mean (share of full scale). The frame `delay` frames on obeys.
  void See(double mean, const ExposureSetting& setting);

 private:
  ExposureSetting SettingOf(double stops) const;

  std::optional<AutoExposureConfig> config_;
  base::Duration nominal_;
  std::deque<double> underway_;  // what frames to come will obey: log2 of exposure · gain against the nominal exposure
  ExposureSetting current_;
};

}  // namespace alula::sim

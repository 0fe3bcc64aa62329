#pragma once

#include <span>
#include <vector>

#include "stack/interface/calibration.h"
#include "stack/interface/measurement.h"
#include "stack/interface/mission.h"
#include "stack/interface/plugin.h"

namespace alula::scenarios::plugin {

/// Calibration and mission as plugin.h has them, with all that they point to.
class Given {
 public:
  Given(const stack::Calibration& calibration, const stack::Mission& mission);
  Given(const Given&) = delete;
  Given& operator=(const Given&) = delete;

  const AlulaCalibration& calibration() const { return c_calibration_; }
  const AlulaMission& mission() const { return c_mission_; }

 private:
  const stack::Calibration calibration_;  // the texts are here
  const stack::Mission mission_;
  std::vector<AlulaCameraCalibration> cameras_;
  std::vector<AlulaGimbalCalibration> gimbals_;
  AlulaImuCalibration imu_{};
  AlulaBarometerCalibration barometer_{};
  AlulaPositionReferenceCalibration position_reference_{}, gnss_{};
  AlulaMagnetometerCalibration magnetometer_{};
  std::vector<AlulaGateHint> gates_;
  std::vector<AlulaVec3> waypoints_;
  AlulaCalibration c_calibration_{};
  AlulaMission c_mission_{};
};

/// Measurements as plugin.h has them; pixels are pointed to, not copied. `out` is overwritten.
void Write(std::span<const stack::Measurement> measurements, std::vector<AlulaMeasurement>& out);

}  // namespace alula::scenarios::plugin

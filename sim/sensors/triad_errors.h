#pragma once

#include "base/describe.h"
#include "base/frames.h"

namespace alula::sim {

/// What is wrong with three axes that should measure a vector in the sensor's frame (an IMU's: I). Values are those of
/// one unit; a scenario gives their spread over units as distributions ({normal: …}).
struct TriadErrors {
  base::Vec3 scale = base::Vec3::Zero();             // k: share by which an axis reads too much
  base::Vec3 misalignment = base::Vec3::Zero();      // m: rotation vector of the triad in I, rad
  base::Vec3 nonorthogonality = base::Vec3::Zero();  // l: of x in y's reading, of x in z's, of y in z's, rad
  base::Vec3 bias_per_kelvin = base::Vec3::Zero();   // b_T: in the reading's unit per K
  base::Vec3 scale_per_kelvin = base::Vec3::Zero();  // k_T: share per K
  double quantum = 0.0;                              // least step of the output, the reading's unit; 0: continuous
};
struct GyroErrors : TriadErrors {};           // rad/s
struct AccelerometerErrors : TriadErrors {};  // m/s²
/// The keys of the axes alone: scale, misalignment, nonorthogonality.
void DescribeAxes(base::Description& d, TriadErrors& c);
void Describe(base::Description& d, GyroErrors& c);
void Describe(base::Description& d, AccelerometerErrors& c);

/// What the axes read of a unit vector, ΔT (K) above the temperature of calibration:
///
///   M(ΔT) = diag(1 + k + k_T ΔT) (I + L) Exp(m)ᵀ,   L = [0 0 0; l_1 0 0; l_2 l_3 0]
///
/// A lower triangular matrix times a rotation, as Rehder, Nikolic, Schneider, Hinzmann and Siegwart 2016 ("Extending
/// kalibr") have it for gyroscopes (their accelerometer is the frame). Tedaldi, Pretto and Menegatti 2014 state the
/// inverse, from reading to truth.
base::Mat3 SensingMatrix(const TriadErrors& errors, double delta_T);

/// The nearest multiple of the quantum, ties away from zero; v itself where there is none.
base::Vec3 Quantise(const base::Vec3& v, double quantum);

}  // namespace alula::sim

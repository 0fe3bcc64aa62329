#include "sim/sensors/triad_errors.h"

#include <cmath>

namespace alula::sim {
namespace {

void DescribeTriad(base::Description& d, TriadErrors& c, const char* unit, const char* unit_per_kelvin) {
  DescribeAxes(d, c);
  d.Field("bias_per_kelvin", c.bias_per_kelvin,
          {.unit = unit_per_kelvin, .meaning = "bias per kelvin above the temperature of calibration"});
  d.Field("scale_per_kelvin", c.scale_per_kelvin,
          {.unit = "1/K", .meaning = "change of scale per kelvin", .min = -0.01, .max = 0.01});
  d.Field("quantum", c.quantum, {.unit = unit, .meaning = "least step of the output (LSB); 0: none", .min = 0});
}

}  // namespace

void DescribeAxes(base::Description& d, TriadErrors& c) {
  d.Field("scale", c.scale, {.meaning = "share by which each axis reads too much", .min = -0.5, .max = 0.5});
  d.Field("misalignment", c.misalignment,
          {.unit = "rad", .meaning = "rotation vector of the triad in the sensor's frame", .min = -0.5, .max = 0.5});
  d.Field("nonorthogonality", c.nonorthogonality,
          {.unit = "rad", .meaning = "x read by y, x read by z, y read by z", .min = -0.5, .max = 0.5});
}

void Describe(base::Description& d, GyroErrors& c) { DescribeTriad(d, c, "rad/s", "rad/s/K"); }
void Describe(base::Description& d, AccelerometerErrors& c) { DescribeTriad(d, c, "m/s^2", "m/s^2/K"); }

base::Mat3 SensingMatrix(const TriadErrors& errors, double delta_T) {
  base::Mat3 L = base::Mat3::Identity();
  L(1, 0) = errors.nonorthogonality.x();
  L(2, 0) = errors.nonorthogonality.y();
  L(2, 1) = errors.nonorthogonality.z();
  const base::Vec3 gain = base::Vec3::Ones() + errors.scale + delta_T * errors.scale_per_kelvin;
  return gain.asDiagonal() * L * base::Exp(errors.misalignment).conjugate().toRotationMatrix();
}

base::Vec3 Quantise(const base::Vec3& v, double quantum) {
  if (quantum <= 0.0) return v;
  return {quantum * std::round(v.x() / quantum), quantum * std::round(v.y() / quantum),
          quantum * std::round(v.z() / quantum)};
}

}  // namespace alula::sim

#include "sim/sensors/magnetometer.h"

#include <cmath>

namespace alula::sim {
namespace {

/// The nearest whole quantum inside ±range.
base::Vec3 Converted(const base::Vec3& v, double quantum, double range) {
  const double most = quantum > 0.0 ? quantum * std::floor(range / quantum) : range;
  return Quantise(v, quantum).cwiseMax(-most).cwiseMin(most);
}

}  // namespace

void Describe(base::Description& d, SoftIron& c) { DescribeAxes(d, c); }

void Describe(base::Description& d, MagnetometerConfig& c) {
  d.Field("rate", c.rate, {.unit = "Hz", .meaning = "output rate"});
  d.Field("orientation", c.orientation, {.unit = "rad", .meaning = "yaw, pitch, roll of its axes in the body frame"});
  d.Field("noise", c.noise, {.unit = "T", .meaning = "standard deviation of a sample, per axis", .min = 0});
  d.Field("hard_iron_sigma", c.hard_iron_sigma,
          {.unit = "T", .meaning = "standard deviation of the constant offset, per axis", .min = 0});
  d.Field("soft_iron", c.soft_iron, {.meaning = "what iron and the axes themselves make of the field's direction"});
  d.Field("per_ampere", c.per_ampere,
          {.unit = "T/A", .meaning = "field of the wires per ampere of the battery's current, body axes"});
  d.Field("quantum", c.quantum, {.unit = "T", .meaning = "least step of the output (LSB); 0: none", .min = 0});
  d.Field("range", c.range, {.unit = "T", .meaning = "saturation of each axis", .min = 1e-6});
  d.Check("quantum", [&c] { return c.quantum < c.range ? "" : "must be smaller than the range"; });
}

Magnetometer::Magnetometer(const MagnetometerConfig& config, std::uint64_t seed, const std::string& name)
    : config_(config), stream_(seed, name) {
  const base::Vec3& a = config.orientation;
  A_MB_ =
      SensingMatrix(config.soft_iron, 0.0) * base::FromYawPitchRoll(a.x(), a.y(), a.z()).conjugate().toRotationMatrix();
  base::RandomStream hard_iron(seed, name + ".hard_iron");
  hard_iron_ = config.hard_iron_sigma * hard_iron.GaussianVec3();
}

stack::MagSample Magnetometer::Sample(const base::Quat& q_WB, const base::Vec3& B_W, double current) {
  const base::Vec3 B_B = q_WB.conjugate() * B_W + current * config_.per_ampere;
  const base::Vec3 m = A_MB_ * B_B + hard_iron_ + config_.noise * stream_.GaussianVec3();
  return {Converted(m, config_.quantum, config_.range)};
}

}  // namespace alula::sim

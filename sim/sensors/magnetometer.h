#pragma once

#include <cstdint>
#include <string>

#include "base/describe.h"
#include "base/random.h"
#include "base/time.h"
#include "sim/sensors/triad_errors.h"
#include "stack/interface/measurement.h"

namespace alula::sim {

/// What iron that is magnetised by the field, and the three axes themselves, make of a vector. Nine numbers: any matrix
/// that is near enough to the identity.
struct SoftIron : TriadErrors {};
void Describe(base::Description& d, SoftIron& c);

/// Three axes on the vehicle. Defaults are of the class of a PNI RM3100 (200 cycle counts: 75 counts a microtesla, 15
/// nT of noise, ±800 µT); an iSentek IST8310 has steps of 0.3 µT. Hard iron, our choice: what a calibration leaves.
struct MagnetometerConfig {
  base::Rate rate{50, 1};
  base::Vec3 orientation = base::Vec3::Zero();  // yaw, pitch, roll of its axes M in the body, rad
  double noise = 15e-9;                         // 1σ of a sample, per axis, T
  double hard_iron_sigma = 1e-6;                // 1σ of the constant offset, drawn per axis, T
  SoftIron soft_iron{};
  base::Vec3 per_ampere = base::Vec3::Zero();  // of the battery's current, body axes, T/A
  double quantum = 13.3e-9;                    // least step of the output (LSB), T; 0: continuous
  double range = 800e-6;                       // saturation of each axis, T
};
void Describe(base::Description& d, MagnetometerConfig& c);

/// Flux density in the sensor's axes M:
///
///   m = Q[ A R_MB (R_BW B_W + κ I) + b + n ]
///
/// A: soft iron, scale, misalignment and non-orthogonality in one matrix (SensingMatrix); b: hard iron and the axes'
/// own offsets in one vector (Renaudin, Afzal and Lachapelle 2010, "Complete triaxis magnetometer calibration in the
/// magnetic domain", multiply their chain of errors out to such a pair); κ I: field of the wires, proportional to the
/// current as PX4 compensates it (CAL_MAG_COMP_TYP 2, CAL_MAGn_XCOMP, …); n: white. Q rounds to whole quanta within
/// ±range.
class Magnetometer {
 public:
  /// Streams `name` (noise) and "<name>.hard_iron".
  Magnetometer(const MagnetometerConfig& config, std::uint64_t seed, const std::string& name);
  /// `B_W`: T, world axes; `current`: of the battery, A.
  stack::MagSample Sample(const base::Quat& q_WB, const base::Vec3& B_W, double current);

 private:
  MagnetometerConfig config_;
  base::RandomStream stream_;
  base::Mat3 A_MB_;  // A R_MB
  base::Vec3 hard_iron_;
};

}  // namespace alula::sim

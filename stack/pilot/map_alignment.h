#pragma once

#include <optional>
#include <vector>

#include "base/describe.h"
#include "base/frames.h"

namespace alula::stack::pilot {

struct MapAlignmentConfig {
  double hint_sigma = 0.3;            // m, 1σ per axis of a gate's listed place (bound 0.6 m in the plane)
  double start_position_sigma = 0.1;  // m, used where the mission states none
  double start_yaw_sigma = 0.035;     // rad (2°), the same
  double huber = 1.5;                 // σ beyond which a gate's pull grows no more
};
void Describe(base::Description& d, MapAlignmentConfig& c);

/// A gate where the list has it and where it was measured.
struct AlignmentPair {
  base::Vec3 p_M;
  base::Vec3 p_O;
  double sigma = 0.05;  // m, of the measurement
};

/// X_MO (yaw and translation) from measured gates against the list, with the start pose's uncertainty as prior:
///   min ‖t/σ_t‖² + (ψ/σ_ψ)² + Σ ρ(‖p_M − (R(ψ)(p_O − c) + c + t)‖ / σ),  c the start position;
/// Gauss–Newton with Huber weights. With no pairs it is the identity.
base::Transform AlignMap(const std::vector<AlignmentPair>& pairs, const base::Vec3& start_O, double position_sigma,
                         double yaw_sigma, const MapAlignmentConfig& config);

}  // namespace alula::stack::pilot

#pragma once

#include <cstdint>

#include "scenarios/check/row.h"
#include "vehicles/quadrotor.h"

namespace alula::scenarios::check {

/// The rotors of a quadrotor on a stand that measures the vehicle's force: thrust over ω² near a floor at several
/// heights (ground effect), and in descents into the own wake (vortex ring: thrust left, fluctuation). Only what is
/// claimed is looked at. `built` stands there, `claimed` says what it should be.
void CheckRotors(const vehicles::QuadrotorConfig& built, const vehicles::QuadrotorConfig& claimed, std::uint64_t seed,
                 Report& report);

}  // namespace alula::scenarios::check

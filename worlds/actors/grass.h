#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "worlds/world.h"

namespace alula::worlds {

/// A patch of grass in tufts.
struct GrassConfig {
  base::Vec2 low{-2.0, -2.0};  // m
  base::Vec2 high{2.0, 2.0};
  int tufts = 80;                               // each a solid of its own: some hundreds a world are cheap
  double height = 0.25;                         // m, mean
  std::shared_ptr<const HeightField> ground{};  // null: z = 0
};

/// Adds one actor of tufts (two crossed cards each, with holes between the blades) that do not collide and cast no
/// shadow. Stream "world/actors/<name>".
void AddGrass(World& world, const std::string& name, const GrassConfig& config, std::uint64_t seed);

/// Speed of the air along the ground at distance r (m) from under a hovering rotorcraft at height h (m) with thrust T
/// (N): the wall jet of a round jet with the kinematic momentum flux K = T / ρ that meets a wall square,
///   u(r) = 1.32 √K / h · (r / h)^−1.10                            (Poreh, Tsuei & Cermak 1967),
/// which holds from the stagnation region's rim r_s = 0.22 h on; within, u grows from 0 as r / r_s (Beltaos &
/// Rajaratnam 1974). Never above the momentum-theory speed of the wake √(2 T / (ρ A)), A = π R² of all rotors.
double GroundJetSpeed(double thrust, double height, double distance, double wake_speed);

}  // namespace alula::worlds

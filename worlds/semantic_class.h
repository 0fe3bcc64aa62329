#pragma once

#include <cstdint>
#include <string_view>

namespace alula::worlds {

/// What a thing is, for pictures that say so. It changes nothing that moves or is seen in grey and colour; a pattern
/// that a depth camera projects does not come back from glass.
enum class SemanticClass : std::uint8_t {
  kSky,
  kGround,
  kWall,
  kGate,
  kPad,
  kTree,
  kObstacle,
  kVehicle,
  kGlass,
  kPerson,
  kCar,
  kDrone,
  kGrass
};
inline constexpr std::string_view kSemanticNames[] = {
    "sky", "ground", "wall", "gate", "pad", "tree", "obstacle", "vehicle", "glass", "person", "car", "drone", "grass"};

constexpr std::string_view NameOf(SemanticClass c) { return kSemanticNames[static_cast<std::size_t>(c)]; }

}  // namespace alula::worlds

#pragma once

#include <cstdint>
#include <string_view>

namespace alula::worlds {

/// What a thing is, for pictures that say so. It changes nothing that moves or is seen in grey and colour.
enum class SemanticClass : std::uint8_t { kSky, kGround, kWall, kGate, kPad, kTree, kObstacle, kVehicle };
inline constexpr std::string_view kSemanticNames[] = {"sky", "ground", "wall",     "gate",
                                                      "pad", "tree",   "obstacle", "vehicle"};

constexpr std::string_view NameOf(SemanticClass c) { return kSemanticNames[static_cast<std::size_t>(c)]; }

}  // namespace alula::worlds

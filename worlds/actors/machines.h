#pragma once

#include <cstdint>
#include <string>

#include "worlds/course.h"
#include "worlds/world.h"

namespace alula::worlds {

/// Adds a car (4.2 m long with the default wheelbase): paint and build from the stream "world/actors/<name>/look".
/// Throws base::InputError where its path turns tighter than `drive.turn_radius` allows.
void AddCar(World& world, const std::string& name, const Drive& drive, std::uint64_t seed);

/// Adds a quadrotor of `span` m from rotor axis to rotor axis across; its rotors are discs.
void AddDrone(World& world, const std::string& name, const Fly& fly, double span, std::uint64_t seed);

/// Adds a gate whose frame hangs on a hinge at its left post and swings like a door; its entry in `world.gates` names
/// the actor. Parts of post and foot are objects "<name>/post", "<name>/foot"; the frame is the actor "<name>/frame".
struct DoorSwing {
  double amplitude = 0.3;  // rad
  double period = 4.0;     // s
  double phase = 0.0;      // periods
};
void AddSwingingGate(World& world, int material, const std::string& name, const GatePlan& plan, const DoorSwing& swing);

}  // namespace alula::worlds

#pragma once

#include <string>

#include "base/random.h"
#include "worlds/world.h"

namespace alula::worlds {

// What the wind hangs on a wire. X_WL: the place on the wire, x along it, z up; `radius` of the wire. All touch it.

struct HungLooks {
  int kite = 0, spar = 0, balloon = 0, bag = 0, bark = 0, leaves = 0, string = 0;
};
HungLooks AddHungLooks(World& world, std::uint64_t seed);

void HangKite(World& world, const HungLooks& looks, const std::string& name, const base::Transform& X_WL, double radius,
              base::RandomStream& random);
void HangBalloon(World& world, const HungLooks& looks, const std::string& name, const base::Transform& X_WL,
                 double radius, base::RandomStream& random);
void HangBag(World& world, const HungLooks& looks, const std::string& name, const base::Transform& X_WL, double radius,
             base::RandomStream& random);
void HangBranch(World& world, const HungLooks& looks, const std::string& name, const base::Transform& X_WL,
                double radius, base::RandomStream& random);

}  // namespace alula::worlds

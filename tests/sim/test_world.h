#pragma once

#include "vehicles/vehicle.h"
#include "worlds/world.h"

namespace alula::sim::testing {

/// A ground of 20 m × 20 m with its surface at z = 0, and a crate of 1 m whose near face is at x = 3 m.
inline worlds::World GroundAndCrate() {
  worlds::World world;
  world.name = "test";
  world.materials.emplace_back();
  world.objects.push_back(
      {.name = "ground", .shape = geometry::Box{{10, 10, 0.5}}, .X_WO = {{1, 0, 0, 0}, {0, 0, -0.5}}});
  world.objects.push_back(
      {.name = "crate", .shape = geometry::Box{{0.5, 0.5, 0.5}}, .X_WO = {{1, 0, 0, 0}, {3.5, 0, 0.5}}});
  world.pad_object = "ground";
  world.pad_radius = 1.0;
  return world;
}

/// A plate on four legs: 1 kg, 0.2 m × 0.2 m × 0.04 m about the origin, legs of 6 mm radius down to 0.1 m below it.
inline vehicles::VehicleBody PlateOnLegs() {
  vehicles::VehicleBody body;
  body.mass = 1.0;
  body.inertia = base::Vec3(4e-3, 5e-3, 8e-3).asDiagonal();
  vehicles::Part plate;
  plate.name = "plate";
  plate.shape = geometry::Box{{0.1, 0.1, 0.02}};
  body.parts.push_back(plate);
  for (int i = 0; i < 4; ++i) {
    vehicles::Part leg;
    leg.name = "leg" + std::to_string(i);
    leg.shape = geometry::Cylinder{0.006, 0.04};
    leg.X_BP.p = {(i & 1) ? 0.08 : -0.08, (i & 2) ? 0.08 : -0.08, -0.06};
    leg.hull = false;
    leg.may_touch = true;
    body.parts.push_back(leg);
  }
  body.standing_height = 0.1;
  body.hull_radius = 0.15;
  body.hull_half_extents = {0.1, 0.1, 0.02};
  return body;
}

inline vehicles::BodyState At(const base::Vec3& p) {
  return {{base::Quat::Identity(), p}, base::Vec3::Zero(), base::Vec3::Zero()};
}

}  // namespace alula::sim::testing

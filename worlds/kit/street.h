#pragma once

#include <string>

#include "base/random.h"
#include "worlds/kit/surface.h"
#include "worlds/world.h"

namespace alula::worlds {

// What people put out of doors. All stand on `X_W…`, the pose of their foot (z up), and add objects "<name>/…".

/// A street lamp: mast, arm along x, head; it shines where `lit`.
struct StreetLampConfig {
  double height = 5.5;      // m
  double arm = 0.9;         // m
  double intensity = 55.0;  // light at 1 m
  double range = 26.0;      // m
};
void AddStreetLamp(World& world, int metal, const std::string& name, const base::Transform& X_WL,
                   const StreetLampConfig& config, bool lit);

/// A parked car, 4.3 m × 1.75 m × 1.45 m, nose along x.
struct CarLooks {
  int paint = 0, glass = 0, tyre = 0;
};
CarLooks AddCarLooks(World& world, const std::string& name, const Eigen::Vector3f& paint);
void AddCar(World& world, const CarLooks& looks, const std::string& name, const base::Transform& X_WC);

/// A post-and-rail fence along a line of points on the ground.
void AddFence(World& world, int wood, const std::string& name, const std::vector<base::Vec3>& line, double height);

/// A bench of stone: a slab on two blocks, `length` along x, 0.45 m high.
void AddStoneBench(World& world, int stone, const std::string& name, const base::Transform& X_WB, double length);

/// A free-standing wall with plinth, coping and relief panels on both faces, `length` along x.
void AddCarvedWall(World& world, int stone, int carving, const std::string& name, const base::Transform& X_WV,
                   double length, double height, base::RandomStream& random);

/// A standing figure of stone on a plinth, `height` m with it, looking along x.
void AddSculpture(World& world, int stone, const std::string& name, const base::Transform& X_WS, double height);

}  // namespace alula::worlds

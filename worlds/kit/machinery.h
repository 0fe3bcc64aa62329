#pragma once

#include <string>
#include <vector>

#include "base/random.h"
#include "worlds/world.h"

namespace alula::worlds {

/// Indices of materials of plants.
struct MachineLooks {
  int casing = 0, green = 0, steel = 0, rust = 0, pipe = 0, lagging = 0, panel = 0, dark = 0, hazard = 0, drum = 0,
      crate = 0, white = 0;
};
MachineLooks AddMachineMaterials(World& world, int texture_size, std::uint64_t seed);

// Things whose foot stands at X_WT; x is along them. Parts are named "<name>/<part>".

/// A turbine or pump set on a bed of concrete, `length` along x: casing, bearings, motor, flanges, hand wheel.
void AddMachine(World& world, const MachineLooks& looks, const std::string& name, const base::Transform& X_WT,
                double length, base::RandomStream& random);
/// An upright tank on four legs with domed ends, a manhole and a pipe out of its foot. Fits a circle of 1.2 · radius.
void AddTank(World& world, const MachineLooks& looks, const std::string& name, const base::Transform& X_WT,
             double radius, double height, base::RandomStream& random);
/// Switch cabinets side by side; their back is at x = 0, they look along x.
void AddCabinets(World& world, const MachineLooks& looks, const std::string& name, const base::Transform& X_WT,
                 int count, base::RandomStream& random);
void AddDrum(World& world, const MachineLooks& looks, const std::string& name, const base::Transform& X_WT,
             base::RandomStream& random);

/// A pipe of straight pieces from point to point with balls in its bends, and flanges every 2.5 m. World axes.
void AddPipe(World& world, const std::string& name, const std::vector<base::Vec3>& points, double radius, int material,
             int flange);
/// A beam of I section from a to b: two flanges and a web; its web stands upright.
void AddGirder(World& world, const std::string& name, const base::Vec3& a, const base::Vec3& b, double height,
               double width, int material);
/// A grating of bars: `size` m along x and y, 3 cm thick, its upper side at z = 0, one mesh.
void AddGrating(World& world, const std::string& name, const base::Transform& X_WT, const base::Vec2& size,
                int material);
/// Posts and two rails along x, `length` long from its middle.
void AddRailing(World& world, const std::string& name, const base::Transform& X_WT, double length, int material);

}  // namespace alula::worlds

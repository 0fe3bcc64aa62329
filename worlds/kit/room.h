#pragma once

#include <string>
#include <vector>

#include "worlds/kit/surface.h"

namespace alula::worlds {

/// A hole in a wall, in its own axes: x along it, z up from its foot, m.
struct Opening {
  double x_low = 0.0;
  double x_high = 1.0;
  double z_low = 0.0;  // 0: a door
  double z_high = 2.1;
};

/// A wall along x of its frame L from −length/2 to length/2, its middle plane at y = 0, its foot at z = 0. The openings
/// must not overlap along x and must lie within it. It casts no shadow (Light::sun stands for lamps inside). Parts are
/// named "<name>/<part>/<i>". Throws base::FaultError for openings that do not fit.
struct WallConfig {
  double length = 4.0;
  double height = 2.7;
  double thickness = 0.12;
  std::vector<Opening> openings{};
};
void AddWall(World& world, const std::string& name, const WallConfig& config, const base::Transform& X_WL,
             const Surface& surface, base::RandomStream& random);

/// Floor, ceiling and the four walls around a room of inner size `size`, its floor's middle at the origin, upper side
/// at z = 0. Openings of the walls in the order east (+x), north (+y), west, south; x of an opening runs to the left as
/// seen from inside. Nothing of it casts a shadow.
struct ShellConfig {
  base::Vec3 size{8.0, 6.0, 3.0};
  double thickness = 0.25;
  std::vector<Opening> east{}, north{}, west{}, south{};
};
void AddShell(World& world, const ShellConfig& config, const Surface& floor, const Surface& wall,
              const Surface& ceiling, base::RandomStream& random);

/// A thin box for a picture, a lamp's panel, a strip of tape: it lies with its middle at X_WO, z through it.
std::size_t AddBox(World& world, const std::string& name, const base::Vec3& size, const base::Transform& X_WO,
                   int material, double texture_scale, SemanticClass semantic = SemanticClass::kObstacle);

/// Pose of a thing on the ground.
base::Transform Standing(double x, double y, double z, double yaw = 0.0);

/// Frame of a doorway in a wall as in AddWall: two jambs and a head beside the clear opening, `depth` through the wall.
void AddDoorFrame(World& world, const std::string& name, const Opening& clear, double jamb, double depth,
                  const base::Transform& X_WL, int material);

}  // namespace alula::worlds

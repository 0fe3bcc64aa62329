#pragma once

#include <cstdint>
#include <string>

#include "base/random.h"
#include "worlds/course.h"
#include "worlds/placement.h"
#include "worlds/world.h"

namespace alula::worlds {

/// Indices of materials by what they are for.
struct Looks {
  std::vector<int> ground;
  std::vector<int> wall;
  std::vector<int> gate;  // one each
  std::vector<int> foliage;
  int bark = 0;
  int wood = 0;
  int stone = 0;
  int pad = 0;
};

/// Makes all materials of a courtyard and adds them to the world; walls and ground have `texture_size` texels a side.
Looks AddCourtyardMaterials(World& world, int texture_size, std::uint64_t seed);

/// Adds one object; gives its index.
std::size_t AddObject(World& world, std::string name, geometry::Shape shape, const base::Transform& X_WO, int material,
                      double texture_scale, SemanticClass semantic = SemanticClass::kObstacle);

/// Things that stand on the ground (z = 0) at a footprint; they stay inside its circle. Sizes and looks come from
/// `random`. Parts are named "<name>/<part>".
void AddTree(World& world, const Looks& looks, const std::string& name, const Footprint& at,
             base::RandomStream& random);
/// A tree whose crown is of cards that show sprays of leaves (a material with holes) from both sides.
void AddLeafyTree(World& world, int bark, int leaves, const std::string& name, const Footprint& at,
                  base::RandomStream& random);
void AddConifer(World& world, const Looks& looks, const std::string& name, const Footprint& at,
                base::RandomStream& random);
void AddCrates(World& world, const Looks& looks, const std::string& name, const Footprint& at, int stacked,
               base::RandomStream& random);
void AddPole(World& world, const Looks& looks, const std::string& name, const Footprint& at,
             base::RandomStream& random);
/// `yaw`: where a person who sits on it looks.
void AddBench(World& world, const Looks& looks, const std::string& name, const Footprint& at, double yaw);

/// Frame, post and foot of a gate, and its entry in `world.gates`.
void AddGate(World& world, int material, const std::string& name, const GatePlan& plan);

/// A round pad named "pad" whose surface is kPadHeight above the ground.
inline constexpr double kPadHeight = 0.04;  // m
void AddPad(World& world, int material, const base::Vec2& centre, double radius);

}  // namespace alula::worlds

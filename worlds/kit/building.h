#pragma once

#include <string>

#include "base/random.h"
#include "worlds/kit/surface.h"
#include "worlds/world.h"

namespace alula::worlds {

/// Materials of a masonry building.
struct BuildingLooks {
  Surface wall;
  int roof = 0, frame = 0, glass = 0, door = 0, stone = 0;
};
BuildingLooks AddBuildingLooks(World& world, Pattern wall, const Palette& colours, const std::string& name,
                               std::uint64_t seed);

/// A house with a gable roof along x, windows, a door in the face that looks along −y, and a chimney. X_WH: its foot's
/// middle, z up; the walls reach 0.8 m below it, for slopes.
struct HouseConfig {
  base::Vec3 size{9.0, 6.5, 3.2};  // m, to the eaves
  double roof = 2.3;               // m, above them
};
void AddHouse(World& world, const BuildingLooks& looks, const std::string& name, const base::Transform& X_WH,
              const HouseConfig& config, base::RandomStream& random);

/// A building of storeys with rows of windows in all its faces and a flat roof with a parapet.
struct BlockConfig {
  double length = 18.0, width = 11.0;  // m, along x and y
  int storeys = 4;
  double storey = 3.1;  // m
};
void AddBlock(World& world, const BuildingLooks& looks, const std::string& name, const base::Transform& X_WB,
              const BlockConfig& config, base::RandomStream& random);

}  // namespace alula::worlds

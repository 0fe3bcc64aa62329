#pragma once

#include <string>

#include "base/random.h"
#include "worlds/world.h"

namespace alula::worlds {

/// Indices of materials of offices.
struct OfficeLooks {
  int wood = 0, steel = 0, dark = 0, white = 0, fabric = 0, screen = 0, leaves = 0, pot = 0, paper = 0, door = 0;
  int glass = 0;  // satin: it is seen, but has nothing on it
  int pad = 0, poster = 0;
};
OfficeLooks AddOfficeMaterials(World& world, int texture_size, std::uint64_t seed);

// Things that stand with their foot at X_WT; x is the way they look, their sizes are real ones. Parts are named
// "<name>/<part>".

/// A desk 1.6 m × 0.8 m with a screen, a keyboard, papers and a drawer unit; whoever sits at it looks along x.
void AddDesk(World& world, const OfficeLooks& looks, const std::string& name, const base::Transform& X_WT,
             base::RandomStream& random);
/// A swivel chair on five feet.
void AddOfficeChair(World& world, const OfficeLooks& looks, const std::string& name, const base::Transform& X_WT);
/// Shelves full of folders; its back is at x = 0 and it looks along x.
void AddShelf(World& world, const OfficeLooks& looks, const std::string& name, const base::Transform& X_WT,
              const base::Vec3& size, base::RandomStream& random);
/// A cupboard with two doors; its back is at x = 0.
void AddCupboard(World& world, const OfficeLooks& looks, const std::string& name, const base::Transform& X_WT,
                 const base::Vec3& size);
void AddBin(World& world, const OfficeLooks& looks, const std::string& name, const base::Transform& X_WT);
void AddPottedPlant(World& world, const OfficeLooks& looks, const std::string& name, const base::Transform& X_WT,
                    base::RandomStream& random);
/// A door leaf of this width in the plane y = 0 from its hinge at x = 0 along x, with handles; of glass: in a frame.
void AddDoorLeaf(World& world, const OfficeLooks& looks, const std::string& name, const base::Transform& X_WH,
                 double width, double height, bool glass);

}  // namespace alula::worlds

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/random.h"
#include "worlds/textures.h"
#include "worlds/world.h"

namespace alula::worlds {

/// A look that covers large areas without showing a period: materials that are equal along the rims of a cell and
/// differ within (textures.h: MakeTextureVariants). A cell is one period; texture coordinates are 0 in its middle.
struct Surface {
  std::vector<int> variants;  // materials
  double period = 4.0;        // m
};

struct SurfaceConfig {
  Pattern pattern = Pattern::kConcrete;
  Palette palette{};
  double period = 4.0;  // m that one texture covers
  int size = 512;       // texels a side
  int variants = 3;
  double contrast = kFullContrast;
  float infrared = 1.0F;  // factor on the albedo as an infrared camera sees it
};
/// Adds the materials "<name>/<i>" to the world.
Surface AddSurface(World& world, const std::string& name, const SurfaceConfig& config, std::uint64_t seed);

/// A single material named `name` with one texture; gives its index. For small things.
int AddMaterial(World& world, const std::string& name, const SurfaceConfig& config, std::uint64_t seed);
/// A material of plain colour.
int AddPlainMaterial(World& world, const std::string& name, const Eigen::Vector3f& colour);

/// A box of full size `size`, its faces cut into cells of the surface along the two longest sides, so that each shows
/// another variant: walls, floors, slabs. Parts are named "<name>/<i>". X_WO: pose of the box's centre.
void AddTiledBox(World& world, const std::string& name, const base::Vec3& size, const base::Transform& X_WO,
                 const Surface& surface, SemanticClass semantic, base::RandomStream& random);

}  // namespace alula::worlds

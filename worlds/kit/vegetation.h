#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/random.h"
#include "worlds/kit/foliage_texture.h"
#include "worlds/world.h"

namespace alula::worlds {

// Plants. Wood and the heart of a crown are solid: what stands in the way of a vehicle. The foliage about them is cards
// with holes (a material with alpha), seen but not hit: a ray goes through a hole of the picture and would be stopped
// by the card in Bullet, so that the two would disagree. An object collides exactly when its material has no holes
// (docs/decisions/0020).

enum class TreeKind { kBroadleaf, kConifer };

/// Materials of a kind of plant.
struct PlantLooks {
  int bark = 0;
  int leaves = 0;  // has holes
  int dense = 0;   // the same foliage without holes, for the heart of a crown
};
/// Adds "<name>/bark" and "<name>/leaves", in colours drawn about those of the kind.
PlantLooks AddTreeLooks(World& world, TreeKind kind, const std::string& name, std::uint64_t seed);
PlantLooks AddShrubLooks(World& world, const std::string& name, std::uint64_t seed);
/// A material of foliage alone.
int AddFoliageMaterial(World& world, const std::string& name, const FoliageConfig& config, std::uint64_t seed);

/// One tree's shape; many trees of a wood share a few, and look alike.
struct TreeModel {
  double height = 0.0;        // m
  double trunk_radius = 0.0;  // m
  double bare = 0.0;          // height where the crown begins, m
  double reach = 0.0;         // radius of the crown, m
  std::shared_ptr<const geometry::Mesh> boughs;
  std::shared_ptr<const geometry::Mesh> heart;  // where a crown is too dense to see or fly through
  std::shared_ptr<const geometry::Mesh> crown;  // cards
};
TreeModel MakeTreeModel(TreeKind kind, double height, base::RandomStream& random);

/// Where something stands on the ground: its foot, the way it faces, and how it leans.
struct Stand {
  base::Vec3 foot = base::Vec3::Zero();
  double yaw = 0.0;   // rad
  double lean = 0.0;  // rad, towards its own x axis
};
/// Trunk (solids: root flare, stem, its taper), boughs, and the crown's heart and cards: objects "<name>/…" of class
/// kTree.
void PlantTree(World& world, const TreeModel& model, const PlantLooks& looks, const std::string& name, const Stand& at);

/// A bush of stems and sprays, `reach` wide from its middle and `height` high.
struct ShrubModel {
  double reach = 0.0;
  double height = 0.0;
  std::shared_ptr<const geometry::Mesh> stems;
  std::shared_ptr<const geometry::Mesh> leaves;
};
ShrubModel MakeShrubModel(double reach, double height, base::RandomStream& random);
void PlantShrub(World& world, const ShrubModel& model, const PlantLooks& looks, const std::string& name,
                const Stand& at);

/// Two crossed upright cards of this size about the foot, for tufts, flowers and far trees; appended to a mesh that
/// holds many. They are lit as the ground is.
void AddCrossedCards(geometry::Mesh& mesh, const base::Vec3& foot, double width, double height, double yaw);

/// Adds a mesh of cards as an object that is seen and not hit.
void AddCards(World& world, const std::string& name, std::shared_ptr<const geometry::Mesh> mesh, int material,
              SemanticClass semantic);

}  // namespace alula::worlds

#include "base/error.h"
#include "render/camera_renderer.h"
#include "worlds/actors/actor_simulation.h"

namespace alula::render {

std::vector<Mover> MoversOf(const worlds::World& world) {
  std::vector<Mover> movers;
  for (const worlds::Actor& actor : world.actors) {
    for (const worlds::ActorLink& link : actor.links) {
      const std::string name = actor.name + "/" + link.name;
      if (link.material < 0 || static_cast<std::size_t>(link.material) >= world.materials.size()) {
        throw base::FaultError("render", "link \"" + name + "\" has material " + std::to_string(link.material) +
                                             " of " + std::to_string(world.materials.size()));
      }
      movers.push_back({.name = name,
                        .shape = link.shape,
                        .material = world.materials[static_cast<std::size_t>(link.material)],
                        .semantic = actor.semantic,
                        .of_vehicle = false,
                        .casts_shadow = link.casts_shadow,
                        .texture_scale = link.texture_scale});
    }
  }
  return movers;
}

std::unique_ptr<CameraRenderer> MakeRendererAtStart(std::string_view maker, const worlds::World& world,
                                                    std::uint64_t seed) {
  auto renderer = MakeRenderer(maker, world, MoversOf(world));
  if (!world.actors.empty()) renderer->PlaceMovers(worlds::ActorSimulation(world, seed).LinkPoses({0}));
  return renderer;
}

}  // namespace alula::render

#include "render/internal/surface_classes.h"

namespace alula::render::internal {

std::vector<worlds::SemanticClass> ClassesOf(const worlds::World& world, std::span<const Mover> movers) {
  std::vector<worlds::SemanticClass> classes{worlds::SemanticClass::kSky};
  for (const worlds::Object& object : world.objects) classes.push_back(object.semantic);
  for (const Mover& mover : movers) classes.push_back(mover.semantic);
  return classes;
}

void Resize(const View& view, SurfacePicture& out) {
  out.width = view.intrinsics.width;
  out.height = view.intrinsics.height;
  const std::size_t pixels = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
  out.instances.resize(pixels);
  out.classes.resize(pixels);
  out.normals.resize(pixels);
}

}  // namespace alula::render::internal

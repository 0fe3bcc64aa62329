#pragma once

#include <span>
#include <vector>

#include "render/camera_renderer.h"

namespace alula::render::internal {

/// Classes by instance: the sky's, the world's objects', the movers'.
std::vector<worlds::SemanticClass> ClassesOf(const worlds::World& world, std::span<const Mover> movers);

/// Gives the picture its size.
void Resize(const View& view, SurfacePicture& out);

}  // namespace alula::render::internal

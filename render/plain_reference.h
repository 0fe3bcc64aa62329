#pragma once

#include <memory>

#include "render/camera_renderer.h"

namespace alula::render {

/// The yardstick of the rendering benchmark: OSMesa draws all triangles of the world, textured (trilinear) and lit, but
/// without culling, levels of detail or shadows. Throws base::InputError where OSMesa is not available.
std::unique_ptr<CameraRenderer> MakePlainReference(const worlds::World& world);

}  // namespace alula::render

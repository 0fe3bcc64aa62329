#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/internal/projection.h"
#include "render/internal/scene_geometry.h"

namespace alula::render::internal {

/// Numbers of the batches that may be seen (all that have triangles where `frustum` is null), nearest first.
std::vector<std::uint32_t> VisibleOrder(std::span<const Batch> batches, const Frustum* frustum,
                                        const base::Vec3& eye_W);

}  // namespace alula::render::internal

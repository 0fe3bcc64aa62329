#pragma once

#include <span>
#include <vector>

#include "render/internal/gl_functions.h"
#include "render/internal/projection.h"
#include "render/internal/scene_geometry.h"

namespace alula::render::internal {

/// Index ranges of one material that follow each other in drawing order: one glMultiDrawElements.
struct DrawRun {
  int material = 0;
  bool holes = false;
  std::vector<GLsizei> counts;
  std::vector<const void*> offsets;  // bytes into the index buffer
};

/// The batches that may be seen (all of them where `frustum` is null), nearest first, each at its level for `eye` and
/// `focal` (LevelFor). With `ignore_materials` those without holes make one run (passes without textures).
std::vector<DrawRun> NearestFirst(std::span<const Batch> batches, const Frustum* frustum, const base::Vec3& eye,
                                  double focal, bool ignore_materials);

/// All batches that cast shadows in their own order, at their full level.
std::vector<DrawRun> CasterRuns(std::span<const Batch> batches, bool ignore_materials);

/// Those of the runs that have holes, or have none.
std::vector<DrawRun> Those(std::vector<DrawRun> runs, bool holes);

}  // namespace alula::render::internal

#include "render/internal/draw_list.h"

#include <cstdint>

#include "render/internal/visible_order.h"

namespace alula::render::internal {
namespace {

/// `level_of`: the level that a batch is drawn at.
template <typename LevelOf>
std::vector<DrawRun> Runs(std::span<const Batch> batches, std::span<const std::uint32_t> order, bool ignore_materials,
                          const LevelOf& level_of) {
  std::vector<DrawRun> runs;
  for (const std::uint32_t i : order) {
    const Batch& batch = batches[i];
    const Level& level = level_of(batch);
    const bool together = !runs.empty() && runs.back().holes == batch.holes &&
                          ((ignore_materials && !batch.holes) || runs.back().material == batch.material);
    if (!together) {
      runs.push_back({batch.material, batch.holes, {}, {}});
    }
    runs.back().counts.push_back(static_cast<GLsizei>(level.index_count));
    runs.back().offsets.push_back(
        reinterpret_cast<const void*>(std::uintptr_t{level.first_index} * sizeof(std::uint32_t)));
  }
  return runs;
}

}  // namespace

std::vector<DrawRun> NearestFirst(std::span<const Batch> batches, const Frustum* frustum, const base::Vec3& eye,
                                  double focal, bool ignore_materials) {
  const Eigen::Vector3f at = eye.cast<float>();
  return Runs(batches, VisibleOrder(batches, frustum, eye), ignore_materials,
              [&](const Batch& batch) -> const Level& { return LevelFor(batch, at, focal); });
}

std::vector<DrawRun> CasterRuns(std::span<const Batch> batches, bool ignore_materials) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < batches.size(); ++i) {
    if (batches[i].casts_shadow && batches[i].levels[0].index_count > 0) order.push_back(i);
  }
  return Runs(batches, order, ignore_materials, [](const Batch& batch) -> const Level& { return batch.levels[0]; });
}

std::vector<DrawRun> Those(std::vector<DrawRun> runs, bool holes) {
  std::erase_if(runs, [holes](const DrawRun& run) { return run.holes != holes; });
  return runs;
}

}  // namespace alula::render::internal

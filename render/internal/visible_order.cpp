#include "render/internal/visible_order.h"

#include <algorithm>
#include <utility>

namespace alula::render::internal {
namespace {

/// Mean of the distances to the nearest point of the box and to its farthest corner: the ground and long walls, which
/// begin at the eye but lie behind most else, are drawn late.
float MiddleDistance(const Batch& batch, const Eigen::Vector3f& eye) {
  const Eigen::Vector3f nearest = eye.cwiseMax(batch.low).cwiseMin(batch.high);
  const Eigen::Vector3f reach = (eye - batch.low).cwiseAbs().cwiseMax((eye - batch.high).cwiseAbs());
  return 0.5F * ((eye - nearest).norm() + reach.norm());
}

}  // namespace

std::vector<std::uint32_t> VisibleOrder(std::span<const Batch> batches, const Frustum* frustum,
                                        const base::Vec3& eye_W) {
  const Eigen::Vector3f eye = eye_W.cast<float>();
  std::vector<std::pair<float, std::uint32_t>> seen;  // distance, batch; the number breaks ties
  for (std::uint32_t i = 0; i < batches.size(); ++i) {
    if (batches[i].levels[0].index_count == 0) continue;
    if (frustum != nullptr && !MayBeVisible(*frustum, batches[i].low, batches[i].high)) continue;
    seen.emplace_back(MiddleDistance(batches[i], eye), i);
  }
  std::sort(seen.begin(), seen.end());
  std::vector<std::uint32_t> order;
  order.reserve(seen.size());
  for (const auto& [distance, i] : seen) order.push_back(i);
  return order;
}

}  // namespace alula::render::internal

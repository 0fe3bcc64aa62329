#include "stack/mapping/internal/frame_evidence.h"

#include <algorithm>
#include <cmath>

#include "stack/mapping/internal/ray_walk.h"

namespace alula::stack::mapping::internal {

namespace {

constexpr int kPlainStride = 2;  // plain pixels looked at, by row and column; at 2.5 m they are 3 cm apart

}  // namespace

FrameEvidence::FrameEvidence(const GridShape& shape)
    : shape_(shape),
      end_stamp_(shape.count()),
      kept_stamp_(shape.count()),
      hit_stamp_(shape.count()),
      hit_slot_(shape.count()) {}

double FrameEvidence::Sharpness(const OccupancyMapConfig& config, const DepthMap& depth, double z) {
  return std::min(1.0, config.cell / (2.0 * depth.Sigma(z, config.disparity_sigma)));
}

void FrameEvidence::Collect(const OccupancyMapConfig& config, const DepthMap& depth, const base::Transform& X_OC) {
  ++frame_;
  hits_.clear();
  free_ends_.clear();
  plain_ends_.clear();
  crossed_.clear();
  doubted_.clear();
  const base::Mat3 R_OC = X_OC.R();
  const base::Vec3 step_u = R_OC.col(0) / depth.fx;
  for (int v = 0; v < depth.height; ++v) {
    const base::Vec3 row_start = R_OC * depth.Ray(0, v);
    for (int u = 0; u < depth.width; ++u) {
      const double z = depth.At(u, v);
      if (z > 0.0) AddPixel(config, depth, z, row_start + u * step_u, X_OC.p);
    }
  }
  AddPlainPixels(config, depth, X_OC);
  DropThinHits(config, depth);
  GuardHits(config, depth, X_OC.p);
  CrossCells(X_OC.p, free_ends_, crossed_);
  CrossCells(X_OC.p, plain_ends_, doubted_);
}

void FrameEvidence::AddPixel(const OccupancyMapConfig& config, const DepthMap& depth, double z, const base::Vec3& ray_O,
                             const base::Vec3& p_OC) {
  if (z <= config.max_range) {
    const base::Vec3 p_O = p_OC + z * ray_O;
    const auto [i, j, k] = shape_.CellOf(p_O);
    if (shape_.Contains(i, j, k)) {
      const std::size_t cell = shape_.Index(i, j, k);
      if (hit_stamp_[cell] != frame_) {
        hit_stamp_[cell] = frame_;
        hit_slot_[cell] = static_cast<std::uint32_t>(hits_.size());
        hits_.push_back({cell, z, 0, p_O});
      }
      ++hits_[hit_slot_[cell]].pixels;
    }
  }
  // Free up to where a surface this far could begin; +inf and far depths are cut at the range limit.
  double free_to = config.max_range;
  if (std::isfinite(z)) {
    const double margin = config.free_sigmas * depth.Sigma(z, config.disparity_sigma);
    free_to = std::min(free_to, std::max(z - margin, config.free_share_min * z));
  }
  AddRay(p_OC, p_OC + free_to * ray_O, free_ends_);
}

void FrameEvidence::AddPlainPixels(const OccupancyMapConfig& config, const DepthMap& depth,
                                   const base::Transform& X_OC) {
  const base::Mat3 R_OC = X_OC.R();
  for (int v = 0; v < depth.height; v += kPlainStride) {
    for (int u = 0; u < depth.width; u += kPlainStride) {
      if (depth.At(u, v) != DepthMap::kPlain) continue;
      AddRay(X_OC.p, X_OC.p + config.doubt_range * (R_OC * depth.Ray(u, v)), plain_ends_);
    }
  }
}

/// Notes the ray's end unless a ray to the same cell is to be walked already.
void FrameEvidence::AddRay(const base::Vec3& from, const base::Vec3& to, std::vector<base::Vec3>& ends) {
  base::Vec3 from_O = from;
  base::Vec3 to_O = to;
  if (!ClipToGrid(shape_, from_O, to_O)) return;
  const auto [i, j, k] = shape_.CellOf(to_O);
  const std::size_t cell = shape_.Index(i, j, k);
  if (end_stamp_[cell] == frame_) return;
  end_stamp_[cell] = frame_;
  ends.push_back(to_O);
}

void FrameEvidence::DropThinHits(const OccupancyMapConfig& config, const DepthMap& depth) {
  const auto thin = [&](const Hit& hit) {
    const double facing = depth.fx * depth.fy * std::pow(config.cell / hit.depth, 2);  // pixels of a facing cell
    return hit.pixels < config.min_hit_share * Sharpness(config, depth, hit.depth) * facing;
  };
  hits_.erase(std::remove_if(hits_.begin(), hits_.end(), thin), hits_.end());
}

void FrameEvidence::GuardHits(const OccupancyMapConfig& config, const DepthMap& depth, const base::Vec3& p_OC) {
  for (const Hit& hit : hits_) {
    const base::Vec3 ray_O = (hit.p_O - p_OC) / hit.depth;
    const double half = std::max(config.cell, config.guard_sigmas * depth.Sigma(hit.depth, config.disparity_sigma));
    base::Vec3 from_O = p_OC + std::max(0.0, hit.depth - half) * ray_O;
    base::Vec3 to_O = p_OC + (hit.depth + half) * ray_O;
    kept_stamp_[hit.cell] = frame_;
    if (!ClipToGrid(shape_, from_O, to_O)) continue;
    WalkRay(shape_, from_O, to_O, [this](std::size_t cell) { kept_stamp_[cell] = frame_; });
  }
}

void FrameEvidence::CrossCells(const base::Vec3& p_OC, const std::vector<base::Vec3>& ends,
                               std::vector<std::size_t>& out) {
  for (const base::Vec3& end_O : ends) {
    base::Vec3 from_O = p_OC;
    base::Vec3 to_O = end_O;
    if (!ClipToGrid(shape_, from_O, to_O)) continue;
    WalkRay(shape_, from_O, to_O, [this, &out](std::size_t cell) {
      if (kept_stamp_[cell] == frame_) return;
      kept_stamp_[cell] = frame_;
      out.push_back(cell);
    });
  }
}

}  // namespace alula::stack::mapping::internal

#include "stack/features/stereo_tracker.h"

#include <algorithm>
#include <utility>

#include "stack/features/internal/corner_detector.h"
#include "stack/features/internal/pyramid.h"
#include "stack/features/internal/stereo_matcher.h"
#include "stack/features/keypoint_depth.h"

namespace alula::stack::features {

using base::Transform;
using base::Vec2;
using base::Vec3;

void Describe(base::Description& d, StereoTrackerConfig& c) {
  d.Field("cell", c.cell, {.unit = "px", .meaning = "side of a grid cell; one corner a cell", .min = 8, .max = 400});
  d.Field("max_tracks", c.max_tracks, {.meaning = "corners followed at once", .min = 8, .max = 2000});
  d.Field("fast_threshold", c.fast_threshold, {.meaning = "grey levels of FAST", .min = 1, .max = 100});
  d.Field("min_corner_score", c.min_corner_score,
          {.meaning = "smaller eigenvalue of the mean gradient matrix, (grey level/px)^2", .min = 0});
  d.Field("window", c.window, {.unit = "px", .meaning = "side of the KLT patch, odd", .min = 5, .max = 41});
  d.Field("levels", c.levels, {.meaning = "pyramid levels above the image", .min = 1, .max = 6});
  d.Field("iterations", c.iterations, {.meaning = "KLT iterations a level", .min = 1, .max = 100});
  d.Field("max_back_error", c.max_back_error,
          {.unit = "px", .meaning = "there and back again", .min = 0.01, .max = 10});
  d.Field("max_epipolar_error", c.max_epipolar_error,
          {.unit = "px", .meaning = "from the right match to its epipolar line", .min = 0.1, .max = 20});
  d.Field("min_stereo_depth", c.min_stereo_depth,
          {.unit = "m", .meaning = "nearest depth searched for", .min = 0.05, .max = 10});
  d.Field("border", c.border, {.unit = "px", .meaning = "kept free at the image's edge", .min = 5, .max = 100});
  d.Field("max_misses", c.max_misses,
          {.meaning = "images for which a lost corner is looked for", .min = 0, .max = 100});
}

class StereoTracker::Impl {
 public:
  Impl(const StereoRig& rig, const StereoTrackerConfig& config) : rig_(rig), config_(config), matcher_(rig, config) {}

  std::vector<Track> Follow(const Image& left, const Image& right, const Transform& X_RC, const DepthImage& depth) {
    left_ = BuildPyramid(left, rig_.left.width, rig_.left.height, true, config_);
    if (rig_.depth == DepthSource::kStereo)
      right_ = BuildPyramid(right, rig_.right.width, rig_.right.height, false, config_);
    if (rig_.depth == DepthSource::kDepthCamera) depth_ = depth;
    FollowInTime(X_RC.Inverse());
    FindDepths();
    std::erase_if(corners_, [this](const Corner& c) { return c.misses > config_.max_misses; });
    return Visible();
  }

  std::vector<Track> MakeReference() {
    std::erase_if(corners_, [](const Corner& c) { return c.misses > 0; });
    std::vector<cv::Point2f> taken;
    for (const Corner& c : corners_) taken.push_back(ToPoint(c.track.pixel));
    const int wanted = config_.max_tracks - static_cast<int>(corners_.size());
    const std::size_t old = corners_.size();
    for (const cv::Point2f& p : FindCorners(left_, taken, wanted, config_)) {
      Corner corner;
      corner.track.id = next_id_++;
      corner.track.pixel = {p.x, p.y};
      corner.track.left = Normalise(rig_.left, corner.track.pixel);
      corners_.push_back(corner);
    }
    FindDepths(old);
    for (Corner& c : corners_) {
      c.reference_pixel = c.track.pixel;
      c.track.reference = c.track.left;
      c.reference_depth = c.track.depth;
    }
    reference_ = left_;
    reference_count_ = static_cast<int>(corners_.size());
    return Visible();
  }

  void Drop(std::span<const std::uint64_t> ids) {
    std::erase_if(corners_,
                  [&ids](const Corner& c) { return std::find(ids.begin(), ids.end(), c.track.id) != ids.end(); });
  }

  int ReferenceCount() const { return reference_count_; }

 private:
  struct Corner {
    Track track;
    Vec2 reference_pixel = Vec2::Zero();
    double reference_depth = 0.0;  // m, 0 where unknown
    int misses = 0;                // images since it was last seen
  };

  static cv::Point2f ToPoint(const Vec2& p) { return {static_cast<float>(p.x()), static_cast<float>(p.y())}; }

  /// Where the reference's corner should be now, and how deep; a corner of unknown depth is taken as infinitely far.
  Vec3 Predict(const Corner& c, const Transform& X_CR) const {
    const Vec3 ray = c.track.reference.homogeneous();
    return c.reference_depth > 0 ? X_CR * Vec3(c.reference_depth * ray) : X_CR.q * ray;
  }

  void FollowInTime(const Transform& X_CR) {
    std::vector<std::size_t> index;
    std::vector<cv::Point2f> from, guess;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      Corner& c = corners_[i];
      ++c.misses;
      const Vec3 p = Predict(c, X_CR);
      if (p.z() < 0.05) continue;
      const Vec2 pixel = Project(rig_.left, p);
      if (!Inside(rig_.left, pixel, 0.0)) continue;
      index.push_back(i);
      from.push_back(ToPoint(c.reference_pixel));
      guess.push_back(ToPoint(pixel));
    }
    const std::vector<Flow> flow = FollowPoints(reference_, left_, from, guess, config_.levels, true, config_);
    for (std::size_t k = 0; k < index.size(); ++k) {
      Corner& c = corners_[index[k]];
      const Vec2 pixel(flow[k].to.x, flow[k].to.y);
      if (!flow[k].found || !Inside(rig_.left, pixel, 0.5 * config_.border)) continue;
      c.misses = 0;
      ++c.track.age;
      c.track.pixel = pixel;
      c.track.left = Normalise(rig_.left, pixel);
      const Vec3 p = Predict(c, X_CR);
      c.track.depth = c.reference_depth > 0 && p.z() > 0.05 ? p.z() : 0.0;
    }
  }

  /// Of what was seen in the left image, from corner `first` on.
  void FindDepths(std::size_t first = 0) {
    if (rig_.depth == DepthSource::kStereo) MatchRight(first);
    if (rig_.depth == DepthSource::kDepthCamera) ReadDepths(first);
  }

  void ReadDepths(std::size_t first) {
    for (std::size_t i = first; i < corners_.size(); ++i) {
      Track& track = corners_[i].track;
      track.right.reset();
      if (corners_[i].misses > 0) continue;
      const std::optional<double> depth = depth_.millimetres ? DepthAt(depth_, track.pixel) : std::nullopt;
      track.depth = depth.value_or(0.0);
      if (depth) track.right = VirtualRight(rig_, track.left, *depth);
    }
  }

  void MatchRight(std::size_t first) {
    std::vector<std::size_t> index;
    std::vector<StereoMatcher::Query> queries;
    for (std::size_t i = first; i < corners_.size(); ++i) {
      Corner& c = corners_[i];
      c.track.right.reset();
      if (c.misses > 0) continue;
      index.push_back(i);
      queries.push_back({c.track.pixel, c.track.depth > 0 ? std::optional(c.track.depth) : std::nullopt});
      c.track.depth = 0.0;
    }
    const auto matches = matcher_.Find(left_, right_, queries);
    for (std::size_t k = 0; k < index.size(); ++k) {
      if (!matches[k]) continue;
      Track& track = corners_[index[k]].track;
      track.right = matches[k]->right;
      track.depth = matches[k]->depth > 0 ? std::min(matches[k]->depth, kFarthest) : kFarthest;
    }
  }

  std::vector<Track> Visible() const {
    std::vector<Track> tracks;
    for (const Corner& c : corners_) {
      if (c.misses == 0) tracks.push_back(c.track);
    }
    return tracks;
  }

  static constexpr double kFarthest = 200.0;  // m; where a disparity says nothing more

  StereoRig rig_;
  StereoTrackerConfig config_;
  StereoMatcher matcher_;
  Pyramid reference_, left_, right_;
  DepthImage depth_;
  std::vector<Corner> corners_;
  std::uint64_t next_id_ = 1;
  int reference_count_ = 0;
};

StereoTracker::StereoTracker(const StereoRig& rig, const StereoTrackerConfig& config)
    : impl_(std::make_unique<Impl>(rig, config)) {}
StereoTracker::~StereoTracker() = default;
StereoTracker::StereoTracker(StereoTracker&&) noexcept = default;
StereoTracker& StereoTracker::operator=(StereoTracker&&) noexcept = default;

std::vector<Track> StereoTracker::Follow(const Image& left, const Image& right, const Transform& X_RC,
                                         const DepthImage& depth) {
  return impl_->Follow(left, right, X_RC, depth);
}
std::vector<Track> StereoTracker::MakeReference() { return impl_->MakeReference(); }
void StereoTracker::Drop(std::span<const std::uint64_t> ids) { impl_->Drop(ids); }
int StereoTracker::ReferenceCount() const { return impl_->ReferenceCount(); }

}  // namespace alula::stack::features

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/frames.h"
#include "stack/features/stereo_rig.h"
#include "stack/features/stereo_tracker_config.h"
#include "stack/interface/measurement.h"

namespace alula::stack::features {

/// One corner as the newest stereo pair shows it. Coordinates without lens distortion are normalised (x/z, y/z).
struct Track {
  std::uint64_t id = 0;
  base::Vec2 pixel = base::Vec2::Zero();      // in the left image
  base::Vec2 left = base::Vec2::Zero();       // normalised, left camera
  std::optional<base::Vec2> right;            // normalised, right camera (stereo_rig.h: also of a depth camera)
  double depth = 0.0;                         // m, 0 where unknown
  base::Vec2 reference = base::Vec2::Zero();  // normalised, left camera of the reference pair
  int age = 0;                                // images since the corner was found
};

/// Follows corners from a reference stereo pair (a keyframe) into later ones. Following always starts from the
/// reference patch, so that a hovering vehicle's tracks do not creep; a corner that is hidden for some images is found
/// again. The caller decides when the newest pair becomes the reference.
class StereoTracker {
 public:
  StereoTracker(const StereoRig& rig, const StereoTrackerConfig& config);
  ~StereoTracker();
  StereoTracker(StereoTracker&&) noexcept;
  StereoTracker& operator=(StereoTracker&&) noexcept;

  /// Corners of the reference found in this pair. `X_RC`: predicted pose of the new left camera in the reference left
  /// camera. Of `right` and `depth` only what the rig measures depth with is looked at. Throws base::InputError for
  /// images that are not 8-bit grey or not of the calibrated size.
  std::vector<Track> Follow(const Image& left, const Image& right, const base::Transform& X_RC,
                            const DepthImage& depth = {});

  /// Makes the newest pair the reference, finds corners in empty cells of the grid and matches them left to right.
  /// Returns all corners of the new reference.
  std::vector<Track> MakeReference();

  /// Forgets corners (outliers); `ids` in any order.
  void Drop(std::span<const std::uint64_t> ids);

  /// Corners that the reference had when it was made.
  int ReferenceCount() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace alula::stack::features

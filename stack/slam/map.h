#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "stack/slam/bundle_adjustment.h"
#include "stack/slam/place_view.h"

namespace alula::stack::slam {

/// A point of the map: where it is, what it looks like, who saw it.
struct Landmark {
  struct Sight {
    int keyframe = 0;
    int feature = 0;
  };
  int part = 0;  // of the map
  base::Vec3 p_M = base::Vec3::Zero();
  features::Descriptor descriptor{};
  base::Vec3 normal = base::Vec3::Zero();  // mean unit direction from the point to those who saw it
  double reference_distance = 0.0;         // m: at which it was seen on
  double reference_scale = 1.0;            // this scale of the image pyramid
  int born = 0;                            // the keyframe that first saw it
  std::vector<Sight> sights;               // ascending in keyframes
};

/// A frame that the map remembers.
struct Keyframe {
  int id = 0;
  int part = 0;  // of the map
  std::uint32_t seq = 0;
  base::Time stamp;
  base::Transform X_OB;  // as the odometry had it when the keyframe was taken
  base::Transform X_MB;
  std::optional<base::Vec3> up_B = base::Vec3::UnitZ();  // none where no IMU tells
  PlaceView view;
  std::vector<std::optional<base::Vec2>> right;  // of each point, normalised, as the right eye saw it
  std::vector<int> landmarks;                    // of each point; −1: none
  /// Motion from the keyframe before it, as the odometry measured it; none where it lost its way in between.
  std::optional<RelativeMotion> from_previous;
  int previous = -1;
};

/// Keyframes and landmarks by id; those that were dropped leave a null. Ids are never given twice. Where the way was
/// lost a new part begins: parts share no landmarks, and how they lie to one another is a guess until one is recognised
/// in the other (an atlas: Campos et al. 2021).
struct Map {
  Eyes eyes;  // as known now; the rig is one through the whole map
  std::vector<std::unique_ptr<Keyframe>> keyframes;
  std::vector<std::unique_ptr<Landmark>> landmarks;
  std::vector<int> anchors;  // of each part, its first keyframe, which holds it; −1: it was joined to another

  Keyframe& keyframe(int id) { return *keyframes[static_cast<std::size_t>(id)]; }
  const Keyframe& keyframe(int id) const { return *keyframes[static_cast<std::size_t>(id)]; }
  Landmark& landmark(int id) { return *landmarks[static_cast<std::size_t>(id)]; }
  const Landmark& landmark(int id) const { return *landmarks[static_cast<std::size_t>(id)]; }
};

/// A keyframe and how many landmarks it shares with some other.
struct Covisible {
  int keyframe = 0;
  int shared = 0;
};

/// Keyframes that see at least `least` of the landmarks that `id` sees, most first, then oldest.
std::vector<Covisible> CovisibleWith(const Map& map, int id, int least);

/// A new landmark seen by one point of a keyframe. Its id.
int AddLandmark(Map& map, int keyframe, int feature, const base::Vec3& p_M);
/// One more sight of a landmark; the point must have none.
void AddSight(Map& map, int landmark, int keyframe, int feature);
/// Takes a sight away; a landmark without any goes with it.
void RemoveSight(Map& map, int landmark, int keyframe);
void RemoveLandmark(Map& map, int landmark);
/// All sights of `from` become sights of `into`, where that keyframe has none of it yet.
void FuseLandmarks(Map& map, int from, int into);
/// Normal, reference and descriptor from the sights that there are.
void RefreshLandmark(Map& map, int landmark);

}  // namespace alula::stack::slam

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "stack/estimation/odometry.h"
#include "stack/interface/camera_model.h"
#include "stack/slam/landmark_search.h"
#include "stack/slam/map.h"
#include "stack/slam/map_config.h"

namespace alula::stack::slam {

/// A frame as it becomes a keyframe of the map.
struct KeyframeInput {
  std::uint32_t seq = 0;
  base::Time stamp;
  base::Transform X_OB;
  Eyes eyes;       // as refined so far
  PlaceView view;  // its depths are those of the nominal rig
  /// Keyframes before it as the odometry has them now, oldest first, the one before it last: the motion since then.
  /// Empty where the odometry has lost its way in between.
  std::vector<estimation::KeyframePose> window;
};

/// What a keyframe taught.
struct KeyframeReport {
  int keyframe = -1;
  base::Transform X_MO;
  int looked_for = 0;  // landmarks of the map around it
  int matched = 0;     // of them found again and kept
  int created = 0;     // new landmarks
};

/// Keeps a map of keyframes and landmarks around the odometry: every keyframe is found in the map by what it sees
/// again, fitted together with its neighbours (local bundle adjustment), and adds what is new. What it adds to the
/// odometry is that a place seen again does not drift: X_MO, a turn about the vertical and a shift, takes the drift
/// back. (Mur-Artal and Tardós 2017, sections III.C and VI; Usenko et al. 2020 for the odometry's factors.)
class Mapper {
 public:
  /// `rig`: nominal, with which the views' depths are found.
  Mapper(const features::StereoRig& rig, const MapConfig& config);

  KeyframeReport Add(KeyframeInput input);

  /// Fits the whole map together; to be called at the end.
  void Finish();

  const Map& map() const { return map_; }
  base::Transform X_MO() const { return X_MO_; }

  /// Where a keyframe is, also one that was dropped since.
  base::Transform PoseOf(int keyframe) const;

 private:
  struct Dropped {
    int heir = 0;
    base::Transform X_HB;  // of the dropped one in its heir
  };

  void TakeMotions(const KeyframeInput& input, Keyframe& keyframe);
  std::vector<int> LocalLandmarks(const Keyframe& keyframe) const;
  int Recognise(Keyframe& keyframe, KeyframeReport& report);
  /// The pose that fits the matches, the odometry's motion and its vertical; matches that disagree go. None when too
  /// few are left.
  std::optional<base::Transform> Refine(const Keyframe& keyframe, const base::Transform& X_MB,
                                        std::vector<LandmarkMatch>& matches) const;
  void CreateLandmarks(Keyframe& keyframe, KeyframeReport& report);
  void FuseDuplicates(Keyframe& keyframe);
  void AdjustAround(int keyframe);
  void AdjustWhole(int iterations, double tolerance);
  void DropPoorLandmarks(int keyframe);
  void DropRedundantKeyframes(int keyframe);
  void Drop(int keyframe);

  features::StereoRig rig_;
  MapConfig config_;
  Map map_;
  base::Transform X_MO_;
  int first_ = 0;  // keyframe, which stays where it was put
  int newest_ = -1;
  std::vector<std::optional<Dropped>> dropped_;  // by id
};

}  // namespace alula::stack::slam

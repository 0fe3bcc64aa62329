#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "stack/estimation/odometry.h"
#include "stack/interface/camera_model.h"
#include "stack/slam/landmark_search.h"
#include "stack/slam/map.h"
#include "stack/slam/map_config.h"
#include "stack/slam/map_correction.h"
#include "stack/slam/place_recogniser.h"

namespace alula::stack::slam {

/// A frame as it becomes a keyframe of the map.
struct KeyframeInput {
  std::uint32_t seq = 0;
  base::Time stamp;
  base::Transform X_OB;
  Eyes eyes;            // as refined so far
  PlaceView view;       // its depths are those of the nominal rig
  bool upright = true;  // the odometry knows the vertical
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
  /// A place known again, by which the map was put right.
  std::optional<Loop> loop;
  bool joined = false;  // by it, a part of the map was joined to another
};

/// Keeps a map of keyframes and landmarks around the odometry: every keyframe is found in the map by what it sees
/// again, fitted together with its neighbours (local bundle adjustment), and adds what is new. What it adds to the
/// odometry is that a place seen again does not drift: X_MO, a turn about the vertical and a shift, takes the drift
/// back. (Mur-Artal and Tardós 2017, sections III.C and VI; Usenko et al. 2020 for the odometry's factors.)
/// Where the odometry has lost its way a new part of the map begins. Places that are known again by their looks close
/// loops, which a pose graph spreads over the way between, and join parts (Campos et al. 2021).
class Mapper {
 public:
  /// `rig`: nominal, with which the views' depths are found. `vocabulary` may be null: then no place is known again but
  /// by where the map believes to be.
  /// `known`: a map from before; where the vehicle is in it shows once a place of it is known again.
  Mapper(const features::StereoRig& rig, const MapConfig& config, std::shared_ptr<const Vocabulary> vocabulary,
         Map known = {});

  KeyframeReport Add(KeyframeInput input);

  /// Fits each part of the map together; to be called at the end.
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

  /// What a keyframe says of a place that is known again.
  struct Claim {
    Loop loop;
    base::Transform X_NM;  // upright: from where the map has the keyframe to where the known place puts it
    int part = 0;          // of the known place
  };

  void TakeMotions(const KeyframeInput& input, Keyframe& keyframe);
  /// Landmarks of keyframes that see the same as `centre`, and of those near X_MB that look the same way.
  std::vector<int> LandmarksAround(int centre, const base::Transform& X_MB) const;
  int Recognise(Keyframe& keyframe, KeyframeReport& report);
  /// The pose that fits the matches, the odometry's motion and its vertical; matches that disagree go. None when too
  /// few are left.
  std::optional<base::Transform> Refine(const Keyframe& keyframe, const base::Transform& X_MB,
                                        std::vector<LandmarkMatch>& matches, bool with_motion) const;
  void CreateLandmarks(Keyframe& keyframe, KeyframeReport& report);
  void FuseDuplicates(Keyframe& keyframe);
  void AdjustAround(int keyframe);
  void AdjustPart(int part, int iterations, double tolerance);
  void DropPoorLandmarks(int keyframe);
  void DropRedundantKeyframes(int keyframe);
  void Drop(int keyframe);

  void LookForLoop(Keyframe& keyframe, KeyframeReport& report);
  std::optional<Claim> Examine(const Keyframe& keyframe, const KnownPlace& place) const;
  bool WithinDrift(const Keyframe& keyframe, const Claim& claim) const;
  bool Confirmed(const Keyframe& keyframe, const Claim& claim);
  /// Landmarks of a known place among what a keyframe sees from X_MB, whether its features show others already or none.
  std::vector<LandmarkMatch> MatchAll(const Keyframe& keyframe, const base::Transform& X_MB,
                                      const std::vector<int>& landmarks, double radius) const;
  void FuseAround(int keyframe, int known);

  features::StereoRig rig_;
  MapConfig config_;
  Map map_;
  std::optional<PlaceRecogniser> places_;
  std::deque<Claim> claims_;  // of the last keyframes, not confirmed
  base::Transform X_MO_;
  int newest_ = -1;
  std::vector<std::optional<Dropped>> dropped_;  // by id
};

}  // namespace alula::stack::slam

#include "stack/slam/keyframe_features.h"

#include "stack/features/keypoint_stereo.h"

namespace alula::stack::slam {

KeyframeFeatures FindKeyframeFeatures(const Image& left, const Image& right, const features::StereoRig& rig,
                                      const features::OrbConfig& orb, const features::StereoTrackerConfig& stereo) {
  const std::vector<features::Keypoint> keypoints = features::DetectOrb(left, orb);
  std::vector<base::Vec2> pixels;
  for (const features::Keypoint& k : keypoints) pixels.push_back(k.pixel);
  const auto sights = features::FindInRightEye(left, right, pixels, rig, stereo);
  KeyframeFeatures found;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    KeyframeFeature f;
    f.pixel = keypoints[i].pixel;
    f.left = Normalise(rig.left, f.pixel);
    f.octave = keypoints[i].octave;
    f.descriptor = keypoints[i].descriptor;
    if (sights[i] && sights[i]->depth > 0) {
      f.right = sights[i]->right;
      f.depth = sights[i]->depth;
    }
    found.push_back(f);
  }
  return found;
}

}  // namespace alula::stack::slam

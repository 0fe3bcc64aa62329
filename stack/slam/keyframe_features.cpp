#include "stack/slam/keyframe_features.h"

#include <cstring>
#include <opencv2/features2d.hpp>

#include "stack/features/keypoint_stereo.h"

namespace alula::stack::slam {

KeyframeFeatures FindKeyframeFeatures(const Image& left, const Image& right, const features::StereoRig& rig, int count,
                                      const features::StereoTrackerConfig& config) {
  const cv::Mat view(left.height, left.width, CV_8UC1, const_cast<std::uint8_t*>(left.Row(0)),
                     static_cast<std::size_t>(left.stride));
  std::vector<cv::KeyPoint> keypoints, kept;
  cv::Mat descriptors;
  cv::Ptr<cv::ORB> orb = cv::ORB::create(4 * count, 1.2F, 8, 16, 0, 2, cv::ORB::HARRIS_SCORE, 31, 8);
  orb->detect(view, keypoints);
  constexpr int kCell = 32;
  std::vector<int> taken(static_cast<std::size_t>((left.width / kCell + 1) * (left.height / kCell + 1)), 0);
  std::stable_sort(keypoints.begin(), keypoints.end(),
                   [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.response > b.response; });
  for (const cv::KeyPoint& k : keypoints) {
    int& n = taken[static_cast<std::size_t>(static_cast<int>(k.pt.y) / kCell * (left.width / kCell + 1) +
                                            static_cast<int>(k.pt.x) / kCell)];
    if (n >= 3) continue;
    ++n;
    kept.push_back(k);
    if (static_cast<int>(kept.size()) >= count) break;
  }
  orb->compute(view, kept, descriptors);
  std::vector<base::Vec2> pixels;
  for (const cv::KeyPoint& k : kept) pixels.emplace_back(k.pt.x, k.pt.y);
  const auto sights = features::FindInRightEye(left, right, pixels, rig, config);
  KeyframeFeatures found;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    KeyframeFeature f;
    f.pixel = pixels[i];
    f.left = Normalise(rig.left, f.pixel);
    f.level = kept[i].octave;
    std::memcpy(f.descriptor.data(), descriptors.ptr(static_cast<int>(i)), 32);
    if (sights[i] && sights[i]->depth > 0) {
      f.right = sights[i]->right;
      f.depth = sights[i]->depth;
    }
    found.push_back(f);
  }
  return found;
}

}  // namespace alula::stack::slam

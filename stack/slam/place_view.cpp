#include "stack/slam/place_view.h"

#include "stack/features/keypoint_depth.h"
#include "stack/features/orb.h"
#include "stack/interface/camera_model.h"

namespace alula::stack::slam {

PlaceView ViewOf(const features::StereoRig& rig, const Image& left, const Image& right,
                 const features::OrbConfig& config, const DepthImage& depth) {
  PlaceView view;
  view.focal = 0.5 * (rig.left.fx + rig.left.fy);
  view.focal_baseline = view.focal * rig.X_LR.p.norm();
  std::vector<base::Vec2> pixels;
  for (const features::Keypoint& k : features::DetectOrb(left, config)) {
    PlacePoint point;
    point.pixel = k.pixel;
    point.normalised = Normalise(rig.left, k.pixel);
    point.scale = features::OctaveScale(config, k.octave);
    point.angle = k.angle;
    point.descriptor = k.descriptor;
    view.points.push_back(point);
    pixels.push_back(k.pixel);
  }
  const std::vector<std::optional<double>> depths = features::KeypointDepths(rig, left, right, depth, pixels);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (depths[i]) view.points[i].p_C = *depths[i] * view.points[i].normalised.homogeneous();
  }
  return view;
}

}  // namespace alula::stack::slam

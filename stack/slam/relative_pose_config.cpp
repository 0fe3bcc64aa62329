#include "stack/slam/relative_pose.h"

namespace alula::stack::slam {

void Describe(base::Description& d, RelativePoseConfig& c) {
  d.Field("max_distance", c.max_distance, {.meaning = "bits between descriptors that match", .min = 1, .max = 256});
  d.Field("ratio", c.ratio, {.meaning = "of the best match's distance to the next best", .min = 0.1, .max = 1});
  d.Field("trials", c.trials, {.meaning = "samples of RANSAC at most", .min = 1, .max = 100000});
  d.Field("pixel_sigma", c.pixel_sigma,
          {.unit = "px", .meaning = "of a keypoint's place, at octave 0", .min = 0.01, .max = 20});
  d.Field("disparity_sigma", c.disparity_sigma,
          {.unit = "px", .meaning = "of the disparity that gave a depth", .min = 0.01, .max = 20});
  d.Field("gate", c.gate, {.meaning = "standard deviations beyond which a match is none", .min = 1, .max = 10});
  d.Field("search_radius", c.search_radius,
          {.unit = "px", .meaning = "around a predicted place", .min = 1, .max = 200});
  d.Field("search_distance", c.search_distance,
          {.meaning = "bits between descriptors near a predicted place", .min = 1, .max = 256});
  d.Field("use_gravity", c.use_gravity, {.meaning = "take the vertical from the views where both know it"});
  d.Field("gravity_sigma", c.gravity_sigma,
          {.unit = "rad", .meaning = "of each view's vertical", .min = 1e-4, .max = 0.5});
  d.Field("min_inliers", c.min_inliers, {.meaning = "points that both views show", .min = 6, .max = 1000});
  d.Field("min_share", c.min_share, {.meaning = "of the points that the other view should show", .min = 0, .max = 1});
  d.Field("min_spread", c.min_spread,
          {.meaning = "standard deviation of the points' places, in focal lengths", .min = 0, .max = 1});
  d.Field("max_position_sigma", c.max_position_sigma,
          {.unit = "m", .meaning = "of the relative position", .min = 0.001, .max = 100});
}

}  // namespace alula::stack::slam

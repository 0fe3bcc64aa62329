#include "stack/slam/map_config.h"

namespace alula::stack::slam {

void Describe(base::Description& d, SearchConfig& c) {
  d.Field("radius", c.radius, {.unit = "px", .meaning = "around where a landmark is expected", .min = 1, .max = 200});
  d.Field("near_radius", c.near_radius, {.unit = "px", .meaning = "once the pose is corrected", .min = 1, .max = 100});
  d.Field("max_distance", c.max_distance,
          {.meaning = "bits of 256 by which descriptors may differ", .min = 1, .max = 256});
  d.Field("ratio", c.ratio, {.meaning = "of the best distance to the second best", .min = 0.1, .max = 1});
  d.Field("max_angle", c.max_angle,
          {.unit = "rad", .meaning = "between the ways it is and was looked at", .min = 0.1, .max = 3.2});
  d.Field("least", c.least, {.meaning = "matches below which the odometry alone is believed", .min = 3, .max = 1000});
}

void Describe(base::Description& d, AdjustConfig& c) {
  d.Field("keyframes", c.keyframes, {.meaning = "newest ones that move", .min = 1, .max = 100});
  d.Field("covisible", c.covisible, {.meaning = "others that see the same, which move too", .min = 0, .max = 100});
  d.Field("fixed", c.fixed, {.meaning = "keyframes that hold the rest where it is", .min = 1, .max = 500});
  d.Field("iterations", c.iterations, {.meaning = "of Levenberg-Marquardt at a keyframe", .min = 0, .max = 100});
  d.Field("whole_every", c.whole_every,
          {.meaning = "keyframes after which the whole map is fitted together; 0: never", .min = 0, .max = 100000});
  d.Field("whole_iterations", c.whole_iterations, {.meaning = "of Levenberg-Marquardt then", .min = 1, .max = 100});
  d.Field("final_iterations", c.final_iterations, {.meaning = "of the whole map, at the end", .min = 0, .max = 1000});
  d.Field("pixel_sigma", c.pixel_sigma, {.unit = "px", .meaning = "on the finest level", .min = 0.05, .max = 20});
  d.Field("huber", c.huber, {.meaning = "sigmas beyond which a pull grows no more", .min = 0.1, .max = 100});
  d.Field("gate", c.gate, {.meaning = "sigmas beyond which a sight is dropped", .min = 0.5, .max = 100});
  d.Field("motion_position", c.motion_position,
          {.unit = "m", .meaning = "1 sigma of the odometry between two keyframes", .min = 1e-5, .max = 1});
  d.Field("motion_drift", c.motion_drift, {.meaning = "besides, share of the way", .min = 0, .max = 1});
  d.Field("motion_angle", c.motion_angle, {.unit = "rad", .meaning = "1 sigma of its turn", .min = 1e-6, .max = 1});
  d.Field("motion_angle_drift", c.motion_angle_drift, {.unit = "rad/s", .meaning = "besides", .min = 0, .max = 1});
  d.Field("vertical", c.vertical,
          {.unit = "rad", .meaning = "1 sigma of the odometry's vertical", .min = 1e-5, .max = 1});
}

void Describe(base::Description& d, LoopConfig& c) {
  d.Field("enabled", c.enabled, {.meaning = "look for places that are known again"});
  d.Field("filter", c.filter, {.meaning = "which candidates to believe"});
  d.Field("geometry", c.geometry, {.meaning = "when two views show the same"});
  d.Field("recent", c.recent, {.meaning = "keyframes before the newest that are no news", .min = 1, .max = 1000});
  d.Field("looks", c.looks, {.meaning = "views of a place that are compared with the newest", .min = 1, .max = 100});
  d.Field("least", c.least,
          {.meaning = "landmarks of the known place that the newest keyframe must show", .min = 6, .max = 1000});
  d.Field("agree", c.agree, {.meaning = "keyframes that must say the same", .min = 1, .max = 100});
  d.Field("agree_within", c.agree_within, {.meaning = "keyframes, among which they are", .min = 1, .max = 1000});
  d.Field("agree_position", c.agree_position, {.unit = "m", .meaning = "that is the same", .min = 0.001, .max = 100});
  d.Field("agree_angle", c.agree_angle, {.unit = "rad", .meaning = "that is the same", .min = 1e-4, .max = 1});
  d.Field("tilt", c.tilt, {.unit = "rad", .meaning = "by which the verticals may differ", .min = 1e-4, .max = 1});
  d.Field("drift_position", c.drift_position,
          {.unit = "m", .meaning = "by which a loop may move the newest keyframe", .min = 0, .max = 1000});
  d.Field("drift_share", c.drift_share, {.meaning = "besides, share of the way since then", .min = 0, .max = 1});
  d.Field("drift_angle", c.drift_angle,
          {.unit = "rad", .meaning = "by which a loop may turn the newest keyframe", .min = 0, .max = 4});
  d.Field("drift_angle_rate", c.drift_angle_rate, {.unit = "rad/s", .meaning = "besides", .min = 0, .max = 1});
  d.Field("tie_position", c.tie_position,
          {.unit = "m", .meaning = "1 sigma of neighbours while a loop is spread", .min = 1e-4, .max = 10});
  d.Field("tie_angle", c.tie_angle, {.unit = "rad", .meaning = "likewise", .min = 1e-5, .max = 1});
}

void Describe(base::Description& d, MapConfig& c) {
  d.Field("enabled", c.enabled, {.meaning = "keep a map; off: odometry alone"});
  d.Field("latency", c.latency, {.unit = "s", .meaning = "until what a keyframe taught is known", .min = 0, .max = 10});
  d.Field("orb", c.orb, {.meaning = "keypoints of a keyframe"});
  d.Field("farthest", c.farthest, {.unit = "m", .meaning = "where a landmark may begin", .min = 1, .max = 10000});
  d.Field("search", c.search, {.meaning = "finding landmarks again"});
  d.Field("adjust", c.adjust, {.meaning = "fitting keyframes and landmarks together"});
  d.Field("loop", c.loop, {.meaning = "places that are known again"});
  d.Field("redundant", c.redundant,
          {.meaning = "share of a keyframe's landmarks that three others see: it goes", .min = 0.1, .max = 2});
}

}  // namespace alula::stack::slam

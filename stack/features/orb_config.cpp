#include "stack/features/orb_config.h"

namespace alula::stack::features {

void Describe(base::Description& d, OrbConfig& c) {
  d.Field("keypoints", c.keypoints, {.meaning = "keypoints wanted of an image", .min = 10, .max = 10000});
  d.Field("levels", c.levels, {.meaning = "pyramid levels", .min = 1, .max = 16});
  d.Field("scale", c.scale, {.meaning = "between pyramid levels", .min = 1.05, .max = 1.9});
  d.Field("cell", c.cell, {.unit = "px", .meaning = "side of a cell with its own threshold", .min = 8, .max = 400});
  d.Field("threshold", c.threshold, {.meaning = "grey levels of FAST", .min = 1, .max = 200});
  d.Field("low_threshold", c.low_threshold,
          {.meaning = "grey levels of FAST in a cell that has no corner at `threshold`", .min = 1, .max = 200});
  d.Field("smallest_leaf", c.smallest_leaf,
          {.unit = "px", .meaning = "leaves of the quadtree are not divided below", .min = 1, .max = 100});
  d.Field("ranking", c.ranking,
          {.meaning = "which corner of a leaf stays: by FAST's score or by contrast to its circle",
           .choices = {"score", "saliency"}});
  d.Field("sub_pixel", c.sub_pixel, {.meaning = "refine places to a fraction of a pixel"});
}

}  // namespace alula::stack::features

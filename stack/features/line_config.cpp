#include "stack/features/line_config.h"

#include "stack/features/line_stereo.h"
#include "stack/features/line_tracks.h"

namespace alula::stack::features {

void Describe(base::Description& d, LineConfig& c) {
  d.Field("detector", c.detector,
          {.meaning = "edge drawing and fitting, or LSD, six times slower", .choices = {"edlines", "lsd"}});
  d.Field("half", c.half, {.meaning = "at half resolution"});
  d.Field("min_gradient", c.min_gradient,
          {.unit = "1", .meaning = "grey levels a px that make an edge (edlines)", .min = 0.5, .max = 100});
  d.Field("anchor_excess", c.anchor_excess,
          {.unit = "1", .meaning = "grey levels a px by which an anchor stands out (edlines)", .min = 0, .max = 100});
  d.Field("fit_error", c.fit_error,
          {.unit = "px", .meaning = "from a line for what belongs to it (edlines)", .min = 0.1, .max = 10});
  d.Field("reduce", c.reduce, {.meaning = "drop short segments and merge those that continue one another"});
  d.Field("min_share", c.min_share,
          {.meaning = "of the image's shorter side; shorter segments are dropped", .min = 0, .max = 1});
  d.Field("merge_angle", c.merge_angle,
          {.unit = "rad", .meaning = "between segments that are merged", .min = 0, .max = 0.5});
  d.Field("merge_offset", c.merge_offset, {.unit = "px", .meaning = "between their lines", .min = 0, .max = 50});
  d.Field("merge_gap", c.merge_gap, {.meaning = "between their ends, of the shorter one", .min = 0, .max = 10});
  d.Field("keep", c.keep, {.meaning = "longest segments", .min = 1, .max = 10000});
}

void Describe(base::Description& d, LineStereoConfig& c) {
  d.Field("min_depth", c.min_depth, {.unit = "m", .meaning = "of a line; none is nearer", .min = 0.05, .max = 100});
  d.Field("max_angle", c.max_angle, {.unit = "rad", .meaning = "between both in rectified views", .min = 0, .max = 1});
  d.Field("min_overlap", c.min_overlap, {.meaning = "of the left one's rows", .min = 0, .max = 1});
  d.Field("min_slope", c.min_slope, {.meaning = "sine of the angle to the rows", .min = 0.01, .max = 1});
  d.Field("min_likeness", c.min_likeness, {.meaning = "correlation at the middles", .min = -1, .max = 1});
  d.Field("sparsity", c.sparsity, {.meaning = "weight of the L1 term", .min = 0, .max = 10});
  d.Field("min_weight", c.min_weight, {.meaning = "of the best candidate, of all", .min = 0, .max = 1});
  d.Field("patch", c.patch, {.unit = "px", .meaning = "side of the patches at the middles", .min = 3, .max = 41});
}

void Describe(base::Description& d, LineTrackConfig& c) {
  d.Field("max_offset", c.max_offset,
          {.unit = "px", .meaning = "from where a line is expected", .min = 0.5, .max = 200});
  d.Field("max_angle", c.max_angle, {.unit = "rad", .meaning = "likewise", .min = 0.005, .max = 1});
  d.Field("min_overlap", c.min_overlap, {.meaning = "of the shorter one, along the line", .min = 0, .max = 1});
}

}  // namespace alula::stack::features

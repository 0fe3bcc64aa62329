
#include "worlds/courtyard.h"
#include "worlds/textures.h"

namespace alula::worlds {
namespace {

/// Low and high end of a range that the seed draws from.
void Range(base::Description& d, const char* low_key, double& low, const char* high_key, double& high,
           const base::FieldInfo& info) {
  d.Field(low_key, low, info);
  d.Field(high_key, high, info);
  d.Check(high_key,
          [&low, &high, low_key] { return low <= high ? std::string() : "must not be below " + std::string(low_key); });
}

}  // namespace

void Describe(base::Description& d, CourtyardConfig& c) {
  Range(d, "opening_min", c.opening_min, "opening_max", c.opening_max,
        {.unit = "m", .meaning = "range of the side of a gate's opening", .min = 0.8, .max = 1.8});
  Range(d, "frame_min", c.frame_min, "frame_max", c.frame_max,
        {.unit = "m", .meaning = "range of the width and depth of a gate's bars", .min = 0.05, .max = 0.25});
  Range(d, "gate_height_min", c.gate_height_min, "gate_height_max", c.gate_height_max,
        {.unit = "m", .meaning = "range of the height of an opening's centre", .min = 0.6, .max = 2.3});
  d.Field("gate_heading_spread", c.gate_heading_spread,
          {.unit = "rad", .meaning = "how far a gate turns from the bisector of the course", .min = 0.0, .max = 0.6});
  d.Field("pad_radius", c.pad_radius, {.unit = "m", .meaning = "radius of the landing pad", .min = 1.0, .max = 1.6});
  d.Field("start_yaw_spread", c.start_yaw_spread,
          {.unit = "rad", .meaning = "how far the start looks past the first gate", .min = 0.0, .max = 3.15});
  Range(d, "wall_height_min", c.wall_height_min, "wall_height_max", c.wall_height_max,
        {.unit = "m", .meaning = "range of the height of the walls' panels", .min = 1.0, .max = 8.0});
  d.Field("trees", c.trees, {.meaning = "trees, at most", .min = 0, .max = 12});
  d.Field("crates", c.crates, {.meaning = "stacks of crates, at most", .min = 0, .max = 20});
  d.Field("poles", c.poles, {.meaning = "poles, at most", .min = 0, .max = 20});
  d.Field("benches", c.benches, {.meaning = "benches along the walls, at most", .min = 0, .max = 12});
  d.Field("blocker_probability", c.blocker_probability,
          {.meaning = "chance of an obstacle near the straight line between two gates", .min = 0.0, .max = 1.0});
  Range(d, "wind_speed_min", c.wind_speed_min, "wind_speed_max", c.wind_speed_max,
        {.unit = "m/s", .meaning = "range of the mean wind's speed; its direction is any", .min = 0.0, .max = 15.0});
  Range(d, "gust_share_min", c.gust_share_min, "gust_share_max", c.gust_share_max,
        {.meaning = "range of a gust's standard deviation as a share of the mean speed", .min = 0.0, .max = 1.0});
  d.Field("gust_time", c.gust_time, {.unit = "s", .meaning = "correlation time of gusts", .min = 0.05, .max = 60.0});
  Range(d, "sun_elevation_min", c.sun_elevation_min, "sun_elevation_max", c.sun_elevation_max,
        {.unit = "rad", .meaning = "range of the sun's elevation", .min = 0.05, .max = 1.57});
  d.Field("sunlight", c.sunlight, {.meaning = "factor on the sun's strength; 0 at night", .min = 0.0, .max = 2.0});
  d.Field("skylight", c.skylight,
          {.meaning = "factor on the light of the sky; some 0.01 at night", .min = 0.0, .max = 2.0});
  d.Field("wind", c.wind, {.meaning = "in place of the wind that the ranges draw; null: theirs"});
  d.Field("people", c.people, {.meaning = "people who walk about", .min = 0, .max = 60});
  d.Field("people_speed", c.people_speed, {.unit = "m/s", .meaning = "mean of their speeds", .min = 0.1, .max = 3.0});
  d.Field("reactive", c.reactive, {.meaning = "whether people heed the vehicle"});
  d.Field("swinging_gates", c.swinging_gates,
          {.meaning = "of the five, drawn: their frames swing about a hinge at the left", .min = 0, .max = 5});
  d.Field("gate_swing", c.gate_swing,
          {.unit = "rad", .meaning = "how far they swing to each side", .min = 0.0, .max = 0.8});
  d.Field("gate_period", c.gate_period, {.unit = "s", .meaning = "of a swing there and back", .min = 0.5, .max = 60.0});
  d.Field("fog", c.fog, {.meaning = "even fog; none where the key is missing"});
  d.Field("lamps", c.lamps, {.meaning = "lamps that stand in the courtyard, at most 32"});
  d.Check("lamps", [&c] { return c.lamps.size() <= 32 ? std::string() : std::string("must not be more than 32"); });
  d.Field("prop", c.prop, {.meaning = "mesh file of worlds/assets in the courtyard's middle; empty for none"});
  DescribeTextureSize(d, c.texture_size);
  d.Field("placement_tries", c.placement_tries,
          {.meaning = "draws of the course before the nominal one is taken", .min = 0, .max = 100'000});
}

}  // namespace alula::worlds

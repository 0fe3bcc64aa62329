#pragma once

#include <cstdint>
#include <string_view>

#include "base/describe.h"
#include "worlds/world.h"

namespace alula::worlds {

/// Flat textured ground with a pad in the middle and a few blocks far away: for hovering and for physics.
struct OpenGroundConfig {
  static constexpr std::string_view kType = "open_ground";

  double size = 60.0;          // m, side of the square of ground
  double pad_radius = 1.2;     // m
  double target_height = 1.5;  // m above the pad
  double start_yaw = 0.0;      // rad
  int blocks = 10;
  double block_distance_min = 12.0;           // m from the pad
  base::Vec3 wind_mean = base::Vec3::Zero();  // m/s, where the air moves to (world axes)
  double gust_sigma = 0.0;                    // m/s, per axis
  double gust_time = 2.0;                     // s
  int texture_size = 512;                     // texels a side
};

void Describe(base::Description& d, OpenGroundConfig& c);

/// Streams "world/blocks" and "world/texture/…" of `seed`. No gates; the target is above the pad.
World MakeWorld(const OpenGroundConfig& config, std::uint64_t seed);

}  // namespace alula::worlds

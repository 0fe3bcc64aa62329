#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "worlds/wind_config.h"
#include "worlds/world.h"

namespace alula::worlds {

/// A walled courtyard with a landing pad and a loop of five gates. The ranges are those from which the seed draws;
/// a key given as a distribution moves the range itself.
struct CourtyardConfig {
  static constexpr std::string_view kType = "courtyard";

  double opening_min = 1.2;           // m; 250 mm quadrotor plus tracking and mapping error on both sides
  double opening_max = 1.6;           // m
  double frame_min = 0.12;            // m; thinner bars fall between the voxels of a 0.1 m map
  double frame_max = 0.20;            // m
  double gate_height_min = 1.1;       // m, of the opening's centre
  double gate_height_max = 2.2;       // m
  double gate_heading_spread = 0.26;  // rad, about the bisector of the course (15°)
  double pad_radius = 1.2;            // m
  double start_yaw_spread = 0.44;     // rad, about the direction to the first gate (25°)
  double wall_height_min = 3.0;       // m
  double wall_height_max = 4.0;       // m
  int trees = 7;                      // at most; what finds no free place is left out
  int crates = 6;                     // stacks, at most
  int poles = 3;                      // at most
  int benches = 4;                    // at most, along the walls
  double blocker_probability = 0.6;   // of an obstacle close to the straight line between two gates
  double wind_speed_min = 0.0;        // m/s
  double wind_speed_max = 3.0;        // m/s
  double gust_share_min = 0.1;        // of the mean wind's speed, 1σ per axis
  double gust_share_max = 0.3;
  double gust_time = 2.0;             // s
  double sun_elevation_min = 0.44;    // rad (25°)
  double sun_elevation_max = 1.22;    // rad (70°)
  double sunlight = 1.0;              // factor on the sun's drawn strength; 0 at night
  double skylight = 1.0;              // factor on the light of the sky; 0.01 at night
  std::optional<WindConfig> wind{};   // in place of the drawn one
  int people = 0;                     // who walk about
  double people_speed = 1.2;          // m/s
  bool reactive = true;               // people heed the vehicle
  int swinging_gates = 0;             // of the five
  double gate_swing = 0.25;           // rad, their amplitude
  double gate_period = 4.0;           // s
  std::optional<Fog> fog{};           // none
  std::vector<Lamp> lamps{};          // that stand in the courtyard, besides sun and sky
  std::string prop = "fountain.obj";  // a mesh in worlds/assets, in the middle of the courtyard; empty: none
  int texture_size = 1024;            // texels a side of ground and walls; the rest has half
  int placement_tries = 400;          // draws of the course before the nominal one is taken
};

void Describe(base::Description& d, CourtyardConfig& c);

/// The courtyard of `seed`: 30 m × 20 m about the origin, ground at z = 0. What the seed draws comes from the streams
/// "world/course", "world/obstacles", "world/walls", "world/light", "world/wind", "world/texture/…", so that a change
/// of one leaves the others as they are. Promises (tests/worlds/courtyard_test.cpp):
/// consecutive gates 5–9 m apart, headings turn by ≤ 100°, course 35–55 m; nothing within 0.9 m of a gate's axis for
/// 2 m before and after it; every obstacle stands ≥ 1.3 m from gates and other obstacles, so that ways are passable;
/// the first and the last leg are free; a column above the pad is free; ≤ 30 000 triangles.
/// Objects of gate i are named "gate<i>/left", "/right", "/top", "/bottom", "/post", "/foot".
/// A gate that swings is the actor "gate<i>/frame" with its parts, beside "gate<i>/post" and "/foot"; its pose in
/// `gates` is that at rest. People are "person<i>" (streams "world/actors/…").
/// Throws base::InputError when the prop cannot be read, and where there is no room for so many people.
World MakeWorld(const CourtyardConfig& config, std::uint64_t seed);

}  // namespace alula::worlds

#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "base/describe.h"
#include "worlds/world.h"

namespace alula::worlds {

/// No turbulence besides gusts.
struct CalmAir {};
void Describe(base::Description& d, CalmAir& c);

/// Dryden turbulence (dryden.h).
struct DrydenConfig {
  std::optional<double> w20{};  // m/s, mean wind at 20 ft; null: that of the mean wind
  double airspeed_floor = 1.0;  // m/s, at which the frozen field passes a vehicle that stands in the air
};
void Describe(base::Description& d, DrydenConfig& c);

/// A 1-cosine gust (wind.h).
struct CosineGustConfig {
  double start = 5.0;                  // s
  double duration = 2.0;               // s
  base::Vec3 velocity{3.0, 0.0, 0.0};  // m/s at its middle, world axes
};
void Describe(base::Description& d, CosineGustConfig& c);

/// The wind of a world; every key may be a distribution.
struct WindConfig {
  double speed = 0.0;                 // m/s, of the mean
  std::optional<double> direction{};  // rad, where the air moves to, from east to north; null: drawn over the compass
  double gust_share = 0.0;            // of the mean's speed, 1σ per axis
  double gust_time = 2.0;             // s
  std::variant<CalmAir, DrydenConfig> turbulence{};
  std::vector<CosineGustConfig> gusts{};
  bool shelter = false;  // walls and houses keep the wind off what is behind them (shelter.h)
};
void Describe(base::Description& d, WindConfig& c);

/// Stream "world/wind" of the seed.
Wind DrawWind(const WindConfig& config, std::uint64_t seed);

}  // namespace alula::worlds

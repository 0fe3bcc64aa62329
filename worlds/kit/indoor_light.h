#pragma once

#include <optional>
#include <vector>

#include "base/describe.h"
#include "worlds/weather.h"
#include "worlds/world.h"

namespace alula::worlds {

/// The hour outside and what the lamps of an indoor world do.
struct IndoorLightConfig {
  enum class Lamps { kOn, kDim, kOff };

  WeatherConfig::Hour hour = WeatherConfig::Hour::kDay;
  std::optional<Lamps> lamps{};  // none: as the hour has it: on by day and at dusk, dim at night
};
void Describe(base::Description& d, IndoorLightConfig& c);

IndoorLightConfig::Lamps LampsAt(const IndoorLightConfig& config);

/// What lights a room. One unit of light shows a texture at its own value.
struct RoomLight {
  double daylight = 0.1;                        // scattered light of the windows by day
  double overhead = 0.4;                        // of all lamps on the ceiling as one broad light
  double scattered = 0.3;                       // of that light, back from walls and floor
  base::Vec3 to_overhead{0.25, -0.2, 1.0};      // from where it comes, on the whole; any length
  std::vector<Lamp> emergency{};                // lamps that burn where the others are dim
  Eigen::Vector3f window{0.95F, 0.96F, 0.98F};  // colour of the sky in the windows
};

/// Lamps on: all of it. Dim: the emergency lamps alone, and 2 % of the light scattered. Off: daylight alone, which is
/// 1 by day, 0.25 at dusk and 0.004 at night. `Light::sun` carries the overhead light: it comes through the ceiling,
/// which must cast no shadow (Object::casts_shadow), so that what stands in the room casts one.
Light MakeLight(const IndoorLightConfig& config, const RoomLight& room);

/// A ball of kLampRadius above each emergency lamp, so that its light comes from something: lamps that far from a wall
/// touch it.
inline constexpr double kLampRadius = 0.08;  // m
void AddEmergencyLamps(World& world, const RoomLight& room, int material);

}  // namespace alula::worlds

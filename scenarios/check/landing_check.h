#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vehicles/vehicle.h"
#include "worlds/landing_sites.h"
#include "worlds/world.h"

namespace alula::scenarios::check {

/// How a drop is judged: the vehicle, level and with its motors off, falls from `low` to `high` above the highest
/// ground under its hull and must stand after `seconds`.
struct DropConfig {
  double low = 0.02, high = 0.05;  // m
  double seconds = 2.0;
  double tilt_max = 0.26;   // rad, 15°: a slope of 10° and legs that stand on bumps
  double slide_max = 0.03;  // m, level, of the second half of the time
  double speed_max = 0.02;  // m/s, at its end
};

/// What became of one drop.
struct Drop {
  base::Vec2 at{0.0, 0.0};  // m
  bool safe = false;        // as the mask says
  double tilt = 0.0;        // rad, at the end
  double slide = 0.0;       // m
  double speed = 0.0;       // m/s
  std::string touched;      // "part on object": of a part that must not touch; empty: only legs did
  bool stood = false;
};

struct LandingReport {
  worlds::LandingSites sites;
  std::vector<Drop> drops;  // on safe cells, then on others

  int Count(bool safe) const;
  /// Share of the drops on safe (or other) cells that stood; 1 where there were none.
  double StoodShare(bool safe) const;
};

/// The rectangle that an object covers as seen from above, m.
struct Extent {
  base::Vec2 low{0.0, 0.0}, high{0.0, 0.0};
};
std::vector<Extent> ExtentsOf(const worlds::World& world);

/// Where and how a drop begins.
struct DropStart {
  base::Vec2 p{0.0, 0.0};  // m
  double yaw = 0.0;        // rad
  double above = 0.03;     // m, of the feet over the highest ground under the hull
};
/// Drops the vehicle in Bullet, among the objects (`extents`, one each) that lie within 1.5 m of the place.
Drop DropAt(const worlds::World& world, const std::vector<Extent>& extents, const vehicles::VehicleBody& body,
            const worlds::LandingSites& sites, const DropStart& start, const DropConfig& config = {});

/// Finds the sites with the body's hull as radius, and drops it on `drops` safe cells and on half as many others drawn
/// from stream "check/landing" of the seed.
LandingReport CheckLandingSites(const worlds::World& world, const vehicles::VehicleBody& body, int drops,
                                std::uint64_t seed, const DropConfig& config = {});

/// The least share of safe cells on which it must stand.
inline constexpr double kStoodShareMin = 0.99;
bool Passed(const LandingReport& report);

std::string ToTable(const LandingReport& report);
std::string ToJson(const LandingReport& report, const std::string& world);

/// The mask as the ROS map server reads maps: grid.pgm (254 safe, 0 not; rows from the north) and grid.yaml.
std::string ToPgm(const worlds::LandingSites& sites);
std::string ToMapYaml(const worlds::LandingSites& sites);

}  // namespace alula::scenarios::check

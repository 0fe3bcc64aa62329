#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "worlds/world.h"

namespace alula::worlds {

/// Adds a person: body of tapered solids, hair, clothes and skin drawn from the stream "world/actors/<name>/look".
/// `walk.height` is theirs; PersonHeight draws one (normal, 1.70 ± 0.09 m, held within 1.50–1.95 m).
void AddPerson(World& world, const std::string& name, const Walk& walk, std::uint64_t seed);
double PersonHeight(std::uint64_t seed, const std::string& name);

/// A disc on the ground that nobody's route enters.
struct KeptFree {
  base::Vec2 centre{0.0, 0.0};
  double radius = 1.0;  // m
};

/// People on seeded routes.
struct CrowdConfig {
  int count = 3;
  double speed = 1.2;          // m/s, mean of the wished speeds; each differs by 15 % (1σ)
  bool reactive = true;        // to the vehicle
  base::Vec2 low{-5.0, -5.0};  // where they walk, m
  base::Vec2 high{5.0, 5.0};
  double room = 0.5;                            // m, from the middle of a person to anything that stands
  std::vector<KeptFree> free{};                 // a landing pad
  std::shared_ptr<const HeightField> ground{};  // null: z = 0
};

/// Adds "<name>0", "<name>1", …, each on a route of straight lines between free places of the world as it stands:
/// call it when everything else is there. Nobody begins within 1 m of another. Stream "world/actors/<name>".
/// Throws base::InputError ("<name>: …") where there is no room for them.
void AddCrowd(World& world, const std::string& name, const CrowdConfig& config, std::uint64_t seed);

}  // namespace alula::worlds

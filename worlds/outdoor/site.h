#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "worlds/kit/land.h"
#include "worlds/kit/vegetation.h"
#include "worlds/weather.h"

namespace alula::worlds {

/// Ground that is taken: discs that keep clear of one another.
class Plot {
 public:
  /// Places are looked for within ±`half`.
  explicit Plot(const base::Vec2& half) : half_(half) {}
  void Take(const base::Vec2& p, double radius) { taken_.push_back({p, radius}); }
  bool IsFree(const base::Vec2& p, double radius) const;
  /// A free place where `allowed` (may be empty) holds, taken at once; none after `tries` draws.
  std::optional<base::Vec2> Place(double radius, base::RandomStream& random,
                                  const std::function<bool(const base::Vec2&)>& allowed = {}, int tries = 60);

 private:
  struct Disc {
    base::Vec2 p;
    double radius;
  };
  base::Vec2 half_;
  std::vector<Disc> taken_;
};

/// Looks of open ground, in the colours of the real thing.
Surface AddLitterGround(World& world, std::uint64_t seed);
Surface AddGrassGround(World& world, std::uint64_t seed, double contrast = 0.16);
/// Grass from afar, for the land around: larger periods, less contrast.
Surface AddMeadow(World& world, std::uint64_t seed);
Surface AddPavedGround(World& world, std::uint64_t seed);
int AddPadMaterial(World& world, std::uint64_t seed);

/// Trees of a wood: a few models, of one kind each, that all of them share.
struct Wood {
  std::vector<TreeModel> models;
  std::vector<PlantLooks> looks;  // one a model
};
Wood MakeWood(World& world, double height_min, double height_max, int broadleaf, int conifer, std::uint64_t seed);
/// Plants "<name>" of a model drawn from the wood; gives the radius of its stem.
double PlantFrom(World& world, const Wood& wood, const Land& land, const std::string& name, const base::Vec2& p,
                 base::RandomStream& random);

struct RubbleConfig {
  int boulders = 6;
  double size_min = 0.25, size_max = 0.7;  // m, half axes
  int logs = 0;
  int stumps = 0;
};
/// Stones (half sunk), fallen logs and stumps: "boulder<i>", "log<i>", "stump<i>".
void AddRubble(World& world, const Land& land, Plot& plot, const RubbleConfig& config, int bark, std::uint64_t seed,
               const std::function<bool(const base::Vec2&)>& allowed = {});

/// Shrubs "shrub<i>" where there is room.
void AddShrubs(World& world, const Land& land, Plot& plot, int count, double reach_min, double reach_max,
               std::uint64_t seed, const std::function<bool(const base::Vec2&)>& allowed = {});

/// Tufts of grass and weeds, merged by 12 m squares: "tufts/…". Seen, not hit.
void AddTufts(World& world, const Land& land, int count, double height, std::uint64_t seed,
              const std::function<bool(const base::Vec2&)>& allowed = {});

/// Light, wind and bounds: the field's rectangle up to `top` m above the start.
void FinishWorld(World& world, const Land& land, const WeatherConfig& weather, double top, std::uint64_t seed);

}  // namespace alula::worlds

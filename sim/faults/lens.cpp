#include "sim/faults/lens.h"

#include <fmt/format.h>

#include "base/error.h"

namespace alula::sim::faults {
namespace {

class DirtyLens : public Fault {
 public:
  DirtyLens(std::vector<Sensor> sensors, const render::Dirt& dirt) : sensors_(std::move(sensors)), dirt_(dirt) {}
  std::string Words() const override {
    return fmt::format("{}: {:.4g} of the picture is obscured, {:.4g} smudged", NamesOf(sensors_), dirt_.obscured,
                       dirt_.smudged);
  }
  void Impair(Impairments& impairments) const override {
    for (const Sensor& sensor : sensors_) {
      const auto [dirt, first] = impairments.dirt.try_emplace(sensor.id, dirt_);
      if (!first) dirt->second = render::Together(dirt->second, dirt_);
    }
  }

 private:
  std::vector<Sensor> sensors_;
  render::Dirt dirt_;
};

}  // namespace

void Describe(base::Description& d, Lens& c) {
  DescribeTiming(d, c);
  DescribeSensors(d, c.sensor);
  Describe(d, c.dirt);
  d.Check("obscured", [&c] {
    return c.dirt.obscured > 0.0 || c.dirt.smudged > 0.0 ? "" : "nothing lies on the lens; give obscured or smudged";
  });
}

std::unique_ptr<Fault> Make(const Lens& config, const Scope& scope, std::uint64_t, const std::string&) {
  std::vector<Sensor> sensors = Choose(config.sensor, scope);
  for (const Sensor& sensor : sensors) {
    if (std::holds_alternative<stack::Image>(sensor.sample)) continue;
    throw base::InputError(config.sensor.origin.where, config.sensor.origin.path,
                           "`" + sensor.name + "` has no lens that could be obscured; name a camera that gives images");
  }
  return std::make_unique<DirtyLens>(std::move(sensors), config.dirt);
}

}  // namespace alula::sim::faults

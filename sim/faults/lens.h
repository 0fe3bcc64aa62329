#pragma once

#include <memory>
#include <string>

#include "sim/faults/sensor_choice.h"
#include "sim/faults/timing.h"

namespace alula::sim::faults {

/// Something on a front lens, besides the dirt that the camera has anyway (render/sensor_effects.h: Dirt).
struct Lens : Timing {
  static constexpr std::string_view kType = "lens";
  SensorChoice sensor;
  render::Dirt dirt;
};
void Describe(base::Description& d, Lens& c);
std::unique_ptr<Fault> Make(const Lens& config, const Scope& scope, std::uint64_t seed, const std::string& name);

}  // namespace alula::sim::faults

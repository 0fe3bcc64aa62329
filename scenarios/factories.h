#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "scenarios/criteria/criterion.h"
#include "scenarios/scenario.h"
#include "stack/interface/calibration.h"
#include "stack/interface/mission.h"
#include "stack/interface/navigation_stack.h"
#include "vehicles/vehicle.h"
#include "worlds/world.h"

namespace alula::scenarios {

/// Makes a stack from what a stack may know.
using StackMaker = std::function<std::unique_ptr<stack::NavigationStack>(
    const stack::Calibration& calibration, const stack::Mission& mission, std::uint64_t seed, int workers)>;

std::shared_ptr<const worlds::World> MakeWorld(const WorldConfig& config, std::uint64_t seed);
std::unique_ptr<vehicles::VehicleModel> MakeVehicle(const VehicleConfig& config, const std::string& name,
                                                    std::uint64_t seed = 1);
/// Null for None. Throws base::InputError where the autopilot does not fit the vehicle.
std::unique_ptr<vehicles::Autopilot> MakeAutopilot(const AutopilotConfig& config, const VehicleConfig& vehicle);
/// Empty for None.
StackMaker MakerOf(const StackConfig& config);
std::unique_ptr<Criterion> MakeCriterion(const CriterionConfig& config);

}  // namespace alula::scenarios

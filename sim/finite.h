#pragma once

#include <string>

#include "stack/interface/navigation_stack.h"
#include "vehicles/vehicle.h"

namespace alula::sim {

bool IsFinite(const vehicles::BodyState& state);

/// Names the first number of a stack's output that is NaN or infinite ("estimate.X_OB"); empty when all are finite.
std::string FirstNonFinite(const stack::StackOutput& output);

}  // namespace alula::sim

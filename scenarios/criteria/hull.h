#pragma once

#include "base/frames.h"
#include "vehicles/vehicle.h"

namespace alula::scenarios {

/// How far the hull (body and propeller discs) reaches from the body origin along a unit direction of the body, m.
double HullReach(const vehicles::VehicleBody& body, const base::Vec3& direction_B);

}  // namespace alula::scenarios

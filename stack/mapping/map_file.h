#pragma once

#include <iosfwd>

#include "stack/mapping/clearance_field.h"

namespace alula::stack::mapping {

/// Writes the known cells as an OctoMap binary tree of the grid's cell size; unknown cells are absent.
void WriteOctoMap(const ClearanceField& field, std::ostream& out);

}  // namespace alula::stack::mapping

#pragma once

#include <string>

#include "scenarios/campaign/case.h"
#include "scenarios/campaign/database.h"

namespace alula::scenarios::campaign {

// Runs of one database are one sample. What is there and what would be flown now must belong together; each of these
// throws base::InputError where they do not.

/// Where another build of Alula flew what is there.
void CheckSameProgram(Database& database, const std::string& scenario);

/// Where the run of this seed was another one than would be flown now.
void CheckSameCase(const Database& database, const Case& now);

/// Both, for a whole plan: some of its runs are looked at.
void CheckSameSweep(Database& database, const CaseMaker& cases);

}  // namespace alula::scenarios::campaign

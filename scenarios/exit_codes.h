#pragma once

namespace alula::scenarios {

/// What the exit codes of all verbs mean; README.md has the table.
constexpr int kExitPassed = 0, kExitFailed = 1, kExitBadInput = 2, kExitFault = 3, kExitUndecided = 4,
              kExitInterrupted = 130;

}  // namespace alula::scenarios

#include "scenarios/campaign/row.h"

namespace alula::scenarios::campaign {

std::string FailureOf(const Verdict& verdict) {
  if (verdict.outcome == Outcome::kPass) return {};
  if (verdict.outcome == Outcome::kFault) return verdict.reason;
  std::string failed;
  for (const Check& check : verdict.checks) {
    if (!check.passed) failed += (failed.empty() ? "" : ", ") + check.name;
  }
  return failed.empty() ? verdict.reason : failed;
}

}  // namespace alula::scenarios::campaign

#include "scenarios/criteria/criterion.h"

#include <utility>

namespace alula::scenarios {

Check AtMost(std::string name, double measured, double limit, std::string unit) {
  return {std::move(name), measured, limit, std::move(unit), measured <= limit, "<="};  // NaN fails
}

Check AtLeast(std::string name, double measured, double limit, std::string unit) {
  return {std::move(name), measured, limit, std::move(unit), measured >= limit, ">="};
}

}  // namespace alula::scenarios

#include "scenarios/campaign/statistics/requirement.h"

#include <cstdlib>
#include <regex>

#include "base/error.h"

namespace alula::scenarios::statistics {
namespace {

[[noreturn]] void Fail(const std::string& text, const std::string& wrong) {
  throw base::InputError("--require " + text + ": " + wrong +
                         "; write 'success >= 0.95 @ 95%' or 'P(METRIC <= LIMIT) >= 0.95 @ 95%'");
}

/// A number of [+-0-9.e], with a percent sign or without.
double Share(const std::string& text) {
  const double value = std::strtod(text.c_str(), nullptr);
  return text.back() == '%' ? value / 100.0 : value;
}

}  // namespace

Requirement ParseRequirement(const std::string& text) {
  static const std::string number = R"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)";
  static const std::regex form(R"(\s*(?:success|P\(\s*([A-Za-z_]\w*)\s*(<=|>=)\s*()" + number + R"()\s*\))\s*>=\s*()" +
                               number + R"(\s*%?)\s*@\s*()" + number + R"(\s*%?)\s*)");
  std::smatch parts;
  if (!std::regex_match(text, parts, form)) Fail(text, "is no requirement that Alula knows");
  Requirement requirement;
  requirement.text = text;
  if (parts[1].matched) {
    requirement.metric = MetricBound{parts[1], parts[2] == "<=", std::strtod(parts[3].str().c_str(), nullptr)};
  }
  requirement.rate = {Share(parts[4]), Share(parts[5])};
  if (!(requirement.rate.at_least > 0.0 && requirement.rate.at_least < 1.0)) {
    Fail(text, "a rate lies between 0 and 1, both excluded");
  }
  if (!(requirement.rate.confidence >= 0.5 && requirement.rate.confidence < 1.0)) {
    Fail(text, "a confidence lies between 50% and 100%, the latter excluded");
  }
  return requirement;
}

}  // namespace alula::scenarios::statistics

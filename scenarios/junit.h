#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scenarios/verdict.h"

namespace alula::scenarios {

/// One test case of a JUnit report.
struct JunitCase {
  std::string suite;  // also its classname
  std::string name;
  Outcome outcome = Outcome::kPass;  // a fault is JUnit's "error"
  std::string reason;                // of a failure or fault, one word
  std::string text;                  // of a failure or fault
  double seconds = 0.0;
};

/// The checks of one run as test cases of a suite that is called as its scenario.
std::vector<JunitCase> JunitCases(const Verdict& verdict, double seconds);

/// A report that CI services show: suites in the order in which they first come.
std::string JunitXml(const std::vector<JunitCase>& cases);

}  // namespace alula::scenarios

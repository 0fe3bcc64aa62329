#include "scenarios/junit.h"

#include <fmt/format.h>

#include <algorithm>

namespace alula::scenarios {
namespace {

/// As text or attribute; characters that XML 1.0 cannot hold become '?'.
std::string Escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (c == '\n') {
      out += "&#10;";
    } else {
      out += code < 0x20 && c != '\t' ? '?' : c;
    }
  }
  return out;
}

std::string CaseXml(const JunitCase& c) {
  const std::string head = fmt::format(R"(    <testcase classname="{}" name="{}" time="{:.3f}")", Escaped(c.suite),
                                       Escaped(c.name), c.seconds);
  if (c.outcome == Outcome::kPass) return head + "/>\n";
  const char* const element = c.outcome == Outcome::kFail ? "failure" : "error";
  return fmt::format("{}>\n      <{} type=\"{}\" message=\"{}\"/>\n    </testcase>\n", head, element, Escaped(c.reason),
                     Escaped(c.text));
}

std::string SuiteXml(const std::string& suite, const std::vector<JunitCase>& cases) {
  std::string body;
  int tests = 0, failures = 0, errors = 0;
  double seconds = 0.0;
  for (const JunitCase& c : cases) {
    if (c.suite != suite) continue;
    ++tests;
    failures += c.outcome == Outcome::kFail;
    errors += c.outcome == Outcome::kFault;
    seconds += c.seconds;
    body += CaseXml(c);
  }
  return fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\">\n{}  </testsuite>\n",
      Escaped(suite), tests, failures, errors, seconds, body);
}

}  // namespace

std::vector<JunitCase> JunitCases(const Verdict& verdict, double seconds) {
  std::vector<JunitCase> cases;
  for (const Check& check : verdict.checks) {
    JunitCase c{verdict.scenario, check.name, check.passed ? Outcome::kPass : Outcome::kFail, verdict.reason, "", 0.0};
    if (!check.passed) {
      c.text = fmt::format("measured {:.6g} {}, wanted {} {:.6g} {} (seed {}, {})", check.measured, check.unit,
                           check.relation, check.limit, check.unit, verdict.seed, verdict.reason);
    }
    if (!check.passed && verdict.outcome == Outcome::kFault) {
      c.outcome = Outcome::kFault;
      if (!verdict.message.empty()) c.text = verdict.message;
    }
    cases.push_back(std::move(c));
  }
  if (!cases.empty()) cases.front().seconds = seconds;
  return cases;
}

std::string JunitXml(const std::vector<JunitCase>& cases) {
  std::vector<std::string> suites;
  for (const JunitCase& c : cases) {
    if (std::find(suites.begin(), suites.end(), c.suite) == suites.end()) suites.push_back(c.suite);
  }
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"alula\">\n";
  for (const std::string& suite : suites) text += SuiteXml(suite, cases);
  return text + "</testsuites>\n";
}

}  // namespace alula::scenarios

#include "scenarios/verdict.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace alula::scenarios {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity: what was never measured is null.
Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

double Value(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

std::string Shown(double value, const std::string& unit) {
  if (!std::isfinite(value)) return "not measured";
  if (unit == "1") return fmt::format("{:.6g}", value);
  return fmt::format("{:.4g} {}", value, unit);
}

}  // namespace

const char* Word(Outcome outcome) {
  switch (outcome) {
    case Outcome::kPass:
      return "pass";
    case Outcome::kFail:
      return "fail";
    case Outcome::kFault:
      return "fault";
  }
  return "fault";
}

Outcome OutcomeOf(std::string_view word) {
  for (const Outcome outcome : {Outcome::kPass, Outcome::kFail}) {
    if (word == Word(outcome)) return outcome;
  }
  return Outcome::kFault;
}

int ExitCode(Outcome outcome) { return outcome == Outcome::kPass ? 0 : outcome == Outcome::kFail ? 1 : 3; }

std::string ToJson(const Verdict& verdict) {
  Json json;
  json["outcome"] = Word(verdict.outcome);
  json["reason"] = verdict.reason;
  if (!verdict.message.empty()) json["message"] = verdict.message;
  json["checks"] = Json::array();
  for (const Check& check : verdict.checks) {
    json["checks"].push_back({{"name", check.name},
                              {"measured", Number(check.measured)},
                              {"relation", check.relation},
                              {"limit", Number(check.limit)},
                              {"unit", check.unit},
                              {"passed", check.passed}});
  }
  json["metrics"] = Json::object();
  for (const auto& [name, value] : verdict.metrics) json["metrics"][name] = Number(value);
  json["digest"] = verdict.digest;
  json["digests"] = verdict.digests;
  json["numeric_class"] = verdict.numeric_class;
  json["seed"] = verdict.seed;
  json["scenario"] = verdict.scenario;
  json["versions"] = verdict.versions;
  return json.dump(2) + "\n";
}

Verdict VerdictFromJson(const std::string& text) {
  Verdict verdict;
  try {
    const Json json = Json::parse(text);
    verdict.outcome = OutcomeOf(json.at("outcome").get<std::string>());
    verdict.reason = json.at("reason");
    verdict.message = json.value("message", "");
    for (const Json& check : json.at("checks")) {
      verdict.checks.push_back({.name = check.at("name"),
                                .measured = Value(check.at("measured")),
                                .limit = Value(check.at("limit")),
                                .unit = check.at("unit"),
                                .passed = check.at("passed"),
                                .relation = check.at("relation")});
    }
    for (const auto& [name, value] : json.at("metrics").items()) verdict.metrics[name] = Value(value);
    verdict.digest = json.at("digest");
    verdict.digests = json.at("digests").get<std::map<std::string, std::string>>();
    verdict.numeric_class = json.at("numeric_class");
    verdict.versions = json.at("versions").get<std::map<std::string, std::string>>();
    verdict.seed = json.at("seed");
    verdict.scenario = json.at("scenario");
  } catch (const Json::exception& e) {
    throw base::FaultError("verdict", std::string("this is no verdict: ") + e.what());
  }
  return verdict;
}

std::string ToTable(const Verdict& verdict) {
  std::string text;
  for (const Check& check : verdict.checks) {
    text += fmt::format("  {:<6}{:<22}{:>16}   {} {}\n", check.passed ? "ok" : "FAIL", check.name,
                        Shown(check.measured, check.unit), check.relation, Shown(check.limit, check.unit));
  }
  text += fmt::format("{}: {} ({}), seed {}, digest {}\n", verdict.scenario, Word(verdict.outcome), verdict.reason,
                      verdict.seed, verdict.digest);
  if (!verdict.message.empty()) text += "  " + verdict.message + "\n";
  return text;
}

}  // namespace alula::scenarios

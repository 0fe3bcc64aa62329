#include "scenarios/campaign/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "scenarios/campaign/parameter_effects.h"
#include "scenarios/campaign/statistics/binomial.h"
#include "scenarios/campaign/statistics/quantiles.h"

namespace alula::scenarios::campaign {
namespace {

using statistics::Decision;
using statistics::Interval;
using Json = nlohmann::ordered_json;

constexpr double kConfidence = 0.95;
constexpr double kQuantiles[] = {0.05, 0.5, 0.95};
constexpr std::uint64_t kBootstrapSeed = 1;

std::int64_t CountOf(const std::vector<Row>& rows, Outcome outcome) {
  return std::count_if(rows.begin(), rows.end(), [&](const Row& row) { return row.verdict.outcome == outcome; });
}

struct Success {
  std::int64_t passes = 0, runs = 0;
  Interval interval;
  const char* method = "";
};

/// A sweep that stopped when it had seen enough must not be judged as if its number of runs had been fixed.
Success SuccessOf(const SweepResult& result) {
  Success success{CountOf(result.rows, Outcome::kPass), static_cast<std::int64_t>(result.rows.size()), {}, ""};
  if (result.StoppedEarly()) {
    for (const SweepResult::Decided& decided : result.requirements) {
      if (decided.requirement.metric) continue;
      return {decided.successes, static_cast<std::int64_t>(decided.runs), decided.interval, "confidence sequence"};
    }
  }
  success.interval = statistics::ClopperPearson(success.passes, success.runs, kConfidence);
  success.method = "Clopper-Pearson";
  return success;
}

double Percent(double share) { return 100.0 * share; }

std::map<std::string, std::vector<double>> MetricsOf(const std::vector<Row>& rows) {
  std::map<std::string, std::vector<double>> metrics;
  for (const Row& row : rows) {
    for (const auto& [name, value] : row.verdict.metrics) {
      if (std::isfinite(value)) metrics[name].push_back(value);
    }
  }
  return metrics;
}

const char* Word(Decision decision) {
  switch (decision) {
    case Decision::kConfirmed:
      return "confirmed";
    case Decision::kRejected:
      return "rejected";
    case Decision::kUndecided:
      return "undecided";
  }
  return "undecided";
}

std::string RequirementsText(const SweepResult& result) {
  std::string text;
  for (const SweepResult::Decided& d : result.requirements) {
    text += fmt::format("  {:<10} {}: {} of {} runs, interval {:.1f} to {:.1f} %", Word(d.decision), d.requirement.text,
                        d.successes, d.runs, Percent(d.interval.low), Percent(d.interval.high));
    if (d.decision == Decision::kUndecided) {
      text += fmt::format("; more runs may decide it (without a failure {} do)",
                          statistics::RunsIfAllPass(d.requirement.rate));
    }
    text += "\n";
  }
  return text.empty() ? "" : "requirements\n" + text;
}

std::string FailuresText(const SweepResult& result) {
  std::string text;
  for (const FailureGroup& group : GroupFailures(result.rows)) {
    text += fmt::format("  {:>4} {:<34} seeds {}\n", group.seeds.size(), (group.fault ? "fault: " : "") + group.failure,
                        SeedsText(group.seeds));
    if (!group.message.empty()) text += fmt::format("       {}\n", group.message);
  }
  return text.empty() ? "" : "failures\n" + text;
}

std::string MetricsText(const SweepResult& result) {
  std::string text = fmt::format("metrics{:<23}{:>6}  {:>24}{:>28}{:>28}\n", "", "runs", "5 %", "median", "95 %");
  const auto metrics = MetricsOf(result.rows);
  for (const auto& [name, values] : metrics) {
    text += fmt::format("  {:<28}{:>6}", name, values.size());
    for (const auto& q : statistics::Quantiles(values, kQuantiles, kConfidence, kBootstrapSeed, name)) {
      text += fmt::format("  {:>8.4g} [{:>7.4g}, {:>7.4g}]", q.value, q.interval.low, q.interval.high);
    }
    text += "\n";
  }
  return metrics.empty() ? "" : text;
}

Json IntervalJson(const Interval& interval) { return {interval.low, interval.high}; }

Json MetricsJson(const SweepResult& result) {
  Json json = Json::object();
  for (const auto& [name, values] : MetricsOf(result.rows)) {
    Json one = {{"runs", values.size()}};
    for (const auto& q : statistics::Quantiles(values, kQuantiles, kConfidence, kBootstrapSeed, name)) {
      one[fmt::format("q{:02.0f}", Percent(q.q))] = {{"value", q.value}, {"interval", IntervalJson(q.interval)}};
    }
    json[name] = one;
  }
  return json;
}

}  // namespace

std::vector<FailureGroup> GroupFailures(const std::vector<Row>& rows) {
  std::vector<FailureGroup> groups;
  for (const Row& row : rows) {
    const Verdict& v = row.verdict;
    if (v.outcome == Outcome::kPass) continue;
    const std::string failure = FailureOf(v);
    const bool fault = v.outcome == Outcome::kFault;
    const auto same = [&](const FailureGroup& g) { return g.failure == failure && g.fault == fault; };
    auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end()) group = groups.insert(groups.end(), {failure, fault, v.message, {}});
    group->seeds.push_back(v.seed);
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const FailureGroup& a, const FailureGroup& b) { return a.seeds.size() > b.seeds.size(); });
  return groups;
}

std::string SeedsText(std::vector<std::uint64_t> seeds) {
  std::sort(seeds.begin(), seeds.end());
  std::string text;
  for (std::size_t i = 0; i < seeds.size();) {
    std::size_t end = i + 1;
    while (end < seeds.size() && seeds[end] == seeds[end - 1] + 1) ++end;
    text += text.empty() ? "" : ", ";
    text += end - i < 3 ? fmt::format("{}", seeds[i]) : fmt::format("{}-{}", seeds[i], seeds[end - 1]);
    i = end - i < 3 ? i + 1 : end;
  }
  return text;
}

std::string LastLine(const SweepResult& result) {
  const Success success = SuccessOf(result);
  const std::int64_t failures = CountOf(result.rows, Outcome::kFail), faults = CountOf(result.rows, Outcome::kFault);
  if (success.runs == 0) return fmt::format("{}: no run", result.scenario);
  return fmt::format("{}: {} of {} pass ({:.1f} %, {:.0f} % interval {:.1f} to {:.1f} %, {}), {} fail, {} fault{}",
                     result.scenario, success.passes, success.runs,
                     Percent(static_cast<double>(success.passes) / static_cast<double>(success.runs)),
                     Percent(kConfidence), Percent(success.interval.low), Percent(success.interval.high),
                     success.method, failures, faults, faults == 1 ? "" : "s");
}

std::string ToTable(const SweepResult& result) {
  std::string text =
      MetricsText(result) + EffectsText(EffectsOf(result.rows)) + FailuresText(result) + RequirementsText(result);
  if (!result.note.empty()) text += "note: " + result.note + "\n";
  text += LastLine(result) + "\n";
  text += fmt::format("  {} runs flown now in {:.1f} s, {} at a time; results in {}\n", result.flown, result.wall_s,
                      result.jobs, result.database.string());
  return text;
}

std::string ToJson(const SweepResult& result) {
  const Success success = SuccessOf(result);
  Json json;
  json["scenario"] = result.scenario;
  json["database"] = result.database.string();
  json["planned"] = result.planned;
  json["runs"] = result.rows.size();
  for (const Outcome outcome : {Outcome::kPass, Outcome::kFail, Outcome::kFault}) {
    json[scenarios::Word(outcome)] = CountOf(result.rows, outcome);
  }
  json["success"] = {{"passes", success.passes},
                     {"runs", success.runs},
                     {"interval", IntervalJson(success.interval)},
                     {"confidence", kConfidence},
                     {"method", success.method}};
  json["requirements"] = Json::array();
  for (const SweepResult::Decided& d : result.requirements) {
    json["requirements"].push_back({{"text", d.requirement.text},
                                    {"decision", Word(d.decision)},
                                    {"successes", d.successes},
                                    {"runs", d.runs},
                                    {"interval", IntervalJson(d.interval)}});
  }
  json["failures"] = Json::array();
  for (const FailureGroup& group : GroupFailures(result.rows)) {
    json["failures"].push_back(
        {{"failure", group.failure}, {"fault", group.fault}, {"message", group.message}, {"seeds", group.seeds}});
  }
  json["effects"] = EffectsJson(EffectsOf(result.rows));
  json["metrics"] = MetricsJson(result);
  json["note"] = result.note;
  json["interrupted"] = result.interrupted;
  json["flown"] = result.flown;
  json["jobs"] = result.jobs;
  json["wall_s"] = result.wall_s;
  return json.dump(2) + "\n";
}

std::string LastLine(const FailureSweepResult& result) {
  const search::FailureEstimate& e = result.estimate;
  if (!e.found) {
    return fmt::format("{}: no failure in the last sample; their probability is below {:.2g} (95 %), from {} runs",
                       result.sweep.scenario, e.interval.high, e.runs);
  }
  return fmt::format("{}: probability of failure {:.3g} (95 % interval {:.2g} to {:.2g}) from {} runs",
                     result.sweep.scenario, e.probability, e.interval.low, e.interval.high, e.runs);
}

std::string ToTable(const FailureSweepResult& result) {
  const search::FailureEstimate& e = result.estimate;
  std::string text;
  for (const FailureSweepResult::Region& region : result.regions) {
    text += fmt::format("{:.0f} % of the failures lie about\n", Percent(region.share));
    for (const FailureSweepResult::Range& range : region.parameters) {
      text += fmt::format("  {:<30} {:>22}   ({} to {})\n", range.path, range.middle, range.low, range.high);
    }
  }
  if (e.found) {
    text += fmt::format(
        "{} levels, then {} runs of which {} failed (worth {:.0f}); plain sampling would take {:.2g} runs\n", e.levels,
        e.final_runs, e.failures, e.effective_sample_size, e.plain_runs);
  }
  if (!e.warning.empty()) text += "warning: " + e.warning + "\n";
  text += LastLine(result) + "\n";
  return text + fmt::format("  {} runs flown now in {:.1f} s, {} at a time; results in {}\n", result.sweep.flown,
                            result.sweep.wall_s, result.sweep.jobs, result.sweep.database.string());
}

std::string ToJson(const FailureSweepResult& result) {
  const search::FailureEstimate& e = result.estimate;
  Json json = {{"scenario", result.sweep.scenario},
               {"database", result.sweep.database.string()},
               {"found", e.found},
               {"probability", e.probability},
               {"standard_error", e.standard_error},
               {"interval", IntervalJson(e.interval)},
               {"runs", e.runs},
               {"levels", e.levels},
               {"final_runs", e.final_runs},
               {"failures", e.failures},
               {"effective_sample_size", e.effective_sample_size},
               {"plain_runs", e.plain_runs},
               {"trusted", e.trusted},
               {"bound_from", e.bound_from},
               {"warning", e.warning}};
  json["regions"] = Json::array();
  for (const FailureSweepResult::Region& region : result.regions) {
    Json parameters = Json::object();
    for (const FailureSweepResult::Range& range : region.parameters) {
      parameters[range.path] = {{"low", range.low}, {"middle", range.middle}, {"high", range.high}};
    }
    json["regions"].push_back({{"share", region.share}, {"parameters", parameters}});
  }
  return json.dump(2) + "\n";
}

std::vector<JunitCase> JunitCases(const SweepResult& result) {
  std::vector<JunitCase> cases;
  for (const Row& row : result.rows) {
    const Verdict& v = row.verdict;
    JunitCase c{result.scenario, fmt::format("seed {}", v.seed), v.outcome, FailureOf(v), v.message, row.wall_s};
    if (c.outcome == Outcome::kFail) c.text = fmt::format("{} (the run ended by {})", FailureOf(v), v.reason);
    cases.push_back(std::move(c));
  }
  for (const SweepResult::Decided& d : result.requirements) {
    const Outcome outcome = d.decision == Decision::kConfirmed ? Outcome::kPass : Outcome::kFail;
    cases.push_back({result.scenario, d.requirement.text, outcome, Word(d.decision),
                     fmt::format("{} of {} runs", d.successes, d.runs), 0.0});
  }
  return cases;
}

}  // namespace alula::scenarios::campaign

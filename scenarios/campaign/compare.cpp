#include "scenarios/campaign/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "scenarios/campaign/database.h"
#include "scenarios/campaign/report.h"
#include "scenarios/campaign/statistics/quantiles.h"

namespace alula::scenarios::campaign {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kConfidence = 0.95;

/// JSON has no infinity: an interval of too few pairs has no ends.
Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::map<std::uint64_t, Row> BySeed(const std::filesystem::path& file) {
  std::map<std::uint64_t, Row> rows;
  for (Row& row : Database(file, Database::Mode::kRead).Rows()) {
    const std::uint64_t seed = row.verdict.seed;
    rows.emplace(seed, std::move(row));
  }
  return rows;
}

/// A metric's values in both runs of each pair that has both.
struct Values {
  std::vector<double> a, b;
};

Comparison::Metric TestMetric(const std::string& name, Values values) {
  Comparison::Metric metric{.name = name, .test = statistics::WilcoxonSignedRank(values.a, values.b, kConfidence)};
  for (std::vector<double>* side : {&values.a, &values.b}) std::sort(side->begin(), side->end());
  metric.median_a = statistics::QuantileOfSorted(values.a, 0.5);
  metric.median_b = statistics::QuantileOfSorted(values.b, 0.5);
  return metric;
}

std::string SuccessText(const Comparison& c) {
  std::string text =
      fmt::format("{} pairs of equal seeds; A passes {}, B passes {}\n", c.pairs, c.passes_a, c.passes_b);
  const auto side = [](const char* name, const std::vector<std::uint64_t>& seeds) {
    return seeds.empty() ? "" : fmt::format("  only {} passes: seeds {}\n", name, SeedsText(seeds));
  };
  text += side("A", c.only_a_passes) + side("B", c.only_b_passes);
  text += fmt::format("  McNemar: p {:.3g}\n", c.success.p);
  if (c.equal_digests > 0) text += fmt::format("  {} pairs are the same run to the bit\n", c.equal_digests);
  return text;
}

}  // namespace

Comparison CompareSweeps(const std::filesystem::path& a, const std::filesystem::path& b) {
  Comparison comparison;
  comparison.a = a.string();
  comparison.b = b.string();
  const std::map<std::uint64_t, Row> rows_a = BySeed(a), rows_b = BySeed(b);
  std::map<std::string, Values> metrics;
  for (const auto& [seed, row_a] : rows_a) {
    const auto found = rows_b.find(seed);
    if (found == rows_b.end()) continue;
    const Verdict &va = row_a.verdict, &vb = found->second.verdict;
    ++comparison.pairs;
    const bool pass_a = va.outcome == Outcome::kPass, pass_b = vb.outcome == Outcome::kPass;
    comparison.passes_a += pass_a;
    comparison.passes_b += pass_b;
    if (pass_a && !pass_b) comparison.only_a_passes.push_back(seed);
    if (pass_b && !pass_a) comparison.only_b_passes.push_back(seed);
    comparison.equal_digests += !va.digest.empty() && va.digest == vb.digest;
    for (const auto& [name, value] : va.metrics) {
      const auto other = vb.metrics.find(name);
      if (other == vb.metrics.end() || !std::isfinite(value) || !std::isfinite(other->second)) continue;
      Values& values = metrics[name];
      values.a.push_back(value);
      values.b.push_back(other->second);
    }
  }
  if (comparison.pairs == 0) throw base::InputError("--compare: the two sweeps have no seed in common");
  comparison.only_a = rows_a.size() - comparison.pairs;
  comparison.only_b = rows_b.size() - comparison.pairs;
  comparison.success = statistics::McNemar(static_cast<std::int64_t>(comparison.only_a_passes.size()),
                                           static_cast<std::int64_t>(comparison.only_b_passes.size()));
  for (auto& [name, values] : metrics) comparison.metrics.push_back(TestMetric(name, std::move(values)));
  return comparison;
}

std::string ToTable(const Comparison& c) {
  std::string text = fmt::format("A {}\nB {}\n", c.a, c.b);
  text += fmt::format("{:<30}{:>12}{:>12}{:>12}  {:>26}{:>10}\n", "metric", "median A", "median B", "B - A",
                      "95 % interval of B - A", "p");
  for (const Comparison::Metric& m : c.metrics) {
    text += fmt::format("{:<30}{:>12.4g}{:>12.4g}{:>12.4g}  {:>26}{:>10.2g}\n", m.name, m.median_a, m.median_b,
                        m.test.median_difference,
                        fmt::format("[{:.4g}, {:.4g}]", m.test.interval.low, m.test.interval.high), m.test.p);
  }
  text += "(Wilcoxon's signed ranks; p is not corrected for the number of metrics)\n";
  if (c.only_a + c.only_b > 0) {
    text += fmt::format("{} runs of A and {} of B have no partner and are left out\n", c.only_a, c.only_b);
  }
  return text + SuccessText(c);
}

std::string ToJson(const Comparison& c) {
  Json json = {{"a", c.a},
               {"b", c.b},
               {"pairs", c.pairs},
               {"without_partner", {{"a", c.only_a}, {"b", c.only_b}}},
               {"passes", {{"a", c.passes_a}, {"b", c.passes_b}}},
               {"only_a_passes", c.only_a_passes},
               {"only_b_passes", c.only_b_passes},
               {"mcnemar_p", c.success.p},
               {"equal_digests", c.equal_digests}};
  json["metrics"] = Json::object();
  for (const Comparison::Metric& m : c.metrics) {
    json["metrics"][m.name] = {{"median_a", m.median_a},
                               {"median_b", m.median_b},
                               {"difference", m.test.median_difference},
                               {"interval", {Number(m.test.interval.low), Number(m.test.interval.high)}},
                               {"p", m.test.p},
                               {"exact", m.test.exact}};
  }
  return json.dump(2) + "\n";
}

}  // namespace alula::scenarios::campaign

#include "scenarios/campaign/parameter_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <variant>

namespace alula::scenarios::campaign {
namespace {

using statistics::Effect;
using statistics::ParameterColumn;
using Json = nlohmann::ordered_json;

constexpr double kToShow = 0.05;        // corrected p
constexpr std::size_t kMostWords = 12;  // a row of a table

/// A column of numbers where every run has one; choices have words.
ParameterColumn ColumnOf(const std::string& name, const std::vector<Row>& rows) {
  const bool numbers = std::all_of(rows.begin(), rows.end(), [&](const Row& row) {
    const auto found = row.parameters.find(name);
    return found != row.parameters.end() && found->second.kind != "choice" && std::isfinite(found->second.number);
  });
  std::vector<double> values;
  std::vector<std::string> words;
  for (const Row& row : rows) {
    const auto found = row.parameters.find(name);
    if (numbers) {
      values.push_back(found->second.number);
    } else {
      words.push_back(found == row.parameters.end() ? "absent" : found->second.value);
    }
  }
  if (numbers) return {name, std::move(values)};
  return {name, std::move(words)};
}

std::string DetailText(const statistics::NumericEffect& effect) {
  const statistics::Split& s = effect.split;
  return fmt::format(" below {:.5g} {:.0f} % of {} fail, above {:.0f} % of {}", s.threshold,
                     100.0 * s.failure_rate_below, s.runs_below, 100.0 * s.failure_rate_above, s.runs_above);
}
std::string DetailText(const std::vector<statistics::WordRate>& words) {
  std::string text;
  for (std::size_t i = 0; i < std::min(words.size(), kMostWords); ++i) {
    text += fmt::format("{} {}: {:.0f} % of {} fail", i == 0 ? "" : ",", words[i].word, 100.0 * words[i].failure_rate,
                        words[i].runs);
  }
  return text;
}

Json DetailJson(const statistics::NumericEffect& effect) {
  const statistics::Split& s = effect.split;
  return {{"auc", effect.auc},          {"threshold", s.threshold},
          {"runs_below", s.runs_below}, {"failure_rate_below", s.failure_rate_below},
          {"runs_above", s.runs_above}, {"failure_rate_above", s.failure_rate_above}};
}
Json DetailJson(const std::vector<statistics::WordRate>& words) {
  Json json = Json::array();
  for (const statistics::WordRate& word : words) {
    json.push_back({{"word", word.word}, {"runs", word.runs}, {"failure_rate", word.failure_rate}});
  }
  return {{"words", json}};
}

}  // namespace

std::vector<Effect> EffectsOf(const std::vector<Row>& rows) {
  std::set<std::string> names;
  std::vector<bool> failed;
  for (const Row& row : rows) {
    for (const auto& [name, drawn] : row.parameters) names.insert(name);
    failed.push_back(row.verdict.outcome != Outcome::kPass);
  }
  std::vector<ParameterColumn> columns;
  for (const std::string& name : names) columns.push_back(ColumnOf(name, rows));
  return statistics::RankEffects(columns, failed);
}

std::string EffectsText(const std::vector<Effect>& effects) {
  std::string text;
  for (const Effect& effect : effects) {
    if (effect.p_holm > kToShow) break;
    text += fmt::format("  {:<30} p {:.2g}:{}\n", effect.name, effect.p_holm,
                        std::visit([](const auto& detail) { return DetailText(detail); }, effect.detail));
  }
  return text.empty() ? "" : "parameters that separate failures (p corrected for their number)\n" + text;
}

Json EffectsJson(const std::vector<Effect>& effects) {
  Json json = Json::array();
  for (const Effect& effect : effects) {
    Json one = {{"parameter", effect.name}, {"p", effect.p}, {"p_holm", effect.p_holm}};
    one.update(std::visit([](const auto& detail) { return DetailJson(detail); }, effect.detail));
    json.push_back(std::move(one));
  }
  return json;
}

}  // namespace alula::scenarios::campaign

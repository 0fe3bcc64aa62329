#include "scenarios/campaign/parameter_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

namespace alula::scenarios::campaign {
namespace {

using statistics::Column;
using statistics::Effect;
using Json = nlohmann::ordered_json;

constexpr double kToShow = 0.05;        // corrected p
constexpr std::size_t kMostWords = 12;  // a row of a table

/// A column of numbers where every run has one; choices have words.
Column ColumnOf(const std::string& name, const std::vector<Row>& rows) {
  Column column;
  column.name = name;
  const bool numbers = std::all_of(rows.begin(), rows.end(), [&](const Row& row) {
    const auto found = row.parameters.find(name);
    return found != row.parameters.end() && found->second.kind != "choice" && std::isfinite(found->second.number);
  });
  for (const Row& row : rows) {
    const auto found = row.parameters.find(name);
    if (numbers) {
      column.numbers.push_back(found->second.number);
    } else {
      column.words.push_back(found == row.parameters.end() ? "absent" : found->second.value);
    }
  }
  return column;
}

}  // namespace

std::vector<Effect> EffectsOf(const std::vector<Row>& rows) {
  std::set<std::string> names;
  std::vector<bool> failed;
  for (const Row& row : rows) {
    for (const auto& [name, drawn] : row.parameters) names.insert(name);
    failed.push_back(row.verdict.outcome != Outcome::kPass);
  }
  std::vector<Column> columns;
  for (const std::string& name : names) columns.push_back(ColumnOf(name, rows));
  return statistics::RankEffects(columns, failed);
}

std::string EffectsText(const std::vector<Effect>& effects) {
  std::string text;
  for (const Effect& effect : effects) {
    if (effect.p_holm > kToShow) break;
    text += fmt::format("  {:<30} p {:.2g}:", effect.name, effect.p_holm);
    for (std::size_t i = 0; i < std::min(effect.shares.size(), kMostWords); ++i) {
      const statistics::Share& share = effect.shares[i];
      text += fmt::format("{} {}: {} of {} fail", i == 0 ? "" : ",", share.label, share.failures, share.runs);
    }
    text += "\n";
  }
  return text.empty() ? "" : "parameters that separate failures (p corrected for their number)\n" + text;
}

Json EffectsJson(const std::vector<Effect>& effects) {
  Json json = Json::array();
  for (const Effect& effect : effects) {
    Json shares = Json::array();
    for (const statistics::Share& share : effect.shares) {
      shares.push_back({{"label", share.label}, {"failures", share.failures}, {"runs", share.runs}});
    }
    json.push_back({{"parameter", effect.name},
                    {"auc", effect.auc},
                    {"p", effect.p},
                    {"p_holm", effect.p_holm},
                    {"shares", shares}});
  }
  return json;
}

}  // namespace alula::scenarios::campaign

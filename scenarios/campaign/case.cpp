#include "scenarios/campaign/case.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "scenarios/campaign/statistics/orders.h"
#include "scenarios/scenario.h"

namespace alula::scenarios::campaign {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kOrders[] = {"random", "lhs", "sobol"};
constexpr std::uint64_t kOrderSeed = 1;  // the sampling orders are the same in every sweep

/// A value of a grid or list as a parameter; its number is what it begins with, where it begins with one.
base::Drawn Given(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return {"given", text, end == text.c_str() ? std::numeric_limits<double>::quiet_NaN() : number};
}

/// Splits at commas outside brackets and quotes.
std::vector<std::string> SplitValues(const std::string& text) {
  std::vector<std::string> values(1);
  int depth = 0;
  char quote = '\0';
  for (const char c : text) {
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',' && depth == 0) {
      values.emplace_back();
      continue;
    }
    values.back() += c;
  }
  for (std::string& value : values) {
    const std::size_t first = value.find_first_not_of(" \t\r");
    value = first == std::string::npos ? "" : value.substr(first, value.find_last_not_of(" \t\r") - first + 1);
  }
  return values;
}

std::uint64_t ParseSeed(const std::string& text, const std::string& all) {
  const bool digits = !text.empty() && text.size() <= 18 && text.find_first_not_of("0123456789") == std::string::npos;
  if (!digits) {
    throw base::InputError("--seeds " + all + ": `" + text + "` is no seed; write 501-560 or 1-40,77");
  }
  return std::strtoull(text.c_str(), nullptr, 10);
}

}  // namespace

std::size_t SweepPlan::Variants() const {
  if (!list_rows.empty()) return list_rows.size();
  std::size_t variants = 1;
  for (const GridAxis& axis : grid) variants *= axis.values.size();
  return variants;
}

CaseMaker::CaseMaker(SweepPlan plan) : plan_(std::move(plan)) {
  const std::filesystem::path file = plan_.scenario;
  name_ = file.stem().string();
  std::vector<base::Override> overrides = plan_.overrides;
  for (const base::Override& given : VariantOf(0)) overrides.push_back(given);
  base::YamlDocument document = LoadScenarioDocument(file, overrides);
  base::Draws draws;
  ResolveScenario(document, name_, plan_.seeds.front(), &draws);
  for (const auto& [path, drawn] : draws.drawn) distributions_.push_back(path);
  if (plan_.Variants() == 1) document_ = std::move(document);
  if (plan_.order != Order::kRandom && distributions_.empty()) {
    throw base::InputError("--order: nothing in " + name_ +
                           " is a distribution; give one, as --set 'vehicle.mass={uniform: [0.7 kg, 0.8 kg]}'");
  }
  const auto runs = static_cast<std::int64_t>(plan_.seeds.size());
  if (plan_.order == Order::kLatinHypercube) {
    points_ = statistics::LatinHypercube(runs, distributions_.size(), kOrderSeed);
  } else if (plan_.order == Order::kSobol) {
    points_ = statistics::SobolPoints(0, runs, distributions_.size(), kOrderSeed);
  }
}

std::vector<base::Override> CaseMaker::VariantOf(std::size_t index) const {
  std::vector<base::Override> given;
  std::size_t variant = index % plan_.Variants();
  for (const GridAxis& axis : plan_.grid) {
    given.push_back({axis.path, axis.values[variant % axis.values.size()]});
    variant /= axis.values.size();
  }
  for (std::size_t i = 0; i < plan_.list_keys.size(); ++i) {
    given.push_back({plan_.list_keys[i], plan_.list_rows[variant][i]});
  }
  return given;
}

Case CaseMaker::Make(std::size_t index, const std::vector<double>* quantiles) const {
  Case made;
  made.index = index;
  made.seed = plan_.seeds[index];
  const std::vector<double>* point = quantiles;
  if (point == nullptr && !points_.empty()) point = &points_[index];
  base::Draws draws;
  if (point != nullptr) {
    draws.quantile = [this, point](const std::string& path) -> std::optional<double> {
      const auto found = std::lower_bound(distributions_.begin(), distributions_.end(), path);
      if (found == distributions_.end() || *found != path) return std::nullopt;
      return (*point)[static_cast<std::size_t>(found - distributions_.begin())];
    };
  }
  const std::vector<base::Override> variant = VariantOf(index);
  if (document_) {
    made.scenario_yaml = base::DumpConfig(ResolveScenario(*document_, name_, made.seed, &draws).config);
  } else {
    std::vector<base::Override> overrides = plan_.overrides;
    overrides.insert(overrides.end(), variant.begin(), variant.end());
    const base::YamlDocument document = LoadScenarioDocument(plan_.scenario, overrides);
    made.scenario_yaml = base::DumpConfig(ResolveScenario(document, name_, made.seed, &draws).config);
  }
  made.parameters = std::move(draws.drawn);
  for (const base::Override& given : variant) {
    if (!made.parameters.contains(given.path)) made.parameters[given.path] = Given(given.value);
  }
  return made;
}

std::string ToJson(const SweepPlan& plan) {
  Json json;
  json["scenario"] = plan.scenario;
  json["overrides"] = Json::array();
  for (const base::Override& given : plan.overrides) json["overrides"].push_back({given.path, given.value});
  json["seeds"] = plan.seeds;
  json["order"] = kOrders[static_cast<int>(plan.order)];
  json["grid"] = Json::array();
  for (const GridAxis& axis : plan.grid) json["grid"].push_back({{"path", axis.path}, {"values", axis.values}});
  json["list_keys"] = plan.list_keys;
  json["list_rows"] = plan.list_rows;
  return json.dump() + "\n";
}

SweepPlan PlanFromJson(const std::string& text) {
  SweepPlan plan;
  try {
    const Json json = Json::parse(text);
    plan.scenario = json.at("scenario");
    for (const Json& given : json.at("overrides")) plan.overrides.push_back({given.at(0), given.at(1)});
    plan.seeds = json.at("seeds").get<std::vector<std::uint64_t>>();
    plan.order = ParseOrder(json.at("order"));
    for (const Json& axis : json.at("grid")) {
      plan.grid.push_back({axis.at("path"), axis.at("values").get<std::vector<std::string>>()});
    }
    plan.list_keys = json.at("list_keys").get<std::vector<std::string>>();
    plan.list_rows = json.at("list_rows").get<std::vector<std::vector<std::string>>>();
  } catch (const Json::exception& e) {
    throw base::InputError(std::string("plan.json: this is no plan of a sweep: ") + e.what());
  }
  return plan;
}

Order ParseOrder(const std::string& word) {
  const auto* const found = std::find(std::begin(kOrders), std::end(kOrders), word);
  if (found == std::end(kOrders)) throw base::InputError("--order " + word + ": choose random, lhs or sobol");
  return static_cast<Order>(found - std::begin(kOrders));
}

std::vector<std::uint64_t> ParseSeeds(const std::string& text) {
  constexpr std::uint64_t kMost = 100'000'000;
  std::vector<std::uint64_t> seeds;
  for (const std::string& part : SplitValues(text)) {
    const std::size_t dash = part.find('-');
    const std::uint64_t first = ParseSeed(part.substr(0, dash), text);
    const std::uint64_t last = dash == std::string::npos ? first : ParseSeed(part.substr(dash + 1), text);
    if (last < first || last - first >= kMost) {
      throw base::InputError("--seeds " + text + ": `" + part + "` is no range; the lower seed comes first");
    }
    for (std::uint64_t seed = first; seed <= last; ++seed) seeds.push_back(seed);
  }
  std::vector<std::uint64_t> sorted = seeds;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) {
    throw base::InputError("--seeds " + text + ": " + std::to_string(*twice) + " is named twice");
  }
  return seeds;
}

GridAxis ParseGrid(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string wrong = "--grid " + text + ": must be path.to.key=value,value,…";
  if (equals == std::string::npos || equals == 0) throw base::InputError(wrong);
  GridAxis axis{text.substr(0, equals), SplitValues(text.substr(equals + 1))};
  for (const std::string& value : axis.values) {
    if (value.empty()) throw base::InputError(wrong);
  }
  return axis;
}

void ReadList(const std::string& file, SweepPlan& plan) {
  std::ifstream stream(file);
  if (!stream) throw base::InputError("--list " + file + ": cannot be read");
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.front() == '#') continue;
    std::vector<std::string> values = SplitValues(line);
    if (plan.list_keys.empty()) {
      plan.list_keys = std::move(values);
    } else if (values.size() == plan.list_keys.size()) {
      plan.list_rows.push_back(std::move(values));
    } else {
      throw base::InputError({file, number, 1}, "",
                             "has " + std::to_string(values.size()) + " values; the first line names " +
                                 std::to_string(plan.list_keys.size()) + " keys");
    }
  }
  if (plan.list_rows.empty()) {
    throw base::InputError("--list " + file + ": a first line of keys and at least one line of values are wanted");
  }
}

}  // namespace alula::scenarios::campaign

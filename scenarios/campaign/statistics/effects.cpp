#include "scenarios/campaign/statistics/effects.h"

#include <algorithm>
#include <boost/math/distributions/hypergeometric.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <optional>

namespace alula::scenarios::statistics {
namespace {

std::int64_t CountFailures(const std::vector<bool>& failed) { return std::count(failed.begin(), failed.end(), true); }

/// Fisher's exact test, two-sided: of `runs` with `failures` in all, a part of `part_runs` has `part_failures`.
double Fisher(std::int64_t part_failures, std::int64_t part_runs, std::int64_t failures, std::int64_t runs) {
  const auto u = [](std::int64_t x) { return static_cast<unsigned>(x); };
  const boost::math::hypergeometric_distribution<double> chance(u(failures), u(part_runs), u(runs));
  const double seen = boost::math::pdf(chance, u(part_failures));
  const std::int64_t least = std::max<std::int64_t>(0, part_runs + failures - runs);
  const std::int64_t most = std::min(part_runs, failures);
  double p = 0.0;
  for (std::int64_t k = least; k <= most; ++k) {
    const double other = boost::math::pdf(chance, u(k));
    if (other <= seen * (1.0 + 1e-9)) p += other;
  }
  return std::min(1.0, p);
}

std::string Text(const char* word, double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%s %.5g", word, value);
  return text;
}

/// The values in order, with what became of their runs.
std::vector<std::size_t> OrderOf(const std::vector<double>& numbers) {
  std::vector<std::size_t> order(numbers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
  return order;
}

/// Mann and Whitney's test, normal with corrections for ties and continuity.
void Separate(const std::vector<double>& numbers, const std::vector<bool>& failed, Effect& effect) {
  const std::vector<std::size_t> order = OrderOf(numbers);
  const auto n = static_cast<double>(numbers.size());
  const auto f = static_cast<double>(CountFailures(failed)), g = n - f;
  double rank_sum = 0.0, tie_term = 0.0;
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i + 1;
    while (end < order.size() && numbers[order[end]] == numbers[order[i]]) ++end;
    for (std::size_t j = i; j < end; ++j) rank_sum += failed[order[j]] ? 0.5 * static_cast<double>(i + 1 + end) : 0.0;
    const auto tied = static_cast<double>(end - i);
    tie_term += tied * tied * tied - tied;
    i = end;
  }
  const double larger = rank_sum - f * (f + 1.0) / 2.0;  // pairs in which the failed run has the larger value
  effect.auc = larger / (f * g);
  const double sigma = std::sqrt(f * g / 12.0 * (n + 1.0 - tie_term / (n * (n - 1.0))));
  const double z = std::max(0.0, std::abs(larger - 0.5 * f * g) - 0.5) / sigma;
  effect.p = 2.0 * boost::math::cdf(boost::math::complement(boost::math::normal(), z));
}

/// The threshold at which the failure rates of both sides differ most, by information gained (as trees split).
void Split(const std::vector<double>& numbers, const std::vector<bool>& failed, Effect& effect) {
  const std::vector<std::size_t> order = OrderOf(numbers);
  const auto entropy = [](std::int64_t failures, std::int64_t runs) {
    if (failures == 0 || failures == runs) return 0.0;
    const double share = static_cast<double>(failures) / static_cast<double>(runs);
    return -static_cast<double>(runs) * (share * std::log(share) + (1.0 - share) * std::log1p(-share));
  };
  const auto runs = static_cast<std::int64_t>(order.size());
  const std::int64_t failures = CountFailures(failed);
  std::int64_t below = 0;
  double best = entropy(failures, runs);
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    below += failed[order[i]];
    if (numbers[order[i]] == numbers[order[i + 1]]) continue;
    const auto count = static_cast<std::int64_t>(i + 1);
    const double left = entropy(below, count) + entropy(failures - below, runs - count);
    if (left >= best) continue;
    best = left;
    const double threshold = 0.5 * (numbers[order[i]] + numbers[order[i + 1]]);
    effect.shares = {{Text("below", threshold), below, count},
                     {Text("above", threshold), failures - below, runs - count}};
  }
}

Effect OfNumbers(const Column& column, const std::vector<bool>& failed) {
  Effect effect;
  effect.name = column.name;
  Separate(column.numbers, failed, effect);
  Split(column.numbers, failed, effect);
  return effect;
}

Effect OfWords(const Column& column, const std::vector<bool>& failed) {
  Effect effect;
  effect.name = column.name;
  std::map<std::string, Share> shares;
  for (std::size_t i = 0; i < column.words.size(); ++i) {
    Share& share = shares[column.words[i]];
    share.label = column.words[i];
    ++share.runs;
    share.failures += failed[i];
  }
  const auto runs = static_cast<std::int64_t>(failed.size());
  const std::int64_t failures = CountFailures(failed);
  for (const auto& [word, share] : shares) {
    effect.p = std::min(effect.p, Fisher(share.failures, share.runs, failures, runs));
    effect.shares.push_back(share);
  }
  effect.p = std::min(1.0, effect.p * static_cast<double>(shares.size()));
  const auto rate = [](const Share& s) { return static_cast<double>(s.failures) / static_cast<double>(s.runs); };
  std::stable_sort(effect.shares.begin(), effect.shares.end(),
                   [&](const Share& a, const Share& b) { return rate(a) > rate(b); });
  return effect;
}

/// Nothing for a column that does not vary.
std::optional<Effect> EffectOf(const Column& column, const std::vector<bool>& failed) {
  const auto varies = [](const auto& values) {
    return std::any_of(values.begin(), values.end(), [&](const auto& value) { return value != values.front(); });
  };
  if (!column.numbers.empty()) {
    return varies(column.numbers) ? std::optional(OfNumbers(column, failed)) : std::nullopt;
  }
  return varies(column.words) ? std::optional(OfWords(column, failed)) : std::nullopt;
}

}  // namespace

std::vector<Effect> RankEffects(const std::vector<Column>& columns, const std::vector<bool>& failed) {
  std::vector<Effect> effects;
  const std::int64_t failures = CountFailures(failed);
  if (failures == 0 || failures == static_cast<std::int64_t>(failed.size())) return effects;
  for (const Column& column : columns) {
    if (std::optional<Effect> effect = EffectOf(column, failed)) effects.push_back(std::move(*effect));
  }
  std::stable_sort(effects.begin(), effects.end(), [](const Effect& a, const Effect& b) { return a.p < b.p; });
  double running = 0.0;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    running = std::max(running, std::min(1.0, effects[i].p * static_cast<double>(effects.size() - i)));
    effects[i].p_holm = running;
  }
  return effects;
}

}  // namespace alula::scenarios::statistics

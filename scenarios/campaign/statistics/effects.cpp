#include "scenarios/campaign/statistics/effects.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <map>
#include <numeric>

#include "base/error.h"
#include "scenarios/campaign/statistics/internal/ranks.h"

namespace alula::scenarios::statistics {

namespace {

constexpr double kMaxExactSteps = 2e7;  // additions of the exact rank-sum distribution: some 20 ms

struct Sample {
  std::vector<double> values;
  std::vector<bool> failed;
  std::size_t failures = 0;
};

Sample FiniteSample(const std::vector<double>& values, const std::vector<bool>& failed) {
  Sample sample;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    sample.values.push_back(values[i]);
    sample.failed.push_back(failed[i]);
    sample.failures += failed[i] ? 1 : 0;
  }
  return sample;
}

/// weights[s]: ways to choose `chosen` of the (doubled) ranks so that they sum to s.
std::vector<double> ChoiceSumCounts(const std::vector<int>& ranks, std::size_t chosen, std::size_t max_sum) {
  std::vector<std::vector<double>> ways(chosen + 1, std::vector<double>(max_sum + 1, 0.0));
  ways[0][0] = 1.0;
  for (const int rank : ranks) {
    const auto step = static_cast<std::size_t>(rank);
    for (std::size_t c = chosen; c > 0; --c) {
      for (std::size_t s = step; s <= max_sum; ++s) ways[c][s] += ways[c - 1][s - step];
    }
  }
  return ways[chosen];
}

double MannWhitneyP(const Ranks& ranks, int twice_rank_sum, std::size_t failures) {
  const auto all = static_cast<double>(ranks.twice_rank.size());
  const auto m = static_cast<double>(failures);
  std::vector<int> largest = ranks.twice_rank;
  std::sort(largest.begin(), largest.end(), std::greater<>());
  const int max_sum = std::accumulate(largest.begin(), largest.begin() + static_cast<std::ptrdiff_t>(failures), 0);
  if (all * m * max_sum <= kMaxExactSteps) {
    return TwoSidedExact(ChoiceSumCounts(ranks.twice_rank, failures, static_cast<std::size_t>(max_sum)),
                         twice_rank_sum);
  }
  const double off = std::abs(twice_rank_sum / 2.0 - m * (all + 1.0) / 2.0) - 0.5;  // 0.5: continuity
  const double variance = m * (all - m) / 12.0 * (all + 1.0 - ranks.ties / (all * (all - 1.0)));
  return off <= 0.0 ? 1.0 : TwoSidedNormal(off / std::sqrt(variance));
}

Split BestSplit(const Sample& sample) {
  std::vector<std::size_t> order(sample.values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return sample.values[a] < sample.values[b]; });
  Split best;
  double best_gap = -1.0, failures_below = 0.0;
  for (std::size_t below = 1; below < order.size(); ++below) {
    failures_below += sample.failed[order[below - 1]] ? 1.0 : 0.0;
    const double left = sample.values[order[below - 1]], right = sample.values[order[below]];
    if (left == right) continue;
    const auto n_below = static_cast<double>(below), n_above = static_cast<double>(order.size() - below);
    const double rate_below = failures_below / n_below;
    const double rate_above = (static_cast<double>(sample.failures) - failures_below) / n_above;
    // The decrease of Gini impurity is this times 2/n².
    const double gap = n_below * n_above * (rate_below - rate_above) * (rate_below - rate_above);
    if (gap <= best_gap) continue;
    best_gap = gap;
    best = {0.5 * left + 0.5 * right, static_cast<std::int64_t>(below), static_cast<std::int64_t>(order.size() - below),
            rate_below, rate_above};
  }
  return best;
}

std::optional<Effect> NumberEffect(const std::vector<double>& values, const std::vector<bool>& failed) {
  const Sample sample = FiniteSample(values, failed);
  if (sample.failures == 0 || sample.failures == sample.values.size()) return std::nullopt;
  const auto [least, most] = std::minmax_element(sample.values.begin(), sample.values.end());
  if (*least == *most) return std::nullopt;
  const Ranks ranks = RankDoubled(sample.values);
  int twice_rank_sum = 0;
  for (std::size_t i = 0; i < sample.values.size(); ++i) twice_rank_sum += sample.failed[i] ? ranks.twice_rank[i] : 0;
  const auto m = static_cast<double>(sample.failures);
  const double passes = static_cast<double>(sample.values.size()) - m;
  const double auc = (twice_rank_sum / 2.0 - m * (m + 1.0) / 2.0) / (m * passes);
  return Effect{"", MannWhitneyP(ranks, twice_rank_sum, sample.failures), 1.0, NumericEffect{auc, BestSplit(sample)}};
}

double LogChoose(double n, double k) { return std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0); }

/// Fisher 1922: all tables with the same margins that are no more likely than this one.
double FisherP(double failed_first, double first, double second, double failures) {
  const auto log_weight = [&](double k) { return LogChoose(first, k) + LogChoose(second, failures - k); };
  constexpr double kSameWeight = 1e-7;  // tables as likely as this one, but for rounding
  const double observed = log_weight(failed_first), all = LogChoose(first + second, failures);
  double p = 0.0;
  for (double k = std::max(0.0, failures - second); k <= std::min(first, failures); ++k) {
    if (log_weight(k) <= observed + kSameWeight) p += std::exp(log_weight(k) - all);
  }
  return std::min(1.0, p);
}

double ChiSquareP(const std::vector<WordRate>& words, double rate) {
  double chi_square = 0.0;
  for (const WordRate& word : words) {
    const double off = word.failure_rate - rate;
    chi_square += static_cast<double>(word.runs) * off * off / (rate * (1.0 - rate));
  }
  return boost::math::gamma_q(static_cast<double>(words.size() - 1) / 2.0, chi_square / 2.0);
}

std::optional<Effect> WordEffect(const std::vector<std::string>& values, const std::vector<bool>& failed) {
  struct Count {
    std::int64_t runs = 0, failures = 0;
  };
  std::map<std::string, Count> counts;
  double failures = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    Count& count = counts[values[i]];
    ++count.runs;
    count.failures += failed[i] ? 1 : 0;
    failures += failed[i] ? 1.0 : 0.0;
  }
  if (counts.size() < 2) return std::nullopt;
  std::vector<WordRate> words;
  for (const auto& [word, count] : counts) {
    words.push_back({word, count.runs, static_cast<double>(count.failures) / static_cast<double>(count.runs)});
  }
  Effect effect;
  if (words.size() == 2) {
    const Count& first = counts.begin()->second;
    effect.p = FisherP(static_cast<double>(first.failures), static_cast<double>(first.runs),
                       static_cast<double>(words[1].runs), failures);
  } else {
    effect.p = ChiSquareP(words, failures / static_cast<double>(values.size()));
  }
  std::stable_sort(words.begin(), words.end(),
                   [](const WordRate& a, const WordRate& b) { return a.failure_rate > b.failure_rate; });
  effect.detail = std::move(words);
  return effect;
}

std::optional<Effect> EffectOf(const ParameterColumn& column, const std::vector<bool>& failed) {
  if (std::visit([](const auto& values) { return values.size(); }, column.values) != failed.size()) {
    throw base::FaultError("column_length", "parameter " + column.name + " has not one value a run");
  }
  const auto* numbers = std::get_if<std::vector<double>>(&column.values);
  std::optional<Effect> effect = numbers != nullptr
                                     ? NumberEffect(*numbers, failed)
                                     : WordEffect(std::get<std::vector<std::string>>(column.values), failed);
  if (effect) effect->name = column.name;
  return effect;
}

}  // namespace

std::vector<Effect> RankEffects(const std::vector<ParameterColumn>& columns, const std::vector<bool>& failed) {
  const auto failures = std::count(failed.begin(), failed.end(), true);
  if (failures == 0 || failures == static_cast<std::ptrdiff_t>(failed.size())) return {};
  std::vector<Effect> effects;
  for (const ParameterColumn& column : columns) {
    if (std::optional<Effect> effect = EffectOf(column, failed)) effects.push_back(*std::move(effect));
  }
  std::sort(effects.begin(), effects.end(),
            [](const Effect& a, const Effect& b) { return a.p != b.p ? a.p < b.p : a.name < b.name; });
  double largest = 0.0;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    largest = std::max(largest, effects[i].p * static_cast<double>(effects.size() - i));
    effects[i].p_holm = std::min(1.0, largest);
  }
  return effects;
}

}  // namespace alula::scenarios::statistics

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace alula::scenarios::statistics {

/// One parameter over the runs of a sweep, in the order of the runs.
struct ParameterColumn {
  std::string name;
  std::variant<std::vector<double>, std::vector<std::string>> values;
};

/// The one threshold that parts failures from passes best (largest decrease of Gini impurity, Breiman et al. 1984).
/// Chosen on the same runs, so that the rates flatter it: the p-value beside it is of the ranks, not of the split.
struct Split {
  double threshold = 0.0;  // halfway between two values seen
  std::int64_t runs_below = 0;
  std::int64_t runs_above = 0;
  double failure_rate_below = 0.0;
  double failure_rate_above = 0.0;
};

struct NumericEffect {
  double auc = 0.5;  // P(value in a failed run > value in a passed one), ties half: 1 when failures lie at large values
  Split split;
};

struct WordRate {
  std::string word;
  std::int64_t runs = 0;
  double failure_rate = 0.0;
};

/// How a parameter separates failed runs from passed ones.
struct Effect {
  std::string name;
  double p = 1.0;       // two-sided, of this parameter alone
  double p_holm = 1.0;  // corrected for the number of parameters looked at (Holm 1979)
  std::variant<NumericEffect, std::vector<WordRate>> detail;  // words: the highest failure rate first
};

/// Parameters that vary, the smallest p first (equal ones by name). Numbers: Mann & Whitney 1947, exact given the ranks
/// while that is quick, else normal with corrections for ties and continuity; runs whose value is not finite are left
/// out of that column. Words: Fisher's exact test for two words, Pearson's chi-square for more. Empty where no run or
/// every run failed. Columns of another length than `failed`: FaultError.
std::vector<Effect> RankEffects(const std::vector<ParameterColumn>& columns, const std::vector<bool>& failed);

}  // namespace alula::scenarios::statistics

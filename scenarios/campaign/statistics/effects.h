#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace alula::scenarios::statistics {

/// One parameter of all runs: numbers, or words where it has none.
struct Column {
  std::string name;
  std::vector<double> numbers;
  std::vector<std::string> words;
};

/// Runs of one side of a split, or with one word.
struct Share {
  std::string label;  // "above 0.76", "throw@1"
  std::int64_t failures = 0;
  std::int64_t runs = 0;
};

/// How well a parameter tells failures from passes.
struct Effect {
  std::string name;
  /// Of numbers: the chance that a failed run has the larger value than a passed one (Mann and Whitney 1947; ties
  /// count half); 0.5 where it says nothing. Of words: not used.
  double auc = 0.5;
  double p = 1.0;       // two-sided; of words by Fisher's exact test of each against the rest, the best, Bonferroni
  double p_holm = 1.0;  // corrected for all parameters that were looked at (Holm 1979)
  std::vector<Share> shares;  // of numbers: below and above the split that separates best
};

/// Effects of all columns that vary, the smallest p first. None where all runs failed, or none did.
std::vector<Effect> RankEffects(const std::vector<Column>& columns, const std::vector<bool>& failed);

}  // namespace alula::scenarios::statistics

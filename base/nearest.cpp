#include "base/nearest.h"

#include <algorithm>
#include <vector>

namespace alula::base {

std::size_t EditDistance(std::string_view a, std::string_view b) {
  // Optimal string alignment with three rows: the swap looks two rows back.
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replace, last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string NearestWord(std::string_view word, std::span<const std::string> candidates) {
  constexpr std::size_t kLongestWord = 64;  // longer ones are no misspelt names
  if (word.size() > kLongestWord) return {};
  std::size_t best = std::max<std::size_t>(2, word.size() / 3) + 1;
  std::string nearest;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = EditDistance(word, candidate);
    if (distance < best && distance < std::max(word.size(), candidate.size())) {
      best = distance;
      nearest = candidate;
    }
  }
  if (!nearest.empty()) return nearest;
  for (const std::string& candidate : candidates) {  // "radius" for "rotor_radius"
    if (word.size() >= 3 && (candidate.find(word) != std::string::npos ||
                             (candidate.size() >= 3 && word.find(candidate) != std::string_view::npos))) {
      return candidate;
    }
  }
  return {};
}

std::string Suggestion(std::string_view word, std::span<const std::string> candidates, std::string_view plural) {
  const std::string nearest = NearestWord(word, candidates);
  if (!nearest.empty()) return "did you mean `" + nearest + "`?";
  if (candidates.empty()) return "there are no " + std::string(plural) + " here";
  std::string text = "known " + std::string(plural) + ": ";
  constexpr std::size_t kShown = 16;
  for (std::size_t i = 0; i < candidates.size() && i < kShown; ++i) text += (i == 0 ? "" : ", ") + candidates[i];
  if (candidates.size() > kShown) text += ", …";
  return text;
}

}  // namespace alula::base

#pragma once

#include <span>
#include <string>
#include <string_view>

namespace alula::base {

/// Number of single-letter insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
std::size_t EditDistance(std::string_view a, std::string_view b);

/// The candidate nearest to `word`, or empty when none is near enough to be what was meant; the first of equals.
std::string NearestWord(std::string_view word, std::span<const std::string> candidates);

/// "did you mean `x`?" where a candidate is near, otherwise "known <plural>: a, b, c".
std::string Suggestion(std::string_view word, std::span<const std::string> candidates, std::string_view plural);

}  // namespace alula::base

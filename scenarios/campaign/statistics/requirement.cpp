#include "scenarios/campaign/statistics/requirement.h"

#include <charconv>
#include <cmath>

#include "base/error.h"

namespace alula::scenarios::statistics {

namespace {

constexpr double kLeastConfidence = 0.5;  // below it the opposite would be the safer bet

bool IsBlank(char c) { return c == ' ' || c == '\t'; }
bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool IsNamePart(char c) { return IsLetter(c) || (c >= '0' && c <= '9') || c == '.' || c == '/' || c == '-'; }

/// Takes a text apart from the left.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text), rest_(text) { SkipBlanks(); }

  [[noreturn]] void Fail(const std::string& message) const {
    throw base::InputError("--require '" + std::string(text_) + "': " + message +
                           "; write 'success >= 0.95 @ 95%' or 'P(ate_online_m <= 0.5) >= 0.95 @ 95%'");
  }

  bool Take(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    Drop(token.size());
    return true;
  }

  void Expect(std::string_view token, const std::string& place) {
    if (!Take(token)) Fail("expected '" + std::string(token) + "' " + place + Found());
  }

  std::string Name() {
    std::size_t size = 0;
    if (!rest_.empty() && IsLetter(rest_.front())) {
      while (size < rest_.size() && IsNamePart(rest_[size])) ++size;
    }
    const std::string name(rest_.substr(0, size));
    Drop(size);
    return name;
  }

  double Number(const std::string& what) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc() || !std::isfinite(value)) Fail(what + " must be a number" + Found());
    Drop(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }

  /// "0.95" or "95%".
  double Share(const std::string& what) {
    const double value = Number(what);
    return Take("%") ? value / 100.0 : value;
  }

  std::string Found() const { return rest_.empty() ? ", found the end" : ", found '" + std::string(rest_) + "'"; }
  bool AtEnd() const { return rest_.empty(); }

 private:
  void SkipBlanks() {
    while (!rest_.empty() && IsBlank(rest_.front())) rest_.remove_prefix(1);
    while (!rest_.empty() && IsBlank(rest_.back())) rest_.remove_suffix(1);
  }
  void Drop(std::size_t size) {
    rest_.remove_prefix(size);
    SkipBlanks();
  }

  std::string_view text_;
  std::string_view rest_;
};

MetricBound ReadMetricBound(Reader& reader) {
  reader.Expect("(", "after P");
  MetricBound bound;
  bound.name = reader.Name();
  if (bound.name.empty()) reader.Fail("expected the name of a metric after 'P('" + reader.Found());
  bound.at_most = reader.Take("<=");
  if (!bound.at_most) reader.Expect(">=", "or '<=' after the metric's name");
  bound.limit = reader.Number("the limit of " + bound.name);
  reader.Expect(")", "after the limit (in the metric's own unit)");
  return bound;
}

}  // namespace

Requirement ParseRequirement(std::string_view text) {
  Reader reader(text);
  Requirement requirement;
  requirement.text = text;
  const std::string subject = reader.Name();
  if (subject == "P") {
    requirement.metric = ReadMetricBound(reader);
  } else if (subject != "success") {
    reader.Fail(subject.empty() ? "expected 'success' or 'P(' at the start" + reader.Found()
                                : "unknown subject '" + subject + "'");
  }
  reader.Expect(">=", "before the rate");
  requirement.rate.at_least = reader.Share("the rate");
  if (!(requirement.rate.at_least > 0.0 && requirement.rate.at_least < 1.0)) {
    reader.Fail("the rate must lie between 0 and 1, both excluded");
  }
  reader.Expect("@", "before the confidence");
  requirement.rate.confidence = reader.Share("the confidence");
  if (!(requirement.rate.confidence >= kLeastConfidence && requirement.rate.confidence < 1.0)) {
    reader.Fail("the confidence must be at least 50% and below 100%");
  }
  if (!reader.AtEnd()) reader.Fail("nothing may follow the confidence" + reader.Found());
  return requirement;
}

}  // namespace alula::scenarios::statistics

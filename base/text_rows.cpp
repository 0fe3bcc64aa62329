#include "base/text_rows.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace alula::base {
namespace {

constexpr std::string_view kBlanks = " \t\r";
/// Stamps beyond ±146 years leave room for differences of any two of them.
constexpr std::int64_t kLargestTime = INT64_MAX / 2;

std::string_view Trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

template <typename Number>
bool Parse(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// The cell for a message, cut where it is long.
std::string Quoted(std::string_view text) {
  constexpr std::size_t kShown = 40;
  return "`" + std::string(text.substr(0, kShown)) + (text.size() > kShown ? "…`" : "`");
}

}  // namespace

TextRow::TextRow(std::string_view line, SourcePosition where)
    : where_(std::move(where)), has_commas_(line.find(',') != std::string_view::npos) {
  if (has_commas_) {
    for (std::size_t begin = 0; begin <= line.size();) {
      const std::size_t end = std::min(line.find(',', begin), line.size());
      cells_.push_back(Trim(line.substr(begin, end - begin)));
      begin = end + 1;
    }
  } else {
    for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
      cells_.push_back(line.substr(begin, end - begin));
      begin = line.find_first_not_of(kBlanks, end);
    }
  }
}

void TextRow::Fail(std::string_view name, const std::string& message) const { throw InputError(where_, name, message); }

std::string_view TextRow::Word(std::size_t i, std::string_view name) const {
  if (i >= cells_.size()) {
    Fail(name, "is missing: the row has " + std::to_string(cells_.size()) + " values and this one is number " +
                   std::to_string(i + 1));
  }
  return cells_[i];
}

double TextRow::Number(std::size_t i, std::string_view name) const {
  const std::string_view text = Word(i, name);
  double value = 0.0;
  if (!Parse(text, value) || !std::isfinite(value)) Fail(name, Quoted(text) + " is not a finite number");
  return value;
}

Time TextRow::TimeInNanoseconds(std::size_t i, std::string_view name) const {
  const std::string_view text = Word(i, name);
  std::int64_t ns = 0;
  if (!Parse(text, ns) || ns < -kLargestTime || ns > kLargestTime) {
    Fail(name, Quoted(text) + " is not a whole number of nanoseconds");
  }
  return {ns};
}

Time TextRow::TimeInSeconds(std::size_t i, std::string_view name) const {
  constexpr std::int64_t kSecond = 1'000'000'000;
  constexpr std::size_t kDigits = 9;
  const std::string_view text = Word(i, name);
  const std::size_t point = text.find('.');
  const std::string_view whole_text = text.substr(0, point);
  std::string fraction_text(point == std::string_view::npos ? std::string_view() : text.substr(point + 1, kDigits));
  fraction_text.resize(kDigits, '0');
  std::int64_t whole = 0, fraction = 0;
  const bool plain = std::all_of(text.begin() + (text.starts_with('-') ? 1 : 0), text.end(),
                                 [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
  if (plain && Parse(whole_text, whole) && Parse(fraction_text, fraction) && std::abs(whole) < kLargestTime / kSecond) {
    return {whole * kSecond + (text.starts_with('-') ? -fraction : fraction)};
  }
  const double seconds = Number(i, name);  // "1.3e9"
  if (!(std::abs(seconds) < static_cast<double>(kLargestTime / kSecond))) Fail(name, Quoted(text) + " is no time");
  return Time{} + Seconds(seconds);
}

void ForEachRow(std::istream& text, const std::string& file_name, const std::function<void(const TextRow&)>& take) {
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    const std::string_view trimmed = Trim(line);
    if (trimmed.empty() || trimmed.starts_with('#')) continue;
    take(TextRow(trimmed, {file_name, number, 0}));
  }
}

std::ifstream OpenText(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::error_code error;
  if (!stream || std::filesystem::is_directory(file, error)) {
    throw InputError({file.string()}, "", "cannot be read; is the name right?");
  }
  return stream;
}

void ForEachRowOf(const std::filesystem::path& file, const std::function<void(const TextRow&)>& take) {
  std::ifstream stream = OpenText(file);
  ForEachRow(stream, file.string(), take);
}

}  // namespace alula::base

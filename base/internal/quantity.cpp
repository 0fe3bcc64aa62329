#include "base/internal/quantity.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/units.h"

namespace alula::base::quantity {

namespace {

std::string_view Trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

Unit DeclaredUnit(std::string_view unit) {
  const std::optional<Unit> parsed = ParseUnit(unit);
  if (!parsed || parsed->numerator != 1.0 || parsed->denominator != 1.0) {
    throw FaultError("bad_description",
                     "a field declares the unit `" + std::string(unit) + "`, which is not in SI terms");
  }
  return *parsed;
}

/// "a mass is wanted, for example `0.75 kg`". People write angles in degrees.
std::string Wanted(std::string_view unit, std::string_view example) {
  const Unit declared = DeclaredUnit(unit);
  std::string text = DimensionName(declared, unit) + " is wanted, for example `" + std::string(example);
  if (unit == "rad") return text + " deg`";
  if (!declared.IsPure()) text += " " + std::string(unit);
  return text + "`";
}

[[noreturn]] void Fail(const std::string& message) { throw InputError(message); }

std::string Quoted(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  return "`" + std::string(text.substr(0, kLongest)) + (text.size() > kLongest ? "…`" : "`");
}

/// The unit behind a number, of the dimension of `wanted`, or an error that says what would be right.
Unit CheckedUnit(std::string_view whole, std::string_view number, std::string_view unit_text, std::string_view wanted) {
  const Unit declared = DeclaredUnit(wanted);
  const std::string_view example = number.size() <= 24 ? number : std::string_view("1");
  if (unit_text.empty() && !declared.IsPure()) Fail(Quoted(whole) + " has no unit; " + Wanted(wanted, example));
  const std::optional<Unit> unit = ParseUnit(unit_text);
  if (!unit) {
    Fail(Quoted(whole) + " has the unknown unit " + Quoted(unit_text) + "; " + Wanted(wanted, example));
  }
  if (!unit->SameDimension(declared)) {
    Fail(Quoted(whole) + " is " + DimensionName(*unit, unit_text) + "; " + Wanted(wanted, example));
  }
  return *unit;
}

/// Splits "0.75 kg" into value, digits and unit.
struct Split {
  double value = 0.0;
  std::string_view number;
  std::string_view unit;
};

Split SplitNumber(std::string_view text, std::string_view wanted) {
  std::string_view rest = Trimmed(text);
  const bool plus = rest.size() > 1 && rest[0] == '+' && rest[1] != '-';
  const std::string_view digits = plus ? rest.substr(1) : rest;
  Split split;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), split.value);
  if (error == std::errc::result_out_of_range) Fail(Quoted(text) + " is too large or too small for a number");
  if (error != std::errc{}) Fail(Quoted(text) + " is not a number; " + Wanted(wanted, "1"));
  split.number = digits.substr(0, static_cast<std::size_t>(end - digits.data()));
  split.unit = Trimmed(digits.substr(split.number.size()));
  return split;
}

template <typename Integer>
Integer ParseWhole(std::string_view text, std::string_view wanted) {
  std::string_view rest = Trimmed(text);
  if (rest.size() > 1 && rest[0] == '+' && rest[1] != '-') rest.remove_prefix(1);
  Integer value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  const std::string_view tail(end, static_cast<std::size_t>(rest.data() + rest.size() - end));
  if (error == std::errc::result_out_of_range) Fail(Quoted(text) + " is too large; a whole number is wanted");
  const bool fraction = !tail.empty() && (tail[0] == '.' || tail[0] == 'e' || tail[0] == 'E');
  if (error != std::errc{} || fraction) {
    Fail(Quoted(text) + " is not a whole number" + (std::is_unsigned_v<Integer> ? " of zero or more" : "") +
         "; write, for example, `" + (wanted == "1" ? "3" : "3 " + std::string(wanted)) + "`");
  }
  const Unit unit = CheckedUnit(text, rest.substr(0, rest.size() - tail.size()), Trimmed(tail), wanted);
  if (unit.numerator != 1.0 || unit.denominator != 1.0) {
    Fail(Quoted(text) + " is scaled; " + Wanted(wanted, "3"));
  }
  return value;
}

/// A decimal such as "29.97" as an exact fraction; nothing when it does not fit 18 digits.
bool DecimalFraction(std::string_view text, std::int64_t& numerator, std::int64_t& denominator) {
  constexpr std::int64_t kLargest = 1'000'000'000'000'000;
  numerator = 0;
  denominator = 1;
  bool point = false, any = false;
  for (const char c : text) {
    if (c == '.' && !point) {
      point = true;
    } else if (c >= '0' && c <= '9') {
      any = true;
      numerator = numerator * 10 + (c - '0');
      if (point) denominator *= 10;
      if (numerator > kLargest || denominator > kLargest) return false;
    } else {
      return false;
    }
  }
  return any;
}

}  // namespace

double ParseNumber(std::string_view text, std::string_view wanted, bool may_be_infinite) {
  const Split split = SplitNumber(text, wanted);
  const Unit unit = CheckedUnit(Trimmed(text), split.number, split.unit, wanted);
  const double value = unit.ToSi(split.value);
  if (std::isnan(value) || (std::isinf(value) && !(may_be_infinite && std::isinf(split.value)))) {
    Fail(Quoted(text) + " is not a finite number; " + Wanted(wanted, "1"));
  }
  return value;
}

Duration ParseDuration(std::string_view text) {
  constexpr double kLongest = 8.64e15;  // 100 days: below 2^53, so that every nanosecond has a double of its own
  const Split split = SplitNumber(text, "s");
  const Unit unit = CheckedUnit(Trimmed(text), split.number, split.unit, "s");
  const double ns = split.value * (unit.numerator * 1e9) / unit.denominator;
  if (!(std::abs(ns) <= kLongest)) Fail(Quoted(text) + " is longer than 100 days");
  return Nanoseconds(std::llround(ns));
}

Rate ParseRate(std::string_view text) {
  constexpr std::int64_t kLargest = 1'000'000'000;  // keeps Rate::SampleTime within 64 bits
  const std::string_view rest = Trimmed(text);
  const std::size_t digits = std::min(rest.find_first_not_of("0123456789."), rest.size());
  std::size_t number_end = digits;
  std::int64_t above = 0, above_scale = 1, below = 1, below_scale = 1;
  bool good = DecimalFraction(rest.substr(0, digits), above, above_scale);
  if (good && digits + 1 < rest.size() && rest[digits] == '/' && rest[digits + 1] >= '0' && rest[digits + 1] <= '9') {
    number_end = std::min(rest.find_first_not_of("0123456789.", digits + 1), rest.size());
    good = DecimalFraction(rest.substr(digits + 1, number_end - digits - 1), below, below_scale);
  }
  if (!good) Fail(Quoted(text) + " is not a frequency; write, for example, `30 Hz` or `30000/1001 Hz`");
  const Unit unit = CheckedUnit(rest, rest.substr(0, number_end), Trimmed(rest.substr(number_end)), "Hz");
  // 128 bits: two factors of at most 1e15 each and a unit's scale.
  __extension__ using Wide = unsigned __int128;
  Wide cycles = static_cast<Wide>(above) * static_cast<Wide>(below_scale);
  Wide seconds = static_cast<Wide>(below) * static_cast<Wide>(above_scale);
  if (unit.numerator > 1e9 || unit.denominator > 1e9 || unit.numerator != std::floor(unit.numerator) ||
      unit.denominator != std::floor(unit.denominator)) {
    Fail(Quoted(text) + " has a unit that is no exact frequency; write it in Hz");
  }
  constexpr Wide kWideEnough = static_cast<Wide>(1) << 96;
  if (cycles > kWideEnough || seconds > kWideEnough) Fail(Quoted(text) + " has too many digits");
  cycles *= static_cast<Wide>(unit.numerator);
  seconds *= static_cast<Wide>(unit.denominator);
  if (cycles == 0 || seconds == 0) Fail(Quoted(text) + " is no frequency above zero");
  Wide a = cycles, b = seconds;
  while (b != 0) a = std::exchange(b, a % b);
  if (cycles / a > static_cast<Wide>(kLargest) || seconds / a > static_cast<Wide>(kLargest)) {
    Fail(Quoted(text) + " has too many digits; its fraction must fit 1000000000/1000000000");
  }
  return {static_cast<std::int64_t>(cycles / a), static_cast<std::int64_t>(seconds / a)};
}

std::int64_t ParseInteger(std::string_view text, std::string_view unit) { return ParseWhole<std::int64_t>(text, unit); }

std::uint64_t ParseUnsigned(std::string_view text, std::string_view unit) {
  return ParseWhole<std::uint64_t>(text, unit);
}

void CheckRange(double value, const FieldInfo& info, std::string_view unit, std::string_view text) {
  if (value >= info.min && value <= info.max) return;
  const bool below = std::isfinite(info.min), above = std::isfinite(info.max);
  std::string limits;
  if (below && above) {
    limits = "it must lie between " + Format(info.min, unit) + " and " + Format(info.max, unit);
  } else if (below) {
    limits = "it must be at least " + Format(info.min, unit);
  } else {
    limits = "it must be at most " + Format(info.max, unit);
  }
  Fail(Quoted(text) + " is out of range; " + limits);
}

std::string Digits(double value) {
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return std::string(text.data(), end);
}

std::string Format(double value, std::string_view unit) {
  const Unit declared = DeclaredUnit(unit);
  return declared.IsPure() ? Digits(value) : Digits(value) + " " + std::string(unit);
}

std::string Format(Duration value) {
  constexpr struct {
    std::int64_t ns;
    const char* name;
  } kScales[] = {{1'000'000'000, " s"}, {1'000'000, " ms"}, {1'000, " us"}};
  for (const auto& [ns, name] : kScales) {
    if (value.ns % ns == 0) return std::to_string(value.ns / ns) + name;
  }
  return std::to_string(value.ns) + " ns";
}

std::string Format(Rate value) {
  const std::int64_t common = std::gcd(value.cycles, value.seconds);
  if (common == 0) return "0 Hz";
  const std::string cycles = std::to_string(value.cycles / common);
  return value.seconds == common ? cycles + " Hz" : cycles + "/" + std::to_string(value.seconds / common) + " Hz";
}

}  // namespace alula::base::quantity

#include "base/units.h"

#include <charconv>
#include <cmath>
#include <cstdlib>

namespace alula::base {

namespace {

struct NamedUnit {
  std::string_view symbol;
  std::string_view of;  // in base symbols; empty for a base unit
  double numerator = 1.0;
  double denominator = 1.0;
  bool prefixes = false;
};

constexpr std::array<std::string_view, Unit::kDimensions> kBase = {"m", "kg", "s", "A", "K", "rad", "px", "cd"};

constexpr NamedUnit kUnits[] = {
    {"m", "", 1, 1, true},
    {"kg", "", 1, 1, false},
    {"s", "", 1, 1, true},
    {"A", "", 1, 1, true},
    {"K", "", 1, 1, true},
    {"rad", "", 1, 1, true},
    {"px", "", 1, 1, true},
    {"cd", "", 1, 1, true},
    {"g", "kg", 1, 1000, true},
    {"t", "kg", 1000, 1, false},
    {"lb", "kg", 0.45359237, 1, false},
    {"oz", "kg", 0.45359237, 16, false},
    {"inch", "m", 254, 10000, false},
    {"in", "m", 254, 10000, false},
    {"ft", "m", 3048, 10000, false},
    {"mi", "m", 1609344, 1000, false},
    {"min", "s", 60, 1, false},
    {"h", "s", 3600, 1, false},
    {"day", "s", 86400, 1, false},
    {"kt", "m/s", 1852, 3600, false},
    {"g0", "m/s^2", 980665, 100000, true},
    {"deg", "rad", M_PI, 180, true},
    {"°", "rad", M_PI, 180, false},
    {"arcmin", "rad", M_PI, 10800, false},
    {"arcsec", "rad", M_PI, 648000, false},
    {"rev", "rad", 2 * M_PI, 1, false},
    {"rpm", "rad/s", 2 * M_PI, 60, false},
    {"Hz", "1/s", 1, 1, true},
    {"N", "kg m/s^2", 1, 1, true},
    {"gf", "kg m/s^2", 980665, 100000000, true},
    {"Pa", "kg/m/s^2", 1, 1, true},
    {"bar", "kg/m/s^2", 100000, 1, true},
    {"J", "kg m^2/s^2", 1, 1, true},
    {"W", "kg m^2/s^3", 1, 1, true},
    {"Wh", "kg m^2/s^2", 3600, 1, true},
    {"C", "A s", 1, 1, true},
    {"Ah", "A s", 3600, 1, true},
    {"V", "kg m^2/s^3/A", 1, 1, true},
    {"ohm", "kg m^2/s^3/A^2", 1, 1, true},
    {"Ω", "kg m^2/s^3/A^2", 1, 1, true},
    {"H", "kg m^2/s^2/A^2", 1, 1, true},
    {"T", "kg/s^2/A", 1, 1, true},
    {"gauss", "kg/s^2/A", 1, 10000, true},
    {"lx", "cd/m^2", 1, 1, true},
    {"%", "1", 1, 100, false},
    {"ppm", "1", 1, 1000000, false},
};

struct Prefix {
  std::string_view symbol;
  double numerator;
  double denominator;
};
constexpr Prefix kPrefixes[] = {{"n", 1, 1e9}, {"µ", 1, 1e6}, {"μ", 1, 1e6}, {"u", 1, 1e6},
                                {"m", 1, 1e3}, {"c", 1, 1e2}, {"d", 1, 1e1}, {"h", 1e2, 1},
                                {"k", 1e3, 1}, {"M", 1e6, 1}, {"G", 1e9, 1}};

constexpr struct {
  std::string_view unit;
  std::string_view name;
} kDimensionNames[] = {{"1", "a plain number"},
                       {"m", "a length"},
                       {"m^2", "an area"},
                       {"m^3", "a volume"},
                       {"kg", "a mass"},
                       {"s", "a time"},
                       {"A", "a current"},
                       {"K", "a temperature"},
                       {"rad", "an angle"},
                       {"px", "a number of pixels"},
                       {"m/s", "a speed"},
                       {"m/s^2", "an acceleration"},
                       {"m/s^3", "a jerk"},
                       {"rad/s", "an angular rate"},
                       {"rad/s^2", "an angular acceleration"},
                       {"Hz", "a frequency"},
                       {"N", "a force"},
                       {"N m", "a torque or an energy"},
                       {"kg m^2", "a moment of inertia"},
                       {"kg/m^3", "a density"},
                       {"Pa", "a pressure"},
                       {"W", "a power"},
                       {"V", "a voltage"},
                       {"ohm", "a resistance"},
                       {"C", "a charge"},
                       {"T", "a magnetic flux density"},
                       {"lx", "an illuminance"}};

/// Recursive descent over `expr := term (('*' | '·' | '/' | blank) term)*`; '/' divides by the next term only.
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : rest_(text) {}

  std::optional<Unit> Parse() {
    const std::optional<Unit> unit = Expression(0);
    return rest_.empty() ? unit : std::nullopt;
  }

 private:
  static constexpr int kDeepest = 8;
  static constexpr int kLargestTwiceExponent = 24;

  bool Take(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }
  bool SkipBlanks() {
    bool any = false;
    while (Take(" ") || Take("\t")) any = true;
    return any;
  }

  std::optional<Unit> Expression(int depth) {
    if (depth > kDeepest) return std::nullopt;
    SkipBlanks();
    std::optional<Unit> product = Term(depth);
    while (product) {
      const bool blank = SkipBlanks();
      if (rest_.empty() || rest_.front() == ')') break;
      bool divide = false;
      if (Take("/")) {
        divide = true;
      } else if (!Take("*") && !Take("·") && !blank) {
        return std::nullopt;
      }
      SkipBlanks();
      const std::optional<Unit> term = Term(depth);
      product = term ? Multiply(*product, *term, divide) : std::nullopt;
    }
    return product;
  }

  std::optional<Unit> Term(int depth) {
    std::optional<Unit> unit;
    if (Take("sqrt(") || Take("√(")) {
      unit = Expression(depth + 1);
      if (!unit || !Take(")")) return std::nullopt;
      unit = Power(*unit, 1);
    } else if (Take("√")) {
      unit = Symbol();
      if (unit) unit = Power(*unit, 1);
    } else if (Take("(")) {
      unit = Expression(depth + 1);
      if (!unit || !Take(")")) return std::nullopt;
    } else if (Take("1")) {
      unit = Unit{};
    } else {
      unit = Symbol();
    }
    if (!unit) return std::nullopt;
    const std::optional<int> exponent = TwiceExponent();
    return exponent ? Power(*unit, *exponent) : std::nullopt;
  }

  /// Twice the exponent that follows ("^2", "^-0.5", "2", "²"); 2 where none does.
  std::optional<int> TwiceExponent() {
    if (Take("²")) return 4;
    if (Take("³")) return 6;
    const bool caret = Take("^");
    if (!caret && (rest_.empty() || rest_.front() < '2' || rest_.front() > '4')) return 2;
    double exponent = 0;
    const auto [end, error] =
        std::from_chars(rest_.data(), rest_.data() + rest_.size(), exponent, std::chars_format::fixed);
    if (error != std::errc{} || std::abs(exponent) > kLargestTwiceExponent) return std::nullopt;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    const double twice = 2 * exponent;
    if (twice != std::floor(twice)) return std::nullopt;
    return static_cast<int>(twice);
  }

  std::optional<Unit> Symbol() {
    std::size_t n = 0;
    while (n < rest_.size() && (std::string_view(" \t*/^()0123456789-+.").find(rest_[n]) == std::string_view::npos) &&
           !rest_.substr(n).starts_with("·") && !rest_.substr(n).starts_with("²") &&
           !rest_.substr(n).starts_with("³")) {
      ++n;
    }
    if (n > 0 && rest_[n - 1] == 'g' && rest_.substr(n).starts_with("0")) ++n;  // g0, mg0
    const std::string_view symbol = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return Lookup(symbol);
  }

  static std::optional<Unit> Lookup(std::string_view symbol) {
    for (const NamedUnit& named : kUnits) {
      if (named.symbol == symbol) return Resolve(named);
    }
    for (const Prefix& prefix : kPrefixes) {
      if (!symbol.starts_with(prefix.symbol)) continue;
      for (const NamedUnit& named : kUnits) {
        if (!named.prefixes || named.symbol != symbol.substr(prefix.symbol.size())) continue;
        Unit unit = Resolve(named);
        unit.numerator *= prefix.numerator;
        unit.denominator *= prefix.denominator;
        return unit;
      }
    }
    return std::nullopt;
  }

  static Unit Resolve(const NamedUnit& named) {
    Unit unit;
    if (named.of.empty()) {
      for (std::size_t i = 0; i < kBase.size(); ++i) unit.twice_exponent[i] = kBase[i] == named.symbol ? 2 : 0;
    } else {
      unit = *UnitParser(named.of).Parse();
    }
    unit.numerator *= named.numerator;
    unit.denominator *= named.denominator;
    return unit;
  }

  static std::optional<Unit> Multiply(const Unit& a, const Unit& b, bool divide) {
    Unit product;
    for (std::size_t i = 0; i < kBase.size(); ++i) {
      product.twice_exponent[i] = a.twice_exponent[i] + (divide ? -b.twice_exponent[i] : b.twice_exponent[i]);
      if (std::abs(product.twice_exponent[i]) > kLargestTwiceExponent) return std::nullopt;
    }
    product.numerator = a.numerator * (divide ? b.denominator : b.numerator);
    product.denominator = a.denominator * (divide ? b.numerator : b.denominator);
    return Reduced(product);
  }

  static std::optional<Unit> Power(const Unit& unit, int twice) {
    if (twice == 2) return unit;
    Unit power;
    for (std::size_t i = 0; i < kBase.size(); ++i) {
      const int product = unit.twice_exponent[i] * twice;
      if (product % 2 != 0 || std::abs(product) > 2 * kLargestTwiceExponent) return std::nullopt;
      power.twice_exponent[i] = product / 2;
    }
    const double exponent = 0.5 * twice;
    power.numerator = exponent < 0 ? std::pow(unit.denominator, -exponent) : std::pow(unit.numerator, exponent);
    power.denominator = exponent < 0 ? std::pow(unit.numerator, -exponent) : std::pow(unit.denominator, exponent);
    return Reduced(power);
  }

  /// Removes a common factor ("km/km"), so that a scale of one is written 1/1; nothing when the scale overflows.
  static std::optional<Unit> Reduced(Unit unit) {
    if (!std::isnormal(unit.numerator) || !std::isnormal(unit.denominator)) return std::nullopt;
    if (unit.numerator == unit.denominator) unit.numerator = unit.denominator = 1.0;
    return unit;
  }

  std::string_view rest_;
};

}  // namespace

std::optional<Unit> ParseUnit(std::string_view text) {
  constexpr std::size_t kLongest = 64;
  if (text.size() > kLongest) return std::nullopt;
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  if (text.empty()) return Unit{};
  return UnitParser(text).Parse();
}

std::string DimensionName(const Unit& unit, std::string_view text) {
  for (const auto& [symbol, name] : kDimensionNames) {
    if (ParseUnit(symbol)->SameDimension(unit)) return std::string(name);
  }
  return "a quantity in " + std::string(text);
}

}  // namespace alula::base

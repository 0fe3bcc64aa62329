#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace alula::base {

/// A unit of measurement: exponents of the base dimensions and the scale to SI.
///
/// Angles (rad) and pixels count as dimensions of their own, so that "70" is no angle and "70 deg" is. Exponents are
/// stored doubled because noise densities have square roots: rad/s/sqrt(Hz).
struct Unit {
  enum Dimension { kLength, kMass, kTime, kCurrent, kTemperature, kAngle, kPixel, kLight, kDimensions };

  std::array<int, kDimensions> twice_exponent{};
  /// SI value = number · numerator / denominator. Two exact factors instead of one rounded quotient: "250 mm" is
  /// 250 / 1000, the same bits as 0.25.
  double numerator = 1.0;
  double denominator = 1.0;

  double ToSi(double number) const { return number * numerator / denominator; }
  bool SameDimension(const Unit& other) const { return twice_exponent == other.twice_exponent; }
  bool IsPure() const { return SameDimension(Unit{}); }
};

/// Reads "kg", "m/s^2", "m/s²", "N m", "rad/s/sqrt(Hz)", "1/s", "%", "inch", "rpm/V" … with SI prefixes.
/// "1" and "" are the unit of pure numbers. Nothing when the text is no unit.
/// `g` is the gram; standard gravity is `g0`.
std::optional<Unit> ParseUnit(std::string_view text);

/// "a mass", "an angular rate", … of the dimension of `unit`; "a quantity in <text>" where it has no common name.
std::string DimensionName(const Unit& unit, std::string_view text);

}  // namespace alula::base

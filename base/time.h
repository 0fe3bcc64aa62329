#pragma once

#include <compare>
#include <cstdint>

namespace alula::base {

/// A span of time, integer nanoseconds. Exact: sums never drift.
struct Duration {
  std::int64_t ns = 0;

  constexpr double Seconds() const { return static_cast<double>(ns) * 1e-9; }
  constexpr auto operator<=>(const Duration&) const = default;
  constexpr Duration operator+(Duration o) const { return {ns + o.ns}; }
  constexpr Duration operator-(Duration o) const { return {ns - o.ns}; }
  constexpr Duration operator-() const { return {-ns}; }
  constexpr Duration operator*(std::int64_t k) const { return {ns * k}; }
};

/// An instant: nanoseconds since the start of the run. Nothing that affects a result reads any other clock.
struct Time {
  std::int64_t ns = 0;

  constexpr double Seconds() const { return static_cast<double>(ns) * 1e-9; }
  constexpr auto operator<=>(const Time&) const = default;
  constexpr Time operator+(Duration d) const { return {ns + d.ns}; }
  constexpr Time operator-(Duration d) const { return {ns - d.ns}; }
  constexpr Duration operator-(Time o) const { return {ns - o.ns}; }
  constexpr Time& operator+=(Duration d) {
    ns += d.ns;
    return *this;
  }
};

constexpr Duration Nanoseconds(std::int64_t n) { return {n}; }
constexpr Duration Microseconds(std::int64_t n) { return {n * 1'000}; }
constexpr Duration Milliseconds(std::int64_t n) { return {n * 1'000'000}; }
/// Rounds to the nearest nanosecond.
constexpr Duration Seconds(double s) { return {static_cast<std::int64_t>(s * 1e9 + (s < 0 ? -0.5 : 0.5))}; }

/// A rational frequency, so that the n-th sample of 30 Hz is computed and not summed: `cycles` samples in `seconds` s.
struct Rate {
  std::int64_t cycles = 1;
  std::int64_t seconds = 1;

  constexpr double Hz() const { return static_cast<double>(cycles) / static_cast<double>(seconds); }
  constexpr double Period() const { return static_cast<double>(seconds) / static_cast<double>(cycles); }
  /// Time of sample n >= 0: floor(n * seconds * 1e9 / cycles) ns after the start of the run.
  constexpr Time SampleTime(std::int64_t n) const {
    // n * seconds may be large: split so that the product with 1e9 does not overflow.
    const std::int64_t whole = n * seconds / cycles;
    const std::int64_t rest = n * seconds % cycles;
    return {whole * 1'000'000'000 + rest * 1'000'000'000 / cycles};
  }
  constexpr bool operator==(const Rate&) const = default;
};

}  // namespace alula::base

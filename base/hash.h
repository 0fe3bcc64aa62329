#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/frames.h"
#include "base/time.h"

namespace alula::base {

/// 64-bit FNV-1a of a text; used for names.
constexpr std::uint64_t HashName(std::string_view text) {
  std::uint64_t h = 0xcbf29ce484222325ULL;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return h;
}

/// A rolling hash of one stream of a run, fed value by value; equal sequences give equal digests on every machine
/// of one numeric class. Doubles enter by their bits; −0 counts as 0 and every NaN as one NaN.
class RollingHash {
 public:
  void Add(std::uint64_t word) {
    state_ = Mix(state_ ^ (word + 0x9e3779b97f4a7c15ULL + (state_ << 6) + (state_ >> 2)));
    ++count_;
  }
  void Add(std::int64_t value) { Add(static_cast<std::uint64_t>(value)); }
  void Add(double value);
  void Add(Time time) { Add(static_cast<std::uint64_t>(time.ns)); }
  void Add(const Vec3& v) {
    for (int i = 0; i < 3; ++i) Add(v[i]);
  }
  void Add(const Transform& X);
  void Add(std::string_view text);
  void AddBytes(std::span<const std::uint8_t> bytes);

  std::uint64_t value() const { return Mix(state_ ^ count_); }
  /// 16 hexadecimal digits.
  std::string Hex() const;

 private:
  static constexpr std::uint64_t Mix(std::uint64_t z) {  // SplitMix64's finaliser
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  std::uint64_t state_ = 0x243f6a8885a308d3ULL;
  std::uint64_t count_ = 0;
};

}  // namespace alula::base

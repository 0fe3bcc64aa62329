#include "base/hash.h"

#include <array>
#include <cmath>
#include <cstring>

namespace alula::base {

void RollingHash::Add(double value) {
  if (std::isnan(value)) return Add(std::uint64_t{0x7ff8000000000000ULL});
  Add(std::bit_cast<std::uint64_t>(value == 0.0 ? 0.0 : value));
}

void RollingHash::Add(const Transform& X) {
  Add(X.p);
  Add(X.q.w());
  Add(X.q.x());
  Add(X.q.y());
  Add(X.q.z());
}

void RollingHash::Add(std::string_view text) {
  AddBytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

void RollingHash::AddBytes(std::span<const std::uint8_t> bytes) {
  Add(static_cast<std::uint64_t>(bytes.size()));
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, 8);
    Add(word);
  }
  if (i < bytes.size()) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, bytes.size() - i);
    Add(word);
  }
}

std::string RollingHash::Hex() const {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text(16, '0');
  std::uint64_t v = value();
  for (int i = 15; i >= 0; --i, v >>= 4) text[static_cast<std::size_t>(i)] = kDigits[v & 15];
  return text;
}

}  // namespace alula::base

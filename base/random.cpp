#include "base/random.h"

#include <cmath>

#include "base/hash.h"

namespace alula::base {

std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> c, std::array<std::uint32_t, 2> k) {
  constexpr std::uint32_t kM0 = 0xD2511F53, kM1 = 0xCD9E8D57, kW0 = 0x9E3779B9, kW1 = 0xBB67AE85;
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t{kM0} * c[0];
    const std::uint64_t p1 = std::uint64_t{kM1} * c[2];
    c = {static_cast<std::uint32_t>(p1 >> 32) ^ c[1] ^ k[0], static_cast<std::uint32_t>(p1),
         static_cast<std::uint32_t>(p0 >> 32) ^ c[3] ^ k[1], static_cast<std::uint32_t>(p0)};
    k[0] += kW0;
    k[1] += kW1;
  }
  return c;
}

RandomStream::RandomStream(std::uint64_t seed, std::string_view name) {
  const std::uint64_t h = HashName(name);
  key_ = {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
  counter_ = {0, 0, static_cast<std::uint32_t>(h), static_cast<std::uint32_t>(h >> 32)};
}

void RandomStream::Refill() {
  const std::array<std::uint32_t, 4> c = Philox4x32(counter_, key_);
  block_ = {std::uint64_t{c[0]} << 32 | c[1], std::uint64_t{c[2]} << 32 | c[3]};
  if (++counter_[0] == 0) ++counter_[1];
  used_ = 0;
}

std::uint64_t RandomStream::Bits() {
  if (used_ == 2) Refill();
  return block_[static_cast<std::size_t>(used_++)];
}

double RandomStream::Uniform() { return static_cast<double>(Bits() >> 11) * 0x1p-53; }

std::uint64_t RandomStream::Index(std::uint64_t n) {
  const std::uint64_t limit = -n % n;  // 2^64 mod n
  for (;;) {
    const std::uint64_t bits = Bits();
    if (bits >= limit) return bits % n;
  }
}

double RandomStream::Gaussian() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double u = 1.0 - Uniform();  // (0, 1]
  const double v = Uniform();
  const double r = std::sqrt(-2.0 * std::log(u));
  spare_ = r * std::sin(2.0 * M_PI * v);
  has_spare_ = true;
  return r * std::cos(2.0 * M_PI * v);
}

}  // namespace alula::base

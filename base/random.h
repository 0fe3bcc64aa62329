#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/frames.h"

namespace alula::base {

/// One block of the counter-based generator Philox4x32-10 (Salmon et al. 2011).
std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// A counter-based stream of random numbers keyed by the run's seed and the stream's name ("vehicle0/imu.gyro"), so
/// that a new sensor never shifts another one's noise. Philox4x32-10 (Salmon et al. 2011); equal on every machine.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name);

  std::uint64_t Bits();
  /// In [0, 1), 53 bits.
  double Uniform();
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  /// An integer in [0, n), n ≥ 1; unbiased by rejection.
  std::uint64_t Index(std::uint64_t n);
  /// Standard normal by Box–Muller.
  double Gaussian();
  Vec3 GaussianVec3() { return {Gaussian(), Gaussian(), Gaussian()}; }

 private:
  void Refill();

  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_{};
  std::array<std::uint64_t, 2> block_{};
  int used_ = 2;
  bool has_spare_ = false;
  double spare_ = 0.0;
};

}  // namespace alula::base

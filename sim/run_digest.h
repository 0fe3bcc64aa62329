#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/hash.h"
#include "sim/observer.h"

namespace alula::sim {

/// What a run is made of, as far as a digest covers it: the state after each step; the stack's estimates, commands and
/// events, and those of faults; what it was given, pictures by every byte. run_fields.h has every field.
enum class Stream : std::uint8_t { kTruth, kEstimates, kCommands, kEvents, kMeasurements };
inline constexpr std::size_t kStreams = 5;
/// By Stream.
inline constexpr std::array<std::string_view, kStreams> kStreamNames = {"truth", "estimates", "commands", "events",
                                                                        "measurements"};

/// Rolling hashes of what a run did, one per stream; wall times never enter. Two runs are the same run when these are.
struct RunDigest {
  std::array<base::RollingHash, kStreams> streams;  // by Stream

  base::RollingHash& operator[](Stream stream) { return streams[static_cast<std::size_t>(stream)]; }
  void Add(const StepView& step);
  /// All streams in one, 16 hexadecimal digits.
  std::string Hex() const;
};

}  // namespace alula::sim

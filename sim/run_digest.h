#pragma once

#include <string>

#include "base/hash.h"
#include "sim/observer.h"

namespace alula::sim {

/// Rolling hashes of what a run did, one per stream; wall times never enter. Two runs are the same run when these are.
struct RunDigest {
  base::RollingHash truth;         // state after each step
  base::RollingHash estimates;     // as published
  base::RollingHash commands;      // as issued
  base::RollingHash events;        // of the stack
  base::RollingHash measurements;  // as handed over, pictures by every byte

  void Add(const StepView& step);
  /// All streams in one, 16 hexadecimal digits.
  std::string Hex() const;
};

}  // namespace alula::sim

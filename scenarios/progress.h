#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/time.h"

namespace alula::scenarios {

/// How far a run is: a bar that redraws itself on a terminal, a plain line every ten simulated seconds otherwise;
/// on stderr.
class Progress {
 public:
  Progress(std::string name, std::optional<base::Duration> limit, bool on);
  void Show(base::Time time);
  /// Wipes the bar.
  void Clear();

 private:
  std::string name_;
  std::optional<base::Duration> limit_;
  bool on_;
  bool terminal_;
  bool drawn_ = false;
};

}  // namespace alula::scenarios

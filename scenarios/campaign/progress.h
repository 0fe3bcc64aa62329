#pragma once

#include <string>

#include "scenarios/campaign/sweep.h"

namespace alula::scenarios::campaign {

/// How far a sweep is, on stderr: a bar that redraws itself on a terminal; otherwise a line for each run that did not
/// pass (unless failures are what is looked for) and one for every twentieth of the sweep.
class SweepProgress {
 public:
  SweepProgress(std::string name, bool on, bool names_failures = true);
  void Show(const SweepNews& news);
  /// Wipes the bar.
  void Clear();

 private:
  void ShowPlain(const SweepNews& news);

  std::string name_;
  bool on_;
  bool names_failures_;
  bool terminal_;
  bool drawn_ = false;
  std::size_t told_ = 0;  // twentieths
};

/// "3 min 20 s".
std::string DurationText(double seconds);

}  // namespace alula::scenarios::campaign

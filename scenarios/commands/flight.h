#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "scenarios/commands/command_line.h"
#include "scenarios/runner.h"

namespace alula::scenarios::commands {

/// What a flight came to. No verdict: bad input or Ctrl-C, which its process has told on stderr.
struct FlightEnd {
  int exit_code = 0;
  std::optional<Verdict> verdict;
  double wall_s = 0.0;
  std::string note;  // of the `note` function
};

/// Runner's options from what all verbs that fly understand.
RunOptions OptionsOf(const CommandLine& line);

/// What a flying process has to say after its flight. Where it works on for long it calls `alive` now and then, so that
/// it is not taken to hang.
using FlightNote = std::function<std::string(const std::function<void()>& alive)>;

/// Flies in a process of its own with a progress bar, watched: a crash, a hang or a lack of memory is a verdict too.
/// `note` is asked in that process after the flight.
FlightEnd Fly(const Scenario& scenario, const RunOptions& options, const CommandLine& line,
              const FlightNote& note = nullptr);

/// Does `work`; what it throws is told on stderr and becomes an exit code.
int Guarded(const std::function<int()>& work);

}  // namespace alula::scenarios::commands

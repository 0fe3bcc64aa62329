#pragma once

#include <sys/types.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "base/time.h"

namespace alula::scenarios {

/// What a supervised process may take.
struct Limits {
  base::Duration stall = base::Seconds(60.0);  // of wall time without a step of the simulation
  std::optional<base::Duration> wall;          // of wall time in all
  std::optional<std::uint64_t> memory;         // resident, bytes
};

/// Memory that the supervisor shares with the process that it watches.
struct Pulse {
  std::atomic<std::int64_t> simulated_ns{0};  // how far the simulation is
  std::atomic<bool> finished{false};          // the work came to its end
};

/// An end that the work did not choose.
struct Death {
  std::string reason;   // "crash", "hang", "memory", "killed", "exit"
  std::string message;  // what happened, in a sentence
  base::Time simulated;
};

/// What work has to say at its end.
struct Report {
  int exit_code = 0;
  std::string text;
};

struct Ending {
  pid_t pid = 0;
  Report report;  // of work that came to its end
  std::optional<Death> death;
  bool interrupted = false;  // SIGINT or SIGTERM came; a process that it killed is no death
};

/// What one who watches processes waits for, blocked: SIGCHLD, SIGINT, SIGTERM.
sigset_t WatchedSignals();

/// Does `work` in a process of its own and watches it: whatever it does to itself (a crash, a hang, all memory taken,
/// an exit in the middle), this function returns and says what happened. SIGINT and SIGTERM are passed on. The process
/// dies with its supervisor. Call it before any thread is started.
Ending Supervise(const Limits& limits, const std::function<Report(Pulse&)>& work);

/// From now on a crash of this process leaves the stack of the thread that crashed in `file`, where the file's folder
/// exists by then.
void LeaveStackTraceIn(const std::filesystem::path& file);

}  // namespace alula::scenarios

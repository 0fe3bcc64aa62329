#pragma once

#include <string>
#include <vector>

namespace alula::scenarios::slurm {

struct CommandOptions {
  std::string input = {};                 ///< what the program reads from its standard input
  std::vector<std::string> without = {};  ///< variables that begin so are kept from its environment
  double time_limit_s = 120.0;            ///< then it is killed; Slurm's own programs give up after some ten seconds
};

/// What a child process came to.
struct CommandOutcome {
  int exit_code = -1;  ///< 128 + n where signal n ended it
  bool timed_out = false;
  std::string out;
  std::string err;
};

/// Runs `argv` (argv[0] is looked up on the PATH, no shell is involved) to its end, in a process group of its own, so
/// that a Ctrl-C at the terminal does not tear a submission in two. Throws InputError where the program cannot be
/// found, FaultError("child_process") where the system refuses a process.
CommandOutcome RunCommand(const std::vector<std::string>& argv, const CommandOptions& options = {});

}  // namespace alula::scenarios::slurm

#pragma once

#include <string>
#include <vector>

namespace alula::scenarios::testing {

/// What a run of the alula command came to.
struct CommandResult {
  int exit_code = -1;  // 128 + n where signal n ended it
  std::string out;
  std::string err;
};

struct CommandOptions {
  std::string directory = {};                 // where it runs; empty: here
  std::vector<std::string> environment = {};  // "NAME=value", besides the present one
  int interrupt_when_err_has_lines = 0;       // sends SIGINT after so many lines on stderr; 0: never
};

/// Runs the alula that this build made, as a user would.
CommandResult Alula(const std::vector<std::string>& arguments, const CommandOptions& options = {});

}  // namespace alula::scenarios::testing

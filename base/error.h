#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace alula::base {

/// Where in a file something stands; line and column from 1, 0 when unknown.
struct SourcePosition {
  std::string file;
  int line = 0;
  int column = 0;
};

/// Bad input by the user: a file, key, value, unit or argument. The program prints one line and exits with 2.
/// The message reads `file:line:col: key: what was wrong; what would be right`.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  InputError(const SourcePosition& where, std::string_view key, std::string_view message);
};

/// A broken invariant or a failed internal step: `outcome: fault`, exit code 3. `reason` is a short snake_case word.
class FaultError : public std::runtime_error {
 public:
  FaultError(std::string reason, const std::string& message)
      : std::runtime_error(message), reason_(std::move(reason)) {}
  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

}  // namespace alula::base

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/criteria/criterion.h"

namespace alula::scenarios {

enum class Outcome { kPass, kFail, kFault };

/// What a run came to.
struct Verdict {
  Outcome outcome = Outcome::kFault;
  std::string reason;   // why the run ended: a snake_case word
  std::string message;  // of a fault: what happened
  std::vector<Check> checks;
  Metrics metrics;
  std::string digest;
  std::map<std::string, std::string> digests;  // by stream
  std::string numeric_class;
  std::map<std::string, std::string> versions;
  std::uint64_t seed = 0;
  std::string scenario;
};

const char* Word(Outcome outcome);
/// The outcome of a word; kFault for any other.
Outcome OutcomeOf(std::string_view word);
/// 0 pass, 1 fail, 3 fault.
int ExitCode(Outcome outcome);
std::string ToJson(const Verdict& verdict);
/// The verdict that ToJson wrote. Throws base::FaultError("verdict") for any other text.
Verdict VerdictFromJson(const std::string& text);
/// A table for a person.
std::string ToTable(const Verdict& verdict);

}  // namespace alula::scenarios

#pragma once

#include <vector>

#include "stack/interface/navigation_stack.h"
#include "stack/interface/plugin.h"

namespace alula::scenarios::plugin {

/// What a library answered, looked at before it is used: counts, kinds, texts, unit quaternions. Numbers that are not
/// finite pass; the simulation names them. Each throws std::runtime_error that says what breaks plugin.h's contract.
stack::StackOutput Read(const AlulaOutput& output);
std::vector<stack::StackFile> Read(const AlulaFiles& files);
std::vector<stack::StageTime> Read(const AlulaTiming& timing);

}  // namespace alula::scenarios::plugin

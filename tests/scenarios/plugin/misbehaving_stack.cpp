// docs/examples/own_stack with a bad habit. `parameters` names it and the simulated second at which it breaks out:
//
//   ""                     none: the example as it is
//   error@5                returns ALULA_FAILED and says why        throw@5     throws std::out_of_range
//   oddly@5                throws an int                            nan@5       sends an estimate that is no number
//   kind@5                 sends a command that does not exist      round@5     changes the mode of rounding
//   segfault@5  abort@5  exit@5 (std::exit(0): a zero, but no verdict)
//   hang@5                 sleeps for ever; Alula takes SIGTERM as a wish, so only SIGKILL ends it
//   memory@5               takes 4 GiB, then gives up
//   setpoint_shift@5:0.01  from then on every position set-point lies 0.01 m further in x
//
// A parameter text that is none of these is bad input.
#include <unistd.h>

#include <cfenv>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "stack/interface/plugin.h"

extern "C" const AlulaStackPlugin* own_stack_plugin(void);

namespace {

constexpr std::size_t kChunk = std::size_t{64} << 20;
constexpr std::size_t kMostMemory = std::size_t{4} << 30;

struct Stack {
  std::string habit;
  std::int64_t from_ns = 0;
  double amount = 0.0;
  void* flier = nullptr;  // the example
  std::vector<AlulaCommand> commands;
  AlulaEstimate estimate{};
};

const char* const kHabits[] = {"error",    "throw", "oddly", "nan",  "kind",   "round",
                               "segfault", "abort", "exit",  "hang", "memory", "setpoint_shift"};

/// "habit@seconds:amount"; false where it is none.
bool ReadHabit(const std::string& text, Stack& stack) {
  if (text.empty()) return true;
  const std::size_t at = text.find('@');
  stack.habit = text.substr(0, at);
  if (at == std::string::npos) return false;
  char* end = nullptr;
  stack.from_ns = static_cast<std::int64_t>(std::strtod(text.c_str() + at + 1, &end) * 1e9);
  if (*end == ':') stack.amount = std::strtod(end + 1, &end);
  for (const char* habit : kHabits) {
    if (stack.habit == habit) return *end == '\0';
  }
  return false;
}

std::int32_t Say(AlulaError* error, const char* text) {
  std::strncpy(error->text, text, sizeof error->text - 1);
  return ALULA_FAILED;
}

std::int32_t EatMemory(AlulaError* error) {
  std::vector<std::unique_ptr<char[]>> eaten;
  while (eaten.size() * kChunk < kMostMemory) {
    eaten.emplace_back(new char[kChunk]);  // std::bad_alloc where there is a limit on addresses
    std::memset(eaten.back().get(), 1, kChunk);
  }
  return Say(error, "took 4 GiB, and nobody minded");
}

/// What happens at the given second and after it.
std::int32_t Misbehave(Stack& stack, AlulaOutput* output, AlulaError* error) {
  const std::string& habit = stack.habit;
  if (habit == "error") return Say(error, "lost the map");
  if (habit == "throw") throw std::out_of_range("keyframe 17");
  if (habit == "oddly") throw 42;
  if (habit == "round") std::fesetround(FE_UPWARD);
  if (habit == "segfault") *static_cast<volatile int*>(nullptr) = 1;
  if (habit == "abort") std::abort();
  if (habit == "exit") std::exit(0);
  if (habit == "memory") return EatMemory(error);
  while (habit == "hang") ::pause();
  if (habit == "nan") {
    stack.estimate.X_OB = stack.estimate.X_MO = alula_identity();
    stack.estimate.X_OB.p.z = std::numeric_limits<double>::quiet_NaN();
    output->estimate = &stack.estimate;
  }
  stack.commands.assign(output->commands, output->commands + output->command_count);
  if (habit == "kind") stack.commands.push_back({0, 0, 99, 0, {}});
  for (AlulaCommand& command : stack.commands) {
    if (habit == "setpoint_shift" && command.kind == ALULA_POSITION_SETPOINT)
      command.data.position.p_OB.x += stack.amount;
  }
  output->commands = stack.commands.data();
  output->command_count = stack.commands.size();
  return ALULA_OK;
}

std::int32_t Create(const AlulaSetup* setup, void** self, AlulaError* error) {
  auto stack = std::make_unique<Stack>();
  if (!ReadHabit({setup->parameters.bytes, setup->parameters.size}, *stack)) {
    Say(error, "stack.parameters names no habit; write segfault@5 or another of misbehaving_stack.cpp");
    return ALULA_BAD_INPUT;
  }
  const std::int32_t answer = own_stack_plugin()->create(setup, &stack->flier, error);
  if (answer == ALULA_OK) *self = stack.release();
  return answer;
}

std::int32_t Step(void* self, std::int64_t now_ns, const AlulaMeasurement* measurements, std::uint64_t count,
                  AlulaOutput* output, AlulaError* error) {
  Stack& stack = *static_cast<Stack*>(self);
  const std::int32_t answer = own_stack_plugin()->step(stack.flier, now_ns, measurements, count, output, error);
  if (answer != ALULA_OK || stack.habit.empty() || now_ns < stack.from_ns) return answer;
  return Misbehave(stack, output, error);
}

void Destroy(void* self) {
  own_stack_plugin()->destroy(static_cast<Stack*>(self)->flier);
  delete static_cast<Stack*>(self);
}

}  // namespace

extern "C" ALULA_STACK_EXPORT const AlulaStackPlugin* alula_stack_plugin(void) {
  static const AlulaStackPlugin plugin = {
      ALULA_STACK_ABI_VERSION, 0, ALULA_LAYOUT, "misbehaving", Create, Step, nullptr, nullptr, Destroy};
  return &plugin;
}

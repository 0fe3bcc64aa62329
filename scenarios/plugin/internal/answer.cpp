#include "scenarios/plugin/internal/answer.h"

#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

#include "scenarios/plugin/internal/utf8.h"

namespace alula::scenarios::plugin {
namespace {

static_assert(ALULA_INITIALISING == static_cast<int>(stack::StackState::kInitialising));
static_assert(ALULA_READY == static_cast<int>(stack::StackState::kReady));
static_assert(ALULA_FLYING == static_cast<int>(stack::StackState::kFlying));
static_assert(ALULA_DONE == static_cast<int>(stack::StackState::kDone));
static_assert(ALULA_STACK_FAILED == static_cast<int>(stack::StackState::kFailed));

[[noreturn]] void Fail(const std::string& what) { throw std::runtime_error("the stack's answer: " + what); }

/// A list of the library's, its length believable.
template <typename T>
std::span<const T> List(const T* first, std::uint64_t count, const std::string& name) {
  if (count > ALULA_MOST_ITEMS) {
    Fail(std::to_string(count) + " " + name + "; there may be " + std::to_string(ALULA_MOST_ITEMS));
  }
  if (count > 0 && first == nullptr) Fail(std::to_string(count) + " " + name + " at a null pointer");
  return {first, static_cast<std::size_t>(count)};
}

std::string Read(const AlulaText& text, const std::string& name) {
  if (text.size > ALULA_LONGEST_TEXT) {
    Fail(name + " has " + std::to_string(text.size) + " bytes; there may be " + std::to_string(ALULA_LONGEST_TEXT));
  }
  if (text.size == 0) return {};
  if (text.bytes == nullptr) Fail(name + " is a null pointer");
  std::string read(text.bytes, static_cast<std::size_t>(text.size));
  if (!IsUtf8(read)) Fail(name + " is no UTF-8");
  return read;
}

base::Vec3 Read(const AlulaVec3& v) { return {v.x, v.y, v.z}; }

base::Transform Read(const AlulaTransform& X, const std::string& name) {
  constexpr double kTolerance = 1e-3;  // far above what single precision leaves of a unit quaternion
  const base::Quat q(X.q.w, X.q.x, X.q.y, X.q.z);
  if (const double norm = q.norm(); std::abs(norm - 1.0) > kTolerance) {
    Fail("the quaternion of " + name + " has length " + std::to_string(norm) + "; 1 is wanted");
  }
  return {q, Read(X.p)};
}

decltype(stack::Command::what) Read(const AlulaCommand& c) {
  switch (c.kind) {
    case ALULA_ARM:
      return stack::Arm{};
    case ALULA_DISARM:
      return stack::Disarm{};
    case ALULA_POSITION_SETPOINT: {
      const AlulaPositionSetpoint& p = c.data.position;
      return stack::PositionSetpoint{Read(p.p_OB), Read(p.v_OB), Read(p.a_OB), p.yaw, p.yaw_rate};
    }
    case ALULA_VELOCITY_SETPOINT:
      return stack::VelocitySetpoint{Read(c.data.velocity.v_OB), c.data.velocity.yaw, c.data.velocity.yaw_rate};
    case ALULA_HOLD:
      return stack::Hold{};
    case ALULA_LAND:
      return stack::Land{};
    case ALULA_GIMBAL_SETPOINT: {
      const AlulaGimbalSetpoint& g = c.data.gimbal;
      return stack::GimbalSetpoint{g.gimbal, g.roll, g.pitch, g.yaw};
    }
    default:
      Fail("a command of kind " + std::to_string(c.kind) + "; there are 0 to " + std::to_string(ALULA_GIMBAL_SETPOINT));
  }
}

stack::Estimate Read(const AlulaEstimate& e) {
  stack::Estimate estimate;
  estimate.stamp = {e.stamp_ns};
  estimate.X_OB = Read(e.X_OB, "estimate.X_OB");
  estimate.v_OB = Read(e.v_OB);
  estimate.w_B = Read(e.w_B);
  for (int i = 0; i < 36; ++i) estimate.pose_covariance(i / 6, i % 6) = e.pose_covariance[i];
  for (int i = 0; i < 9; ++i) estimate.velocity_covariance(i / 3, i % 3) = e.velocity_covariance[i];
  estimate.X_MO = Read(e.X_MO, "estimate.X_MO");
  estimate.reset_counter = e.reset_counter;
  return estimate;
}

/// A plain name: it must not lead out of the run folder or hide in it.
std::string FileName(const AlulaText& text) {
  std::string name = Read(text, "the name of a file");
  if (name.empty() || name.front() == '.' || name.find_first_of(std::string("/\\\0", 3)) != std::string::npos) {
    Fail("a file called `" + name + "`; a plain name is wanted, without slashes, not beginning with a dot");
  }
  return name;
}

}  // namespace

stack::StackOutput Read(const AlulaOutput& output) {
  stack::StackOutput read;
  for (const AlulaCommand& command : List(output.commands, output.command_count, "commands")) {
    read.commands.push_back({Read(command), {command.issued_ns}, {command.expires_ns}});
  }
  if (output.estimate != nullptr) read.estimate = Read(*output.estimate);
  for (const AlulaEvent& event : List(output.events, output.event_count, "events")) {
    read.events.push_back(
        {{event.time_ns}, Read(event.kind, "the kind of an event"), Read(event.text, "the text of an event")});
  }
  if (output.state > ALULA_STACK_FAILED) {
    Fail("state " + std::to_string(output.state) + "; there are 0 to " + std::to_string(ALULA_STACK_FAILED));
  }
  read.state = static_cast<stack::StackState>(output.state);
  read.next_gate = output.next_gate;
  return read;
}

std::vector<stack::StackFile> Read(const AlulaFiles& files) {
  std::vector<stack::StackFile> read;
  for (const AlulaFile& file : List(files.files, files.count, "files")) {
    const std::string name = FileName(file.name);
    if (file.size > 0 && file.bytes == nullptr) Fail("the bytes of " + name + " are a null pointer");
    read.push_back({name, {reinterpret_cast<const char*>(file.bytes), static_cast<std::size_t>(file.size)}});
  }
  return read;
}

std::vector<stack::StageTime> Read(const AlulaTiming& timing) {
  std::vector<stack::StageTime> read;
  for (const AlulaStageTime& stage : List(timing.stages, timing.count, "stages")) {
    read.push_back({Read(stage.name, "the name of a stage"), stage.wall_ms, stage.calls, stage.p99_ms});
  }
  return read;
}

}  // namespace alula::scenarios::plugin

#pragma once

#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <span>
#include <string_view>
#include <variant>

#include "base/frames.h"
#include "base/time.h"
#include "sim/run_digest.h"
#include "stack/interface/measurement.h"
#include "stack/interface/navigation_stack.h"
#include "vehicles/vehicle.h"

namespace alula::sim {

/// All records of one step that a digest covers.
struct StepRecords {
  const vehicles::BodyState& truth;  // at the step's end
  std::span<const stack::Measurement> measurements;
  const stack::StackOutput* output = nullptr;  // null where no stack flies
  std::span<const stack::StackEvent> fault_events{};
  std::span<const base::Transform> X_WR{};  // roots of the world's actors, where they began a tick in this step
};

/// What sets a record apart from others of its stream; kind is empty where all are alike.
struct RecordName {
  std::string_view kind{};                          // of commands and events: "position_setpoint", "take_off"
  const stack::Measurement* measurement = nullptr;  // of measurements: its sensor and seq
};

/// One of a few words, hashed by its number.
struct Word {
  std::uint64_t number = 0;
  std::string_view text;
};
struct Flag {
  std::string_view name;
  bool on = false;
};

/// How the values of an image lie, in values of its span: `stride` to the next row, `channels` to a pixel.
struct PixelGrid {
  int stride = 1;
  int channels = 1;
};

namespace run_fields {

inline constexpr std::string_view kCommandNames[] = {"arm",  "disarm", "position_setpoint", "velocity_setpoint",
                                                     "hold", "land",   "gimbal_setpoint"};
static_assert(std::size(kCommandNames) == std::variant_size_v<decltype(stack::Command::what)>);
inline constexpr std::string_view kModeNames[] = {"disarmed", "ready", "following", "holding", "landing"};

// One function a kind of record: its fields, in the order in which they enter the digest.

template <typename Fields>
void Visit(const stack::ImuSample& s, Fields f) {
  f("angular_velocity", s.angular_velocity);
  f("specific_force", s.specific_force);
}
template <typename Fields>
void Visit(const stack::Image& s, Fields f) {
  f("width", std::int64_t{s.width});
  f("height", std::int64_t{s.height});
  f.Pixels(std::span<const std::uint8_t>(*s.bytes), {s.stride, s.format == stack::PixelFormat::kRgb8 ? 3 : 1});
}
template <typename Fields>
void Visit(const stack::DepthImage& s, Fields f) {
  f("width", std::int64_t{s.width});
  f("height", std::int64_t{s.height});
  f.Pixels(std::span<const std::uint16_t>(*s.millimetres), {s.width, 1});
}
template <typename Fields>
void Visit(const stack::GimbalAngles& s, Fields f) {
  f("roll", s.roll);
  f("pitch", s.pitch);
  f("yaw", s.yaw);
}
template <typename Fields>
void Visit(const stack::BaroSample& s, Fields f) {
  f("pressure", s.pressure);
}
template <typename Fields>
void Visit(const stack::MagSample& s, Fields f) {
  f("magnetic_field", s.magnetic_field);
}
template <typename Fields>
void Visit(const stack::PositionFix& s, Fields f) {
  f("X_WB", s.X_WB);
}
template <typename Fields>
void Visit(const stack::BatterySample& s, Fields f) {
  f("voltage", s.voltage);
  f("current", s.current);
}
template <typename Fields>
void Visit(const stack::VehicleStatus& s, Fields f) {
  const auto mode = static_cast<std::size_t>(s.mode);
  f("mode", Word{mode, mode < std::size(kModeNames) ? kModeNames[mode] : std::string_view("unknown")});
  f.Flags({{"armed", s.armed}, {"ready_to_arm", s.ready_to_arm}, {"landed", s.landed}});
  f("thrust", s.thrust);
}

template <typename Fields>
void Visit(const stack::Arm&, Fields) {}
template <typename Fields>
void Visit(const stack::Disarm&, Fields) {}
template <typename Fields>
void Visit(const stack::Hold&, Fields) {}
template <typename Fields>
void Visit(const stack::Land&, Fields) {}
template <typename Fields>
void Visit(const stack::PositionSetpoint& s, Fields f) {
  f("p_OB", s.p_OB);
  f("v_OB", s.v_OB);
  f("a_OB", s.a_OB);
  f("yaw", s.yaw);
  f("yaw_rate", s.yaw_rate);
}
template <typename Fields>
void Visit(const stack::VelocitySetpoint& s, Fields f) {
  f("v_OB", s.v_OB);
  f("yaw", s.yaw);
  f("yaw_rate", s.yaw_rate);
}
template <typename Fields>
void Visit(const stack::GimbalSetpoint& s, Fields f) {
  f("gimbal", std::int64_t{s.gimbal});
  f("roll", s.roll);
  f("pitch", s.pitch);
  f("yaw", s.yaw);
}

template <typename Fields>
void Visit(const stack::Estimate& e, Fields f) {
  f("stamp", e.stamp);
  f("X_OB", e.X_OB);
  f("v_OB", e.v_OB);
  f("w_B", e.w_B);
  f("X_MO", e.X_MO);
  f("reset_counter", std::uint64_t{e.reset_counter});
  f.Diagonal("pose_covariance", e.pose_covariance);
}

template <typename Sink>
void VisitMeasurement(const stack::Measurement& m, Sink& sink) {
  auto f = sink.Record(Stream::kMeasurements, RecordName{.measurement = &m});
  f("sensor", static_cast<std::uint64_t>(m.sensor));
  f("seq", std::uint64_t{m.seq});
  f("captured", m.captured);
  f("available", m.available);
  std::visit([&f](const auto& data) { Visit(data, f); }, m.data);
}

template <typename Sink>
void VisitCommand(const stack::Command& command, Sink& sink) {
  const std::string_view kind = kCommandNames[command.what.index()];
  auto f = sink.Record(Stream::kCommands, RecordName{.kind = kind});
  f("kind", Word{command.what.index(), kind});
  f("issued", command.issued);
  f("expires", command.expires);
  std::visit([&f](const auto& what) { Visit(what, f); }, command.what);
}

template <typename Sink>
void VisitEvent(const stack::StackEvent& event, Sink& sink) {
  auto f = sink.Record(Stream::kEvents, RecordName{.kind = event.kind});
  f("time", event.time);
  f("kind", std::string_view(event.kind));
  f("text", std::string_view(event.text));
}

}  // namespace run_fields

/// The one walk over all that makes two runs the same or not: the digest hashes it, a comparison of runs names it. It
/// goes as the step does: measurements reach the stack, its answers follow, then the truth moves.
/// `sink.Record(Stream, const RecordName&)` opens a record and gives what takes its fields (a copy of it may):
///
///   f(name, value)          value: double, std::int64_t, std::uint64_t, base::Time, base::Vec3, base::Transform,
///                           std::string_view, Word
///   f.Flags({Flag, …})      a few booleans as one number
///   f.Diagonal(name, m)     of a square matrix
///   f.Pixels(span, grid)    an image: bytes, or 16-bit numbers
///
/// Names are literals: a sink that does not look at them pays nothing for them.
template <typename Sink>
void VisitRun(const StepRecords& step, Sink& sink) {
  for (const stack::Measurement& m : step.measurements) run_fields::VisitMeasurement(m, sink);
  if (step.output != nullptr) {
    if (step.output->estimate) run_fields::Visit(*step.output->estimate, sink.Record(Stream::kEstimates, RecordName{}));
    for (const stack::Command& command : step.output->commands) run_fields::VisitCommand(command, sink);
    for (const stack::StackEvent& event : step.output->events) run_fields::VisitEvent(event, sink);
  }
  for (const stack::StackEvent& event : step.fault_events) run_fields::VisitEvent(event, sink);
  auto f = sink.Record(Stream::kTruth, RecordName{});
  f("X_WB", step.truth.X_WB);
  f("v_WB", step.truth.v_WB);
  f("w_B", step.truth.w_B);
  for (const base::Transform& X_WR : step.X_WR) f("X_WR", X_WR);
}

}  // namespace alula::sim

#include "sim/run_digest.h"

#include <variant>

namespace alula::sim {
namespace {

void AddTo(base::RollingHash& h, const stack::ImuSample& s) {
  h.Add(s.angular_velocity);
  h.Add(s.specific_force);
}
void AddTo(base::RollingHash& h, const stack::Image& s) {
  h.Add(std::int64_t{s.width});
  h.Add(std::int64_t{s.height});
  h.AddBytes(*s.bytes);
}
void AddTo(base::RollingHash& h, const stack::DepthImage& s) {
  h.Add(std::int64_t{s.width});
  h.Add(std::int64_t{s.height});
  for (const std::uint16_t depth : *s.millimetres) h.Add(std::uint64_t{depth});
}
void AddTo(base::RollingHash& h, const stack::GimbalAngles& s) { h.Add(base::Vec3(s.roll, s.pitch, s.yaw)); }
void AddTo(base::RollingHash& h, const stack::BaroSample& s) { h.Add(s.pressure); }
void AddTo(base::RollingHash& h, const stack::PositionFix& s) { h.Add(s.X_WB); }
void AddTo(base::RollingHash& h, const stack::BatterySample& s) {
  h.Add(s.voltage);
  h.Add(s.current);
}
void AddTo(base::RollingHash& h, const stack::VehicleStatus& s) {
  h.Add(static_cast<std::int64_t>(s.mode));
  h.Add(std::int64_t{s.armed} + 2 * std::int64_t{s.ready_to_arm} + 4 * std::int64_t{s.landed});
  h.Add(s.thrust);
}

void AddTo(base::RollingHash& h, const stack::GimbalSetpoint& s) {
  h.Add(std::int64_t{s.gimbal});
  h.Add(base::Vec3(s.roll, s.pitch, s.yaw));
}
void AddTo(base::RollingHash&, const stack::Arm&) {}
void AddTo(base::RollingHash&, const stack::Disarm&) {}
void AddTo(base::RollingHash&, const stack::Hold&) {}
void AddTo(base::RollingHash&, const stack::Land&) {}
void AddTo(base::RollingHash& h, const stack::PositionSetpoint& s) {
  h.Add(s.p_OB);
  h.Add(s.v_OB);
  h.Add(s.a_OB);
  h.Add(s.yaw);
  h.Add(s.yaw_rate);
}
void AddTo(base::RollingHash& h, const stack::VelocitySetpoint& s) {
  h.Add(s.v_OB);
  h.Add(s.yaw);
  h.Add(s.yaw_rate);
}

void AddTo(base::RollingHash& h, const stack::Estimate& e) {
  h.Add(e.stamp);
  h.Add(e.X_OB);
  h.Add(e.v_OB);
  h.Add(e.w_B);
  h.Add(e.X_MO);
  h.Add(std::uint64_t{e.reset_counter});
  for (int i = 0; i < 6; ++i) h.Add(e.pose_covariance(i, i));
}

}  // namespace

void RunDigest::Add(const StepView& step) {
  const vehicles::BodyState& state = step.truth.at_end;
  truth.Add(state.X_WB);
  truth.Add(state.v_WB);
  truth.Add(state.w_B);
  for (const stack::Measurement& m : step.measurements) {
    measurements.Add(static_cast<std::uint64_t>(m.sensor));
    measurements.Add(std::uint64_t{m.seq});
    measurements.Add(m.captured);
    measurements.Add(m.available);
    std::visit([this](const auto& data) { AddTo(measurements, data); }, m.data);
  }
  if (step.output == nullptr) return;
  if (step.output->estimate) AddTo(estimates, *step.output->estimate);
  for (const stack::Command& command : step.output->commands) {
    commands.Add(std::uint64_t{command.what.index()});
    commands.Add(command.issued);
    commands.Add(command.expires);
    std::visit([this](const auto& what) { AddTo(commands, what); }, command.what);
  }
  for (const stack::StackEvent& event : step.output->events) {
    events.Add(event.time);
    events.Add(std::string_view(event.kind));
    events.Add(std::string_view(event.text));
  }
}

std::string RunDigest::Hex() const {
  base::RollingHash all;
  for (const base::RollingHash* h : {&truth, &estimates, &commands, &events, &measurements}) all.Add(h->value());
  return all.Hex();
}

}  // namespace alula::sim

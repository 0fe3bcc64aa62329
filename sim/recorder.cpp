#include "sim/recorder.h"

#include <fmt/format.h>

#include <iterator>

namespace alula::sim {
namespace {

/// A part that touches again within this time is still touching: rattling is one event.
constexpr base::Duration kNewContact = base::Milliseconds(200);

constexpr const char* ModeName(stack::VehicleStatus::Mode mode) {
  switch (mode) {
    case stack::VehicleStatus::Mode::kDisarmed:
      return "disarmed";
    case stack::VehicleStatus::Mode::kReady:
      return "ready";
    case stack::VehicleStatus::Mode::kFollowing:
      return "following";
    case stack::VehicleStatus::Mode::kHolding:
      return "holding";
    case stack::VehicleStatus::Mode::kLanding:
      return "landing";
  }
  return "unknown";
}

std::string JsonText(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string TumLine(base::Time t, const base::Transform& X) {
  return fmt::format("{:.9f} {:.6f} {:.6f} {:.6f} {:.8f} {:.8f} {:.8f} {:.8f}\n", t.Seconds(), X.p.x(), X.p.y(),
                     X.p.z(), X.q.x(), X.q.y(), X.q.z(), X.q.w());
}

const stack::PositionSetpoint* LastSetpoint(const StepView& step) {
  const stack::PositionSetpoint* last = nullptr;
  if (step.output == nullptr) return last;
  for (const stack::Command& command : step.output->commands) {
    if (const auto* setpoint = std::get_if<stack::PositionSetpoint>(&command.what)) last = setpoint;
  }
  return last;
}

}  // namespace

std::string EventLine(base::Time time, std::string_view source, std::string_view kind, std::string_view text) {
  return fmt::format("{{\"t_s\": {:.6f}, \"source\": {}, \"kind\": {}, \"text\": {}}}\n", time.Seconds(),
                     JsonText(source), JsonText(kind), JsonText(text));
}

void Describe(base::Description& d, RecorderConfig& c) {
  d.Field("truth_rate", c.truth_rate, {.unit = "Hz", .meaning = "lines of truth.tum"});
  d.Field("estimate_rate", c.estimate_rate, {.unit = "Hz", .meaning = "lines of estimate.tum, at most"});
  d.Field("telemetry_rate", c.telemetry_rate, {.unit = "Hz", .meaning = "lines of telemetry.csv"});
  d.Field("actors_rate", c.actors_rate, {.unit = "Hz", .meaning = "poses of each moving actor in actors.csv"});
  d.Field("digest_interval", c.digest_interval,
          {.unit = "s", .meaning = "simulated time from one line of digests.csv to the next", .min = 1e-3});
}

bool Recorder::Clock::Passes(base::Time now) {
  if (rate.SampleTime(n) > now) return false;
  while (rate.SampleTime(n) <= now) ++n;
  return true;
}

Recorder::Recorder(const RecorderConfig& config, const RunFolder& folder)
    : truth_(folder.PathOf("truth.tum")),
      estimate_(folder.PathOf("estimate.tum")),
      events_(folder.PathOf("events.jsonl")),
      telemetry_(folder.PathOf("telemetry.csv")),
      truth_clock_{config.truth_rate},
      estimate_clock_{config.estimate_rate},
      telemetry_clock_{config.telemetry_rate} {}

void Recorder::AddEvent(base::Time time, std::string_view source, std::string_view kind, std::string_view text) {
  events_.Write(EventLine(time, source, kind, text));
}

void Recorder::RecordEvents(const StepView& step) {
  if (step.output != nullptr) {
    for (const stack::StackEvent& event : step.output->events) AddEvent(event.time, "stack", event.kind, event.text);
  }
  for (const stack::StackEvent& event : step.fault_events) AddEvent(event.time, "fault", event.kind, event.text);
  if (step.status.mode != last_status_.mode)
    AddEvent(step.truth.begin, "autopilot", "mode", ModeName(step.status.mode));
  if (step.status.ready_to_arm != last_status_.ready_to_arm) {
    AddEvent(step.truth.begin, "autopilot", step.status.ready_to_arm ? "ready_to_arm" : "not_ready_to_arm", "");
  }
  last_status_ = step.status;
  for (const Contact& contact : step.contacts) {
    const auto [entry, first] = touched_.try_emplace({contact.part, contact.object}, step.time);
    if (first || step.time - entry->second > kNewContact) {
      AddEvent(step.time, "world", "contact", fmt::format("{} touches {}", contact.part, contact.object));
    }
    entry->second = step.time;
  }
}

void Recorder::RecordTelemetry(const StepView& step) {
  const std::vector<vehicles::TelemetryValue> extra = step.vehicle.Telemetry();
  line_.clear();
  auto out = std::back_inserter(line_);
  if (!telemetry_header_) {
    telemetry_header_ = true;
    fmt::format_to(out, "time_s,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s,");
    fmt::format_to(out,
                   "wind_x_m_s,wind_y_m_s,wind_z_m_s,mode,armed,thrust,set_x_m,set_y_m,set_z_m,set_yaw_rad,next_gate");
    for (std::size_t i = 0; i < step.actuators.motors.size(); ++i) fmt::format_to(out, ",motor{}", i);
    for (const vehicles::TelemetryValue& value : extra) fmt::format_to(out, ",{}", value.name);
    line_ += '\n';
  }
  const vehicles::BodyState& s = step.truth.at_end;
  fmt::format_to(out, "{:.6f},{:.5f},{:.5f},{:.5f},{:.7f},{:.7f},{:.7f},{:.7f}", step.time.Seconds(), s.X_WB.p.x(),
                 s.X_WB.p.y(), s.X_WB.p.z(), s.X_WB.q.w(), s.X_WB.q.x(), s.X_WB.q.y(), s.X_WB.q.z());
  for (const base::Vec3* v : {&s.v_WB, &s.w_B, &step.wind_W}) {
    fmt::format_to(out, ",{:.5f},{:.5f},{:.5f}", v->x(), v->y(), v->z());
  }
  fmt::format_to(out, ",{},{:d},{:.4f}", ModeName(step.status.mode), step.status.armed, step.status.thrust);
  if (const stack::PositionSetpoint* set = LastSetpoint(step)) {
    fmt::format_to(out, ",{:.4f},{:.4f},{:.4f},{:.4f}", set->p_OB.x(), set->p_OB.y(), set->p_OB.z(), set->yaw);
  } else {
    line_ += ",,,,";
  }
  fmt::format_to(out, ",{}", step.output != nullptr ? step.output->next_gate : 0);
  for (const double motor : step.actuators.motors) fmt::format_to(out, ",{:.5f}", motor);
  for (const vehicles::TelemetryValue& value : extra) fmt::format_to(out, ",{:.6g}", value.value);
  line_ += '\n';
  telemetry_.Write(line_);
}

std::optional<std::string> Recorder::Observe(const StepView& step) {
  if (truth_clock_.Passes(step.time)) truth_.Write(TumLine(step.time, step.truth.at_end.X_WB));
  if (step.output != nullptr && step.output->estimate && step.output->estimate->stamp > last_estimate_ &&
      estimate_clock_.Passes(step.time)) {
    const stack::Estimate& estimate = *step.output->estimate;
    last_estimate_ = estimate.stamp;
    estimate_.Write(TumLine(estimate.stamp, estimate.X_MO * estimate.X_OB));
  }
  RecordEvents(step);
  if (telemetry_clock_.Passes(step.time)) RecordTelemetry(step);
  return std::nullopt;
}

void Recorder::Finish() {
  truth_.Close();
  estimate_.Close();
  events_.Close();
  telemetry_.Close();
}

}  // namespace alula::sim

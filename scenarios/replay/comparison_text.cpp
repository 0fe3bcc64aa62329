#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scenarios/replay/first_difference.h"

namespace alula::scenarios::replay {
namespace {

/// "commands: position_setpoint.p_OB.z", "measurements: vehicle0/imu seq 812: angular_velocity.y", "truth: X_WB.p.x".
std::string Place(const Difference& d) {
  std::string place = d.stream;
  if (!d.record.empty()) place += ": " + d.record;
  if (d.field.empty()) return place;
  const bool dotted = !d.record.empty() && d.stream != sim::kStreamNames[static_cast<int>(sim::Stream::kMeasurements)];
  return place + (dotted ? "." : ": ") + d.field;
}

std::string Values(const Difference& d) {
  const std::string note = d.note.empty() ? "" : "; " + d.note;
  if (d.a && d.b) return fmt::format("{} in A, {} in B{}", *d.a, *d.b, note);
  const std::string& value = d.a ? *d.a : *d.b;
  return fmt::format("only in {}{}{}", d.a ? "A" : "B", value.empty() ? "" : " (" + value + ")", note);
}

using Json = nlohmann::ordered_json;

Json ValueOf(const std::optional<std::string>& value) { return value ? Json(*value) : Json(nullptr); }

}  // namespace

std::string ToText(const RunComparison& comparison) {
  std::string text;
  if (!comparison.config.empty()) text += "keys of the scenarios that differ:\n";
  for (const ConfigDifference& key : comparison.config) {
    text += fmt::format("  {}: {} in A, {} in B\n", key.path, key.a, key.b);
  }
  for (const std::string& note : comparison.notes) text += note + "\n";
  if (!comparison.first) return text + "no difference: the two runs are the same in every stream\n";
  const Difference& d = *comparison.first;
  return text +
         fmt::format("first difference at {} (step {}): {}: {}\n", TimeText(d.time), d.step, Place(d), Values(d));
}

std::string ToJson(const RunComparison& comparison) {
  Json json;
  json["same"] = !comparison.first.has_value();
  json["config"] = Json::array();
  for (const ConfigDifference& key : comparison.config) {
    json["config"].push_back({{"path", key.path}, {"a", key.a}, {"b", key.b}});
  }
  json["notes"] = comparison.notes;
  json["first"] = nullptr;
  if (comparison.first) {
    const Difference& d = *comparison.first;
    json["first"] = {{"time_s", d.time.Seconds()}, {"step", d.step},    {"stream", d.stream}, {"record", d.record},
                     {"field", d.field},           {"a", ValueOf(d.a)}, {"b", ValueOf(d.b)},  {"note", d.note}};
  }
  return json.dump(2) + "\n";
}

}  // namespace alula::scenarios::replay

#include "scenarios/replay/records.h"

#include <fmt/format.h>

#include <cmath>

#include "scenarios/replay/difference.h"

namespace alula::scenarios::replay {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

std::string Text(double value) {
  if (std::isnan(value)) return "nan";
  return fmt::format("{}", value == 0.0 ? 0.0 : value);  // the shortest text that reads back to the same bits
}

/// Takes a record's fields down in words.
class NameFields {
 public:
  explicit NameFields(std::vector<Field>& fields) : fields_(&fields) {}

  void operator()(std::string_view name, double value) { Add(name, Text(value)); }
  void operator()(std::string_view name, std::int64_t value) { Add(name, std::to_string(value)); }
  void operator()(std::string_view name, std::uint64_t value) { Add(name, std::to_string(value)); }
  void operator()(std::string_view name, base::Time value) { Add(name, TimeText(value)); }
  void operator()(std::string_view name, std::string_view value) { Add(name, '"' + std::string(value) + '"'); }
  void operator()(std::string_view name, const sim::Word& word) { Add(name, std::string(word.text)); }
  void operator()(std::string_view name, const base::Vec3& v) {
    for (int i = 0; i < 3; ++i) Add(fmt::format("{}.{}", name, kAxes[i]), Text(v[i]));
  }
  void operator()(std::string_view name, const base::Transform& X) {
    (*this)(fmt::format("{}.p", name), X.p);
    Add(fmt::format("{}.q.w", name), Text(X.q.w()));
    (*this)(fmt::format("{}.q", name), base::Vec3(X.q.vec()));
  }
  void Flags(std::initializer_list<sim::Flag> flags) {
    for (const sim::Flag& flag : flags) Add(flag.name, flag.on ? "true" : "false");
  }
  template <typename Matrix>
  void Diagonal(std::string_view name, const Matrix& m) {
    for (int i = 0; i < m.rows(); ++i) Add(fmt::format("{}({},{})", name, i, i), Text(m(i, i)));
  }
  template <typename Value>
  void Pixels(std::span<const Value> values, const sim::PixelGrid& grid) {
    fields_->push_back({"pixels", replay::Pixels{values, grid}});
  }

 private:
  void Add(std::string_view name, std::string text) { fields_->push_back({std::string(name), std::move(text)}); }

  std::vector<Field>* fields_;
};

struct NameSink {
  const SensorNames& sensors;
  std::vector<replay::Record> records;

  NameFields Record(sim::Stream stream, const sim::RecordName& name) {
    records.push_back({stream, NameOf(name), {}});
    return NameFields(records.back().fields);
  }
  std::string NameOf(const sim::RecordName& name) const {
    if (name.measurement == nullptr) return std::string(name.kind);
    const stack::SensorId id = name.measurement->sensor;
    const auto known = sensors.find(id);
    return fmt::format("{} seq {}",
                       known != sensors.end() ? known->second : fmt::format("sensor {}", static_cast<unsigned>(id)),
                       name.measurement->seq);
  }
};

}  // namespace

std::string TimeText(base::Time time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  constexpr std::size_t kDecimals = 9, kShown = 3;
  std::string text =
      fmt::format("{}{}.{:09}", time.ns < 0 ? "-" : "", std::abs(time.ns) / kSecond, std::abs(time.ns) % kSecond);
  const std::size_t shortest = text.size() - kDecimals + kShown;
  while (text.size() > shortest && text.back() == '0') text.pop_back();
  return text + " s";
}

KeptStep Keep(const sim::StepView& step, std::int64_t number) {
  KeptStep kept{number,
                step.truth.begin,
                step.time,
                step.truth.at_end,
                {step.measurements.begin(), step.measurements.end()},
                std::nullopt,
                {step.fault_events.begin(), step.fault_events.end()},
                step.actors.RootsOfTick(step.truth.begin, step.time)};
  if (step.output != nullptr) {
    kept.output.emplace();
    kept.output->commands = step.output->commands;
    kept.output->estimate = step.output->estimate;
    kept.output->events = step.output->events;
  }
  return kept;
}

SensorNames NamesOf(const stack::Calibration& calibration) {
  SensorNames names{{calibration.status_sensor, calibration.vehicle + "/status"},
                    {calibration.battery_sensor, calibration.vehicle + "/battery"}};
  const auto add = [&names](const auto& sensor) { names[sensor.sensor] = sensor.name; };
  for (const stack::CameraCalibration& camera : calibration.cameras) add(camera);
  for (const stack::GimbalCalibration& gimbal : calibration.gimbals) add(gimbal);
  if (calibration.imu) add(*calibration.imu);
  if (calibration.barometer) add(*calibration.barometer);
  if (calibration.position_reference) add(*calibration.position_reference);
  if (calibration.gnss) add(*calibration.gnss);
  if (calibration.magnetometer) add(*calibration.magnetometer);
  return names;
}

std::vector<Record> NameRecords(const KeptStep& step, const SensorNames& sensors) {
  NameSink sink{sensors, {}};
  sim::VisitRun(sim::StepRecords{step.truth, step.measurements, step.output ? &*step.output : nullptr,
                                 step.fault_events, step.X_WR},
                sink);
  return std::move(sink.records);
}

}  // namespace alula::scenarios::replay

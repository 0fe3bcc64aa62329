#include "sim/faults/spike.h"

#include <fmt/format.h>

#include <map>

namespace alula::sim::faults {
namespace {

class Spiking : public Fault {
 public:
  Spiking(const Spike& config, std::vector<Sensor> sensors, std::uint64_t seed, const std::string& name)
      : sensors_(std::move(sensors)), offset_(config.offset), share_(config.share) {
    for (const Sensor& sensor : sensors_) streams_.try_emplace(sensor.id, seed, "faults/" + name + "/" + sensor.name);
  }
  std::string Words() const override {
    return fmt::format("{}: {:.4g} of the readings are off by ±{}", NamesOf(sensors_), share_, Listed(offset_));
  }
  bool Concerns(stack::SensorId id) const override { return Contains(sensors_, id); }
  /// Two numbers a reading, whatever comes of them.
  void Arrive(stack::Measurement& m, bool struck) override {
    if (!struck) return;
    base::RandomStream& stream = streams_.at(m.sensor);
    const bool off = stream.Uniform() < share_;
    const double side = stream.Uniform() < 0.5 ? -1.0 : 1.0;
    if (off) Add(offset_, side, m.data);
  }

 private:
  std::vector<Sensor> sensors_;
  Offsets offset_;
  double share_;
  std::map<stack::SensorId, base::RandomStream> streams_;
};

}  // namespace

void Describe(base::Description& d, Spike& c) {
  DescribeTiming(d, c);
  DescribeSensors(d, c.sensor);
  DescribeOffsets(d, c.offset);
  d.Field("share", c.share, {.meaning = "of its readings that is off", .min = 1e-6, .max = 1});
}

std::unique_ptr<Fault> Make(const Spike& config, const Scope& scope, std::uint64_t seed, const std::string& name) {
  std::vector<Sensor> sensors = Choose(config.sensor, scope);
  CheckOffsets(config.offset, sensors, config.sensor.origin);
  return std::make_unique<Spiking>(config, std::move(sensors), seed, name);
}

}  // namespace alula::sim::faults

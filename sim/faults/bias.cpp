#include "sim/faults/bias.h"

namespace alula::sim::faults {
namespace {

class Biasing : public Fault {
 public:
  Biasing(std::vector<Sensor> sensors, const Offsets& offset) : sensors_(std::move(sensors)), offset_(offset) {}
  std::string Words() const override { return NamesOf(sensors_) + ": off by " + Listed(offset_); }
  bool Concerns(stack::SensorId id) const override { return Contains(sensors_, id); }
  void Arrive(stack::Measurement& m, bool struck) override {
    if (struck) Add(offset_, 1.0, m.data);
  }

 private:
  std::vector<Sensor> sensors_;
  Offsets offset_;
};

}  // namespace

void Describe(base::Description& d, Bias& c) {
  DescribeTiming(d, c);
  DescribeSensors(d, c.sensor);
  DescribeOffsets(d, c.offset);
}

std::unique_ptr<Fault> Make(const Bias& config, const Scope& scope, std::uint64_t, const std::string&) {
  std::vector<Sensor> sensors = Choose(config.sensor, scope);
  CheckOffsets(config.offset, sensors, config.sensor.origin);
  return std::make_unique<Biasing>(std::move(sensors), config.offset);
}

}  // namespace alula::sim::faults

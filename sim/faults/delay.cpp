#include "sim/faults/delay.h"

#include <fmt/format.h>

namespace alula::sim::faults {
namespace {

class Delaying : public Fault {
 public:
  Delaying(std::vector<Sensor> sensors, base::Duration by) : sensors_(std::move(sensors)), by_(by) {}
  std::string Words() const override {
    return fmt::format("{}: measurements arrive {:.6g} s late", NamesOf(sensors_), by_.Seconds());
  }
  bool Concerns(stack::SensorId id) const override { return Contains(sensors_, id); }
  bool Take(stack::Measurement& m) override {
    m.available += by_;
    return true;
  }

 private:
  std::vector<Sensor> sensors_;
  base::Duration by_;
};

}  // namespace

void Describe(base::Description& d, Delay& c) {
  DescribeTiming(d, c);
  DescribeSensors(d, c.sensor);
  d.Field("by", c.by,
          {.unit = "s", .meaning = "so much later than they would", .min = 1e-6, .max = 60, .required = true});
}

std::unique_ptr<Fault> Make(const Delay& config, const Scope& scope, std::uint64_t, const std::string&) {
  return std::make_unique<Delaying>(Choose(config.sensor, scope), config.by);
}

}  // namespace alula::sim::faults

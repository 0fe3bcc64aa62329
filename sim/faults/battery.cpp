#include "sim/faults/battery.h"

#include <fmt/format.h>

#include "base/error.h"

namespace alula::sim::faults {
namespace {

class FailingBattery : public Fault {
 public:
  FailingBattery(double resistance, double voltage) : resistance_(resistance), voltage_(voltage) {}
  std::string Words() const override {
    return fmt::format("battery: {:.4g} times the internal resistance, {:.4g} of the open-circuit voltage", resistance_,
                       voltage_);
  }
  void Impair(Impairments& impairments) const override {
    impairments.vehicle.battery_resistance *= resistance_;
    impairments.vehicle.battery_voltage *= voltage_;
  }

 private:
  double resistance_, voltage_;
};

}  // namespace

void Describe(base::Description& d, Battery& c) {
  DescribeTiming(d, c);
  d.Field("resistance", c.resistance,
          {.meaning = "factor on its internal resistance", .min = 1, .max = 1000, .origin = &c.origin});
  d.Field("voltage", c.voltage,
          {.meaning = "share of its open-circuit voltage that is left", .min = 0.01, .max = 1, .origin = &c.origin});
  d.Check("voltage", [&c] {
    return c.resistance > 1.0 || c.voltage < 1.0 ? "" : "the battery is as good as ever; give resistance or voltage";
  });
}

std::unique_ptr<Fault> Make(const Battery& config, const Scope& scope, std::uint64_t, const std::string&) {
  if (scope.motors == 0) {
    throw base::InputError(config.origin.where, config.origin.path, "this vehicle's battery drives no motors");
  }
  return std::make_unique<FailingBattery>(config.resistance, config.voltage);
}

}  // namespace alula::sim::faults

#include "sim/faults/drop.h"

#include <fmt/format.h>

#include <map>

namespace alula::sim::faults {
namespace {

class Dropping : public Fault {
 public:
  Dropping(const Drop& config, const Scope& scope, std::uint64_t seed, const std::string& name)
      : sensors_(Choose(config.sensor, scope)), share_(config.share) {
    for (const Sensor& sensor : sensors_) streams_.try_emplace(sensor.id, seed, "faults/" + name + "/" + sensor.name);
  }
  std::string Words() const override {
    return share_ < 1.0 ? fmt::format("{}: {:.4g} of all measurements are lost", NamesOf(sensors_), share_)
                        : NamesOf(sensors_) + ": every measurement is lost";
  }
  bool Concerns(stack::SensorId id) const override { return Contains(sensors_, id); }
  bool Take(stack::Measurement& m) override { return share_ < 1.0 && streams_.at(m.sensor).Uniform() >= share_; }

 private:
  std::vector<Sensor> sensors_;
  double share_;
  std::map<stack::SensorId, base::RandomStream> streams_;
};

}  // namespace

void Describe(base::Description& d, Drop& c) {
  DescribeTiming(d, c);
  DescribeSensors(d, c.sensor);
  d.Field("share", c.share, {.meaning = "of its measurements that is lost", .min = 1e-6, .max = 1});
}

std::unique_ptr<Fault> Make(const Drop& config, const Scope& scope, std::uint64_t seed, const std::string& name) {
  return std::make_unique<Dropping>(config, scope, seed, name);
}

}  // namespace alula::sim::faults

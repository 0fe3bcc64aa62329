#include "sim/faults/freeze.h"

#include <map>

namespace alula::sim::faults {
namespace {

using Data = decltype(stack::Measurement::data);

/// What was measured before, with the exposure of now: a driver stamps frames, not what is in them.
void Repeat(const Data& before, Data& now) {
  const auto* image = std::get_if<stack::Image>(&now);
  const auto* depth = std::get_if<stack::DepthImage>(&now);
  const base::Time exposed = image != nullptr   ? image->exposure_start
                             : depth != nullptr ? depth->exposure_start
                                                : base::Time{};
  now = before;
  if (auto* frozen = std::get_if<stack::Image>(&now)) frozen->exposure_start = exposed;
  if (auto* frozen = std::get_if<stack::DepthImage>(&now)) frozen->exposure_start = exposed;
}

class Freezing : public Fault {
 public:
  explicit Freezing(std::vector<Sensor> sensors) : sensors_(std::move(sensors)) {}
  std::string Words() const override { return NamesOf(sensors_) + ": the last measurement over and over again"; }
  bool Concerns(stack::SensorId id) const override { return Contains(sensors_, id); }
  /// One that never measured before is stuck at its first reading.
  void Arrive(stack::Measurement& m, bool struck) override {
    const auto [last, first] = last_.try_emplace(m.sensor, m.data);
    if (struck) {
      Repeat(last->second, m.data);
    } else if (!first) {
      last->second = m.data;
    }
  }

 private:
  std::vector<Sensor> sensors_;
  std::map<stack::SensorId, Data> last_;
};

}  // namespace

void Describe(base::Description& d, Freeze& c) {
  DescribeTiming(d, c);
  DescribeSensors(d, c.sensor);
}

std::unique_ptr<Fault> Make(const Freeze& config, const Scope& scope, std::uint64_t, const std::string&) {
  return std::make_unique<Freezing>(Choose(config.sensor, scope));
}

}  // namespace alula::sim::faults

#include "tests/fuzz/faults_entry.h"

#include <cmath>
#include <string_view>

#include "base/config.h"
#include "base/error.h"
#include "sim/faults/injector.h"
#include "tests/fuzz/expect.h"

namespace alula::fuzz {
namespace {

namespace faults = sim::faults;

struct FaultList {
  std::vector<faults::Config> faults;
};
void Describe(base::Description& d, FaultList& c) { faults::DescribeFaults(d, c.faults); }

FaultList Read(std::string_view text) {
  return base::ReadConfig<FaultList>(base::YamlDocument::Parse(text, "faults.yaml"), 1);
}

faults::Scope Everything() {
  faults::Scope scope{{}, 4, 5, true, true};
  std::uint16_t id = 1;
  const auto add = [&](const char* name, decltype(stack::Measurement::data) sample) {
    scope.sensors.push_back({name, stack::SensorId{id++}, std::move(sample)});
  };
  add("imu", stack::ImuSample{});
  add("barometer", stack::BaroSample{});
  add("position_reference", stack::PositionFix{});
  add("magnetometer", stack::MagSample{});
  add("battery", stack::BatterySample{});
  add("status", stack::VehicleStatus{});
  add("gimbal.0", stack::GimbalAngles{});
  stack::Image image;
  image.bytes = std::make_shared<const std::vector<std::uint8_t>>(4, 100);
  add("camera.left", image);
  stack::DepthImage depth;
  depth.millimetres = std::make_shared<const std::vector<std::uint16_t>>(4, 900);
  add("camera.depth", depth);
  return scope;
}

/// Some seconds of a flight that climbs, passes gates and lands.
void Fly(faults::Injector& injector, const faults::Scope& scope) {
  using Mode = stack::VehicleStatus::Mode;
  for (std::int64_t i = 0; i < 100; ++i) {
    const base::Time now{i * 100'000'000};
    injector.Advance({.now = now,
                      .height = 0.05 * static_cast<double>(i),
                      .speed = 0.03 * static_cast<double>(i),
                      .target_distance = 10.0 - 0.1 * static_cast<double>(i),
                      .gates_passed = static_cast<int>(i / 20),
                      .mode = i < 80 ? Mode::kFollowing : Mode::kLanding});
    for (const faults::Sensor& sensor : scope.sensors) {
      stack::Measurement m{sensor.id, static_cast<std::uint32_t>(i), now, now, sensor.sample};
      faults::Numbers struck_by;
      if (!injector.Take(m, struck_by)) continue;
      Expect(m.available >= now, "a measurement arrives before it was taken");
      injector.Arrive(m, struck_by);
      Expect(m.data.index() == sensor.sample.index(), "a measurement of another kind");
    }
  }
}

}  // namespace

void ReadFaults(const std::uint8_t* data, std::size_t size) {
  try {
    const FaultList list = Read({reinterpret_cast<const char*>(data), size});
    const std::string dump = base::DumpConfig(list);
    Expect(base::DumpConfig(Read(dump)) == dump, "a list of faults came back changed");
    const faults::Scope scope = Everything();
    faults::Injector injector(list.faults, scope, 1);
    Fly(injector, scope);
  } catch (const base::InputError&) {
    return;
  }
}

}  // namespace alula::fuzz

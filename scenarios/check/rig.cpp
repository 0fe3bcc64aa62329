#include "scenarios/check/rig.h"

#include <cmath>
#include <utility>

namespace alula::scenarios::check {

Rig WithoutCamerasAndImu(Rig rig) {
  rig.sensors.imu.reset();
  rig.sensors.stereo.reset();
  rig.sensors.cameras.clear();
  rig.sensors.rgbd.clear();
  return rig;
}

Motion Rest(const base::Transform& X_WB) {
  return [X_WB](base::Time) { return vehicles::BodyState{X_WB, base::Vec3::Zero(), base::Vec3::Zero()}; };
}

void Record(const Rig& rig, render::CameraRenderer* renderer, const Motion& motion, base::Duration duration,
            const Sink& sink, const std::vector<Turn>& turns) {
  sim::SensorSuite suite(rig.sensors, rig.body, rig.step, rig.seed, kVehicle, renderer, 1);
  const sim::OwnReports reports{rig.battery, {}, {}};
  const sim::Ambience ambience{rig.rotors, rig.v_air_B, rig.rotor_height, rig.B_W};
  sim::TruthWindow truth{{0}, {0}, motion({0}), motion({0}), ambience};
  suite.Settle(truth.at_end);
  std::vector<stack::Measurement> arrived;
  std::size_t turned = 0;
  while (truth.end <= base::Time{} + duration) {
    suite.Measure(truth, reports);
    suite.Collect(truth.end, arrived);
    for (stack::Measurement& measurement : arrived) sink(std::move(measurement));
    for (; turned < turns.size() && turns[turned].at <= truth.end; ++turned) suite.Obey(turns[turned].setpoint);
    const base::Time next = truth.end + rig.step;
    truth = {truth.end, next, truth.at_end, motion(next), ambience};
    suite.Integrate(next, truth.at_begin, truth.at_end, ambience);
  }
}

std::vector<stack::Measurement> Record(const Rig& rig, render::CameraRenderer* renderer, const Motion& motion,
                                       base::Duration duration, const std::vector<Turn>& turns) {
  std::vector<stack::Measurement> all;
  Record(
      rig, renderer, motion, duration, [&all](stack::Measurement&& m) { all.push_back(std::move(m)); }, turns);
  return all;
}

}  // namespace alula::scenarios::check

#include <cmath>
#include <limits>

#include "scenarios/check/check_worlds.h"
#include "scenarios/check/shutter_check.h"
#include "sim/sensors/exposure.h"
#include "sim/sensors/optics.h"

namespace alula::scenarios::check {
namespace {

using base::Transform;
using base::Vec3;

/// Before the board, turning and gliding at once: `turn` rad/s about an oblique axis.
vehicles::BodyState Drift(base::Time t, double turn, const Transform& X_BC) {
  const double s = t.Seconds() - 0.25;
  const auto pose = [&](double time) {
    const Transform X_TC{base::Exp(turn * time * Vec3(0.4, 0.8, 0.45)),
                         Vec3(0.1, -0.05, -0.9) + 0.3 * turn * time * Vec3(1.0, 0.3, 0.5)};
    return BodyPose(ChartPose() * X_TC, X_BC);
  };
  constexpr double h = 1e-4;  // s
  vehicles::BodyState state;
  state.X_WB = pose(s);
  state.v_WB = (pose(s + h).p - pose(s - h).p) / (2.0 * h);
  state.w_B = base::Log(pose(s - h).q.conjugate() * pose(s + h).q) / (2.0 * h);
  return state;
}

/// The picture that the camera would take with as many sub-frames as there may be.
stack::Image Reference(const Rig& rig, const sim::CameraConfig& config, const CameraGeometry& camera,
                       const Motion& motion, base::Time captured, render::CameraRenderer& renderer) {
  const auto lens = std::make_shared<const render::Lens>(camera.intrinsics);
  const sim::Optics optics{config, camera.intrinsics, lens, camera.name, rig.seed, {}};
  constexpr double kFinest = 1e-9;  // px: as many sub-frames as are allowed
  const auto at = [&](base::Time t) {
    const Transform X_WB = motion(t).X_WB;
    return sim::Instant{X_WB * camera.X_BC, X_WB};
  };
  return sim::TakeImage(
      optics, sim::PlanExposure(config, camera.intrinsics.fx, {config.exposure, 1.0}, captured, at, kFinest), renderer);
}

}  // namespace

void CheckSubFrames(const Rig& isolated, const CameraGroup& group, sim::CameraConfig config,
                    const CameraGeometry& camera, Report& report) {
  if (!config.motion_blur && config.row_delay.ns == 0) return;
  const Rig rig = WithoutNoise(isolated, group);
  config.noise = ConfigOf(rig.sensors, Only(group)).noise;
  config.sees_vehicle = false;
  const double span = 2e-9 * static_cast<double>(sim::HalfSpan(config, config.exposure).ns);
  const double turn = 20.0 / (camera.intrinsics.fx * span);  // 20 px during the exposure of all rows
  const Motion motion = [&](base::Time t) { return Drift(t, turn, camera.X_BC); };
  const auto renderer = render::MakeRenderer(rig.render, BoardWorld(), {});
  const std::int64_t n = std::max<std::int64_t>(1, NearestFrame(config.rate, base::Time{} + base::Milliseconds(250)));
  const base::Time captured = config.rate.SampleTime(n);
  const base::Duration duration = captured - base::Time{} + config.read_out + rig.step;
  double difference = std::numeric_limits<double>::quiet_NaN();
  for (const stack::Measurement& m : Record(rig, renderer.get(), motion, duration)) {
    const auto* image = std::get_if<stack::Image>(&m.data);
    if (image == nullptr || m.sensor != camera.sensor || m.captured != captured) continue;
    const stack::Image reference = Reference(rig, config, camera, motion, captured, *renderer);
    double sum = 0.0;
    for (std::size_t i = 0; i < image->bytes->size(); ++i) {
      sum += std::abs(static_cast<double>((*image->bytes)[i]) - (*reference.bytes)[i]);
    }
    difference = sum / static_cast<double>(image->bytes->size());
  }
  report.Add(Compare(camera.name, "mean difference to 64 sub-frames", 0.0, difference, 1.0, "level"));
}

}  // namespace alula::scenarios::check

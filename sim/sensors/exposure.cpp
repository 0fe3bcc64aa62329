#include "sim/sensors/exposure.h"

#include <algorithm>
#include <cmath>

namespace alula::sim {
namespace {

constexpr int kMostInstants = 64;

/// How far the picture moves between two instants, px.
double PixelMotion(const Instant& a, const Instant& b, double focal) {
  constexpr double kNearThings = 1.5;  // m
  const double turn = base::Log(a.X_WC.q.conjugate() * b.X_WC.q).norm();
  return focal * (turn + (b.X_WC.p - a.X_WC.p).norm() / kNearThings);
}

/// The same along the way from `begin` to `end`, in steps of a millisecond: a shaking camera comes back.
double PixelsTravelled(base::Time begin, base::Time end, double focal, const std::function<Instant(base::Time)>& at) {
  constexpr base::Duration kStep = base::Milliseconds(1);
  double travelled = 0.0;
  Instant before = at(begin);
  for (base::Time t = begin; t < end;) {
    t = std::min(t + kStep, end);
    const Instant now = at(t);
    travelled += PixelMotion(before, now, focal);
    before = now;
  }
  return travelled;
}

int Parts(double pixels, double step, int most) {
  return static_cast<int>(std::clamp(std::ceil(pixels / step), 1.0, static_cast<double>(most)));
}

}  // namespace

base::Duration HalfSpan(const CameraConfig& config, base::Duration length) {
  return base::Nanoseconds(length.ns / 2 + config.row_delay.ns * (config.height - 1) / 2);
}

Exposure PlanExposure(const CameraConfig& config, double focal, const ExposureSetting& setting, base::Time captured,
                      const std::function<Instant(base::Time)>& at, double step, double seen_speed) {
  Exposure exposure;
  exposure.captured = captured;
  exposure.setting = setting;
  const base::Duration half_exposure = base::Nanoseconds(setting.length.ns / 2);
  const base::Duration half_roll = base::Nanoseconds(config.row_delay.ns * (config.height - 1) / 2);
  // What the camera does and what moves by itself may add up.
  const auto travelled = [&](base::Duration half) {
    return PixelsTravelled(captured - half, captured + half, focal, at) + 2.0 * half.Seconds() * seen_speed * focal;
  };
  int bands = 1;
  if (config.row_delay.ns > 0) {
    constexpr double kFiner = 0.35;  // a band's rows are off by up to half a step, all to one side: it shows sooner
    bands = Parts(travelled(half_roll), kFiner * step, std::min(config.height, kMostInstants));
  }
  int instants = 1;
  if (config.motion_blur) {
    instants = Parts(travelled(half_exposure), step, kMostInstants);
  }
  for (int band = 0; band < bands; ++band) {
    Exposure::Slice slice;
    slice.first_row = config.height * band / bands;
    slice.rows = config.height * (band + 1) / bands - slice.first_row;
    const double middle_row = slice.first_row + 0.5 * (slice.rows - 1) - 0.5 * (config.height - 1);
    const base::Time middle = captured + base::Seconds(middle_row * config.row_delay.Seconds());
    for (int i = 0; i < instants; ++i) {
      const double share = (i + 0.5) / instants - 0.5;
      slice.instants.push_back(at(middle + base::Seconds(share * setting.length.Seconds())));
    }
    exposure.slices.push_back(std::move(slice));
  }
  return exposure;
}

}  // namespace alula::sim

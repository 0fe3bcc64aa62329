#include "stack/planning/trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "stack/planning/speed_profile.h"

namespace alula::stack::planning {

using base::Vec3;

namespace {

constexpr double kYawPeriod = 0.04;     // s
constexpr double kYawBandwidth = 8.0;   // 1/s of the critically damped heading filter
constexpr double kYawSettled = 0.02;    // rad
constexpr double kYawTimeLimit = 20.0;  // s after the motion's end at which a turn is given up

/// The three control points that begin a spline with a given position, velocity and acceleration:
/// p = (c₋₁ + 4c₀ + c₁)/6, v = (c₁ − c₋₁)/2h, a = (c₁ − 2c₀ + c₋₁)/h².
std::array<Vec3, 3> StartControls(const TrajectoryPoint& state, double h) {
  const Vec3 middle = state.p_O - state.a_O * (h * h / 6.0);
  const Vec3 bend = state.a_O * (h * h / 2.0);
  return {middle + bend - state.v_O * h, middle, middle + bend + state.v_O * h};
}

/// A heading that follows a target within rate and acceleration.
class YawFilter {
 public:
  YawFilter(double yaw, double yaw_rate, double max_rate, double max_acceleration)
      : yaw_(yaw), rate_(yaw_rate), max_rate_(max_rate), max_acceleration_(max_acceleration) {}

  void Step(double error) {
    const double wanted = kYawBandwidth * (kYawBandwidth * error - 2.0 * rate_);
    const double before = rate_;
    rate_ += std::clamp(wanted, -max_acceleration_, max_acceleration_) * kYawPeriod;
    rate_ = std::clamp(rate_, -max_rate_, max_rate_);
    yaw_ += 0.5 * (before + rate_) * kYawPeriod;
  }
  double yaw() const { return yaw_; }
  double rate() const { return rate_; }

 private:
  double yaw_, rate_, max_rate_, max_acceleration_;
};

/// Heading of the path some way ahead of s; nothing where the path there is all but vertical or ends.
std::optional<double> LookAhead(const Curve& curve, double s, double distance) {
  const Vec3 from = curve.Position(s);
  const Vec3 to = curve.Position(s + distance);
  const Vec3 d = to - from;
  if (d.head<2>().norm() < 0.25) return std::nullopt;
  return std::atan2(d.y(), d.x());
}

}  // namespace

void Describe(base::Description& d, TrajectoryLimits& c) {
  d.Field("max_speed", c.max_speed, {.unit = "m/s", .meaning = "speed between gates", .min = 0.1, .max = 10});
  d.Field("max_climb_speed", c.max_climb_speed,
          {.unit = "m/s", .meaning = "vertical speed up or down", .min = 0.1, .max = 5});
  d.Field("max_acceleration", c.max_acceleration,
          {.unit = "m/s^2", .meaning = "planned acceleration as a whole", .min = 0.2, .max = 10});
  d.Field("lateral_share", c.lateral_share,
          {.meaning = "share of max_acceleration that curves may use", .min = 0.1, .max = 0.8});
  d.Field("max_yaw_rate", c.max_yaw_rate, {.unit = "rad/s", .meaning = "heading rate", .min = 0.1, .max = 6});
  d.Field("max_yaw_acceleration", c.max_yaw_acceleration,
          {.unit = "rad/s^2", .meaning = "change of heading rate", .min = 0.5, .max = 40});
  d.Field("yaw_look_ahead", c.yaw_look_ahead,
          {.unit = "m", .meaning = "the camera looks at the path this far ahead", .min = 0.3, .max = 5});
  d.Field("turn_first", c.turn_first,
          {.unit = "rad", .meaning = "from rest, motion waits until the heading is this near", .min = 0.1, .max = 3.2});
  d.Field("knot_period", c.knot_period,
          {.unit = "s", .meaning = "time between knots of the flown spline", .min = 0.05, .max = 0.5});
}

Trajectory Trajectory::Hover(base::Time start, const Vec3& p_O, double yaw) {
  Trajectory result;
  result.start_ = start;
  result.control_.assign(3, p_O);
  result.yaw_.assign(2, yaw);
  result.yaw_rate_.assign(2, 0.0);
  return result;
}

Trajectory Trajectory::Turn(base::Time start, const Vec3& p_O, double yaw, const std::vector<double>& headings,
                            double rate, const TrajectoryLimits& limits) {
  Trajectory result = Hover(start, p_O, yaw);
  YawFilter filter(yaw, 0.0, rate, limits.max_yaw_acceleration);
  result.yaw_.assign(1, yaw);
  result.yaw_rate_.assign(1, 0.0);
  for (const double heading : headings) {
    for (double time = 0.0; time < kYawTimeLimit; time += kYawPeriod) {
      if (std::abs(heading - filter.yaw()) < kYawSettled && std::abs(filter.rate()) < 0.1) break;
      filter.Step(heading - filter.yaw());
      result.yaw_.push_back(filter.yaw());
      result.yaw_rate_.push_back(filter.rate());
    }
  }
  result.yaw_.push_back(result.yaw_.back());
  result.yaw_rate_.push_back(0.0);
  return result;
}

Trajectory Trajectory::Brake(base::Time start, const TrajectoryPoint& state, const TrajectoryLimits& limits) {
  const auto controls = StartControls(state, limits.knot_period);
  const Vec3 step = controls[2] - controls[1];
  const double speed = step.norm() / limits.knot_period;
  if (speed < 0.02) return Hover(start, state.p_O, state.yaw);
  TrajectoryLimits hard = limits;
  hard.max_speed = std::max(limits.max_speed, speed);
  hard.max_climb_speed = std::max(limits.max_climb_speed, speed);
  hard.yaw_look_ahead = 0.01;  // keeps its heading
  const double distance = speed * speed / (2.0 * limits.max_acceleration) + 0.03;
  const Curve line({controls[2], controls[2] + step.normalized() * distance});
  if (auto result = Along(start, state, line, {}, hard)) return *result;
  return Hover(start, state.p_O, state.yaw);
}

Vec3 Trajectory::StartPoint(const TrajectoryPoint& state, const TrajectoryLimits& limits) {
  return StartControls(state, limits.knot_period)[2];
}

std::optional<Trajectory> Trajectory::Along(base::Time start, const TrajectoryPoint& state, const Curve& curve,
                                            const AlongOptions& options, const TrajectoryLimits& limits) {
  const double h = limits.knot_period;
  const auto controls = StartControls(state, h);
  const double start_speed = (controls[2] - controls[1]).norm() / h;
  const double stop_at = options.stop_at < 0.0 ? curve.length() : std::min(options.stop_at, curve.length());
  std::optional<SpeedProfile> profile;
  for (const double scale : {1.0, 1.4, 2.0}) {
    if (profile) break;
    profile = MakeSpeedProfile(curve, stop_at, start_speed, options.end_speed, options.zones, limits, scale);
  }
  if (!profile) return std::nullopt;

  Trajectory result;
  result.start_ = start;
  result.period_ = h;
  result.control_.assign(controls.begin(), controls.end());
  int hold = 0;
  if (start_speed < 0.1) {
    if (const auto heading = LookAhead(curve, 0.0, limits.yaw_look_ahead)) {
      const double excess = std::abs(base::WrapAngle(*heading - state.yaw)) - limits.turn_first;
      hold = std::max(0, static_cast<int>(std::ceil(excess / limits.max_yaw_rate / h)));
    }
    result.control_.insert(result.control_.end(), static_cast<std::size_t>(hold), controls[2]);
  }
  const double duration = profile->Duration();
  const auto knots = static_cast<int>(std::ceil(duration / h - 1e-9));
  for (int k = 1; k <= knots; ++k) result.control_.push_back(curve.Position(profile->At(h * k)));
  const Vec3 last = curve.Position(stop_at);
  const Vec3 glide = curve.Tangent(stop_at) * options.end_speed;
  if (options.end_speed > 0.0) {
    const double over = h * knots - duration;
    result.control_.back() = last + glide * over;
    result.control_.push_back(last + glide * (over + h));
  } else {
    result.control_.insert(result.control_.end(), 2, last);  // three equal ones end at rest, exactly there
  }

  // Heading: looks along the whole curve, also beyond the stop, so that what comes next is seen.
  YawFilter filter(state.yaw, state.yaw_rate, limits.max_yaw_rate, limits.max_yaw_acceleration);
  const double delay = h * (1 + hold);
  const double motion = delay + duration;
  double target = state.yaw;
  result.yaw_.push_back(state.yaw);
  result.yaw_rate_.push_back(state.yaw_rate);
  for (double time = 0.0; time < motion + kYawTimeLimit; time += kYawPeriod) {
    const double s = profile->At(time - delay);
    if (const auto heading = LookAhead(curve, s, limits.yaw_look_ahead)) target = *heading;
    if (options.final_yaw && curve.length() - s < 0.5) target = *options.final_yaw;
    const double error = base::WrapAngle(target - filter.yaw());
    if (time > motion && std::abs(error) < kYawSettled && std::abs(filter.rate()) < 0.1) break;
    filter.Step(error);
    result.yaw_.push_back(filter.yaw());
    result.yaw_rate_.push_back(filter.rate());
  }
  result.yaw_.push_back(result.yaw_.back());
  result.yaw_rate_.push_back(0.0);
  return result;
}

base::Time Trajectory::end() const {
  return start_ + base::Seconds(period_ * static_cast<double>(control_.size() - 3));
}

base::Time Trajectory::yaw_end() const {
  return start_ + base::Seconds(kYawPeriod * static_cast<double>(yaw_.size() - 1));
}

TrajectoryPoint Trajectory::Sample(base::Time t) const {
  TrajectoryPoint point;
  const double time = std::max((t - start_).Seconds(), 0.0);
  const auto spans = control_.size() - 3;
  const double u = time / period_;
  if (u >= static_cast<double>(spans)) {  // stands at its end
    const std::size_t n = control_.size();
    point.p_O = (control_[n - 3] + 4.0 * control_[n - 2] + control_[n - 1]) / 6.0;
  } else {
    const auto i = static_cast<std::size_t>(u);
    const double x = u - static_cast<double>(i);
    const double y = 1.0 - x;
    const Vec3 &a = control_[i], &b = control_[i + 1], &c = control_[i + 2], &d = control_[i + 3];
    point.p_O = (y * y * y * a + (3.0 * x * x * x - 6.0 * x * x + 4.0) * b + (3.0 * y * y * y - 6.0 * y * y + 4.0) * c +
                 x * x * x * d) /
                6.0;
    point.v_O = (y * y * (b - a) + (1.0 + 2.0 * x * y) * (c - b) + x * x * (d - c)) / (2.0 * period_);
    point.a_O = (y * (c - 2.0 * b + a) + x * (d - 2.0 * c + b)) / (period_ * period_);
  }
  const double k = std::min(time / kYawPeriod, static_cast<double>(yaw_.size() - 1));
  const auto j = std::min(static_cast<std::size_t>(k), yaw_.size() - 2);
  const double share = std::min(k - static_cast<double>(j), 1.0);
  const double turn = share * kYawPeriod;
  point.yaw_rate = yaw_rate_[j] + share * (yaw_rate_[j + 1] - yaw_rate_[j]);
  point.yaw = yaw_[j] + 0.5 * turn * (yaw_rate_[j] + point.yaw_rate);
  return point;
}

std::vector<Vec3> Trajectory::Points(base::Time from) const {
  std::vector<Vec3> points;
  base::Time t = std::max(from, start_);
  for (; t < end(); t += base::Seconds(period_)) points.push_back(Sample(t).p_O);
  points.push_back(Sample(end()).p_O);
  return points;
}

}  // namespace alula::stack::planning

#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/frames.h"
#include "base/random.h"
#include "base/time.h"
#include "stack/estimation/odometry.h"
#include "stack/interface/calibration.h"

namespace alula::stack::estimation::test {

using base::Quat;
using base::Time;
using base::Transform;
using base::Vec3;

/// Motion of the body at an instant.
struct Motion {
  Transform X_WB;
  Vec3 v_W = Vec3::Zero(), a_W = Vec3::Zero();
  Vec3 w_B = Vec3::Zero();
};

/// A quadrotor's flight along corners: rest on the ground, climb, a full turn of the yaw, then the corners at a given
/// speed with the yaw along the velocity, then hover. Smoothed by five box filters, so that jerk is continuous; the
/// attitude is the one whose thrust gives the acceleration.
class Flight {
 public:
  static constexpr double kStep = 1e-3;  // s

  Flight(const Vec3& start, double yaw, const std::vector<Vec3>& corners, double speed, double rest = 2.0,
         bool scan = true) {
    std::vector<Vec3> p;
    std::vector<double> heading;
    const auto hold = [&](const Vec3& at, double angle, double seconds) {
      for (int i = 0; i < static_cast<int>(seconds / kStep); ++i) p.push_back(at), heading.push_back(angle);
    };
    const auto go = [&](const Vec3& from, const Vec3& to, double v, double angle) {
      const int n = std::max(1, static_cast<int>((to - from).norm() / v / kStep));
      for (int i = 1; i <= n; ++i) {
        p.push_back(from + (to - from) * i / n);
        heading.push_back(angle);
      }
    };
    hold(start, yaw, rest + 1.0);
    Vec3 at = start + Vec3(0, 0, 1.2);
    go(start, at, 0.8, yaw);
    hold(at, yaw, 1.0);
    if (scan) {
      for (double a = 0; a < 2 * M_PI; a += 1.0 * kStep) p.push_back(at), heading.push_back(yaw + a);
      yaw += 2 * M_PI;
      hold(at, yaw, 1.0);
    }
    for (const Vec3& corner : corners) {
      const Vec3 d = corner - at;
      if (d.head<2>().norm() > 1e-6) yaw += base::WrapAngle(std::atan2(d.y(), d.x()) - yaw);
      if (&corner == &corners.front()) {  // turn before going
        const double from = heading.back();
        for (double a = 0; a < 1.0; a += kStep) p.push_back(at), heading.push_back(from + (yaw - from) * a);
      }
      go(at, corner, speed, yaw);
      at = corner;
    }
    hold(at, yaw, 2.0);
    for (int i = 0; i < 5; ++i) {
      Smooth(p, 250);
      Smooth(heading, 250);
    }
    Fill(p, heading);
  }

  Time end() const { return {static_cast<std::int64_t>(motion_.size() - 2) * 1'000'000}; }
  /// Length of the path up to the end, m.
  double length() const {
    double sum = 0;
    for (const Motion& m : motion_) sum += m.v_W.norm() * kStep;
    return sum;
  }
  Motion At(Time t) const {
    const std::int64_t last = static_cast<std::int64_t>(motion_.size()) - 2;
    const std::int64_t i = std::clamp<std::int64_t>(t.ns / 1'000'000, 0, last);
    const double dt = t.Seconds() - static_cast<double>(i) * kStep;
    Motion m = motion_[static_cast<std::size_t>(i)];
    m.X_WB.p += m.v_W * dt + 0.5 * m.a_W * dt * dt;
    m.v_W += m.a_W * dt;
    m.X_WB.q = (m.X_WB.q * base::Exp(m.w_B * dt)).normalized();
    return m;
  }

 private:
  template <typename T>
  static void Smooth(std::vector<T>& x, int half) {
    std::vector<T> sum(x.size() + 1, x[0] * 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) sum[i + 1] = sum[i] + x[i];
    const auto n = static_cast<int>(x.size());
    std::vector<T> out = x;
    for (int i = 0; i < n; ++i) {
      const int h = std::min({half, i, n - 1 - i});
      out[static_cast<std::size_t>(i)] =
          (sum[static_cast<std::size_t>(i + h + 1)] - sum[static_cast<std::size_t>(i - h)]) / (2.0 * h + 1.0);
    }
    x = out;
  }

  void Fill(const std::vector<Vec3>& p, const std::vector<double>& heading) {
    const std::size_t n = p.size();
    motion_.resize(n);
    const auto near = [n](std::size_t i) { return std::clamp<std::size_t>(i, 1, n - 2); };
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = near(k);
      motion_[k].v_W = (p[i + 1] - p[i - 1]) / (2 * kStep);
      motion_[k].a_W = (p[i + 1] - 2 * p[i] + p[i - 1]) / (kStep * kStep);
      const Vec3 z = (motion_[k].a_W + Vec3(0, 0, base::kGravity)).normalized();
      const Vec3 x_heading(std::cos(heading[k]), std::sin(heading[k]), 0);
      const Vec3 y = z.cross(x_heading).normalized();
      base::Mat3 R;
      R << y.cross(z), y, z;
      motion_[k].X_WB = {Quat(R), p[k]};
    }
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = near(k);
      motion_[k].w_B = base::Log(motion_[i - 1].X_WB.q.conjugate() * motion_[i + 1].X_WB.q) / (2 * kStep);
    }
  }

  std::vector<Motion> motion_;
};

/// IMU readings of a flight at 200 Hz: truth, turn-on biases and their walk, white noise.
inline std::vector<TimedImu> SimulateImu(const Flight& flight, const ImuCalibration& imu, std::uint64_t seed) {
  base::RandomStream random(seed, "test/imu");
  const ImuNoise& n = imu.noise;
  Vec3 gyro_bias = n.gyro_turn_on_bias * random.GaussianVec3();
  Vec3 accel_bias = n.accelerometer_turn_on_bias * random.GaussianVec3();
  std::vector<TimedImu> samples;
  constexpr double kRate = 200.0;
  for (Time t; t <= flight.end(); t += base::Milliseconds(5)) {
    const Motion m = flight.At(t), before = flight.At({std::max<std::int64_t>(0, t.ns - 1'000'000)}),
                 after = flight.At(t + base::Milliseconds(1));
    const double dt = after.X_WB.q.isApprox(before.X_WB.q, 0) ? 1.0 : 0.002;
    const Vec3 turn_rate = (after.w_B - before.w_B) / dt;
    const Vec3 p = imu.X_BI.p;
    const Vec3 f_B =
        m.X_WB.q.conjugate() * (m.a_W + Vec3(0, 0, base::kGravity)) + turn_rate.cross(p) + m.w_B.cross(m.w_B.cross(p));
    const Quat q_IB = imu.X_BI.q.conjugate();
    samples.push_back({t, q_IB * m.w_B + gyro_bias + n.gyro_noise * std::sqrt(kRate) * random.GaussianVec3(),
                       q_IB * f_B + accel_bias + n.accelerometer_noise * std::sqrt(kRate) * random.GaussianVec3()});
    gyro_bias += n.gyro_bias_walk / std::sqrt(kRate) * random.GaussianVec3();
    accel_bias += n.accelerometer_bias_walk / std::sqrt(kRate) * random.GaussianVec3();
  }
  return samples;
}

/// A stereo rig and IMU like the first mission's: 640×480, 80° wide, baseline 0.11 m, 20 Hz, camera looking forward.
inline Calibration TrueCalibration() {
  Calibration c;
  CameraCalibration camera;
  camera.intrinsics.width = 640;
  camera.intrinsics.height = 480;
  camera.intrinsics.fx = camera.intrinsics.fy = 320.0 / std::tan(40.0 * M_PI / 180.0);
  camera.intrinsics.cx = 319.5;
  camera.intrinsics.cy = 239.5;
  camera.rate = {20, 1};
  camera.X_BC = {base::ForwardCameraRotation(), Vec3(0.10, 0.055, 0.02)};
  c.cameras.push_back(camera);
  camera.X_BC.p.y() = -0.055;
  c.cameras.push_back(camera);
  c.stereo = {{0, 1}};
  ImuCalibration imu;
  imu.X_BI = {Quat::Identity(), Vec3(0.01, 0.0, 0.005)};
  imu.rate = {200, 1};
  imu.noise = {.gyro_noise = 1.7e-4,
               .accelerometer_noise = 2.0e-3,
               .gyro_bias_walk = 2.0e-5,
               .accelerometer_bias_walk = 3.0e-3,
               .gyro_turn_on_bias = 3.0e-3,
               .accelerometer_turn_on_bias = 0.05,
               .gyro_range = 17.5,
               .accelerometer_range = 176.5};
  c.imu = imu;
  return c;
}

/// The calibration as the stack is told it: wrong by `scale` times the errors of the design (0.2°, 2 mm; 0.02°, 0.1 %;
/// focal length 0.1 %). The time offset is drawn apart: DrawTimeOffset.
inline Calibration WrongCalibration(const Calibration& truth, std::uint64_t seed, double scale = 1.0) {
  base::RandomStream random(seed, "test/calibration");
  constexpr double kDegree = M_PI / 180.0;
  Calibration c = truth;
  CameraCalibration &left = c.cameras[0], &right = c.cameras[1];
  const Transform error{base::Exp(scale * 0.2 * kDegree * random.GaussianVec3()),
                        scale * 0.002 * random.GaussianVec3()};
  const Transform X_LR = left.X_BC.Inverse() * right.X_BC;
  Transform wrong_LR{X_LR.q * base::Exp(scale * 0.02 * kDegree * random.GaussianVec3()),
                     X_LR.p * (1.0 + scale * 0.001 * random.Gaussian())};
  left.X_BC = left.X_BC * error;
  right.X_BC = left.X_BC * wrong_LR;
  const double focal = 1.0 + scale * 0.001 * random.Gaussian();
  for (CameraCalibration* camera : {&left, &right}) {
    camera->intrinsics.fx *= focal;
    camera->intrinsics.fy *= focal;
  }
  return c;
}

/// How much later than its stamp an image was really taken, s.
inline double DrawTimeOffset(std::uint64_t seed) { return 0.002 * base::RandomStream(seed, "test/time").Gaussian(); }

/// RMS position error after the best yaw and shift, m.
inline double AlignedError(const std::vector<Vec3>& estimate, const std::vector<Vec3>& truth) {
  Vec3 me = Vec3::Zero(), mt = Vec3::Zero();
  const double n = static_cast<double>(estimate.size());
  for (std::size_t i = 0; i < estimate.size(); ++i) me += estimate[i] / n, mt += truth[i] / n;
  double c = 0, s = 0;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const Vec3 a = estimate[i] - me, b = truth[i] - mt;
    c += a.x() * b.x() + a.y() * b.y();
    s += a.x() * b.y() - a.y() * b.x();
  }
  const Quat q = base::FromYaw(std::atan2(s, c));
  double sum = 0;
  for (std::size_t i = 0; i < estimate.size(); ++i) sum += (q * (estimate[i] - me) + mt - truth[i]).squaredNorm();
  return std::sqrt(sum / n);
}

}  // namespace alula::stack::estimation::test

#include "scenarios/check/inertia_check.h"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scenarios/check/allan.h"
#include "scenarios/check/statistics.h"

namespace alula::scenarios::check {
namespace {

using base::Mat3;
using base::Vec3;

constexpr const char* kName = "vehicle0/imu";

struct Axes {
  std::vector<std::vector<double>> gyro = std::vector<std::vector<double>>(3);
  std::vector<std::vector<double>> accelerometer = std::vector<std::vector<double>>(3);
  base::Time first, last;
};

Axes RecordRest(const Rig& rig, base::Duration duration) {
  Axes axes;
  Record(ImuOnly(rig), nullptr, Rest({}), duration, [&axes](stack::Measurement&& m) {
    const auto* sample = std::get_if<stack::ImuSample>(&m.data);
    if (sample == nullptr) return;
    if (axes.gyro[0].empty()) axes.first = m.captured;
    axes.last = m.captured;
    for (int i = 0; i < 3; ++i) {
      axes.gyro[i].push_back(sample->angular_velocity[i]);
      axes.accelerometer[i].push_back(sample->specific_force[i]);
    }
  });
  return axes;
}

/// Long enough for the walk to rise well over the white noise: they cross at τ = √3 N/K.
base::Duration RestNeeded(const stack::ImuNoise& noise) {
  double seconds = 600.0;
  const auto need = [&seconds](double white, double walk) {
    if (walk > 0.0) seconds = std::max(seconds, 480.0 * std::sqrt(3.0) * white / walk);
  };
  need(noise.gyro_noise, noise.gyro_bias_walk);
  need(noise.accelerometer_noise, noise.accelerometer_bias_walk);
  return base::Seconds(std::min(7200.0, std::ceil(seconds)));
}

void AddDensities(const std::vector<std::vector<double>>& axes, double period, const char* what, double white,
                  double walk, const std::string& unit, const std::string& walk_unit, Report& report) {
  const NoiseDensities found = FitAllan(AllanCurve(axes), period);
  report.Add(Compare(kName, std::string(what) + " noise density (Allan)", white, found.white,
                     kSigmas * found.white_sigma, unit));
  report.Add(Compare(kName, std::string(what) + " bias walk (Allan)", walk, found.walk, kSigmas * found.walk_sigma,
                     walk_unit));
}

/// Rotation that best turns the rows of `from` into those of `to` (Kabsch 1976).
Mat3 Kabsch(const Eigen::MatrixX3d& from, const Eigen::MatrixX3d& to) {
  const Mat3 H = from.transpose() * to;
  const Eigen::JacobiSVD<Mat3> svd(H, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Mat3 sign = Vec3(1, 1, (svd.matrixV() * svd.matrixU().transpose()).determinant()).asDiagonal();
  return svd.matrixV() * sign * svd.matrixU().transpose();
}

Vec3 YawPitchRoll(const Mat3& R) {
  return {std::atan2(R(1, 0), R(0, 0)), std::asin(std::clamp(-R(2, 0), -1.0, 1.0)), std::atan2(R(2, 1), R(2, 2))};
}

Vec3 ForceAt(const Motion& motion, base::Time t) {
  constexpr base::Duration h = base::Microseconds(100);
  const Vec3 a_W = (motion(t + h).v_WB - motion(t - h).v_WB) / (2 * h.Seconds());
  return motion(t).X_WB.q.conjugate() * (a_W + Vec3(0, 0, base::kGravity));
}

void FitGyro(const std::vector<Rates>& rates, const std::vector<stack::ImuSample>& samples, InertialFit& fit) {
  const auto n = static_cast<Eigen::Index>(rates.size());
  Eigen::MatrixX3d truth(n, 3), read(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    truth.row(i) = rates[i].w_B;
    read.row(i) = samples[i].angular_velocity;
  }
  const Mat3 R_IB = Kabsch(truth.rowwise() - truth.colwise().mean(), read.rowwise() - read.colwise().mean());
  fit.R_BI = R_IB.transpose();
  // read = R_IB (w + offset dw) + bias
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3 * n, 4);
  Eigen::VectorXd b(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    A.block<3, 1>(3 * i, 0) = R_IB * rates[i].dw_B;
    A.block<3, 3>(3 * i, 1).setIdentity();
    b.segment<3>(3 * i) = samples[i].angular_velocity - R_IB * rates[i].w_B;
  }
  const Solution solution = LeastSquares(A, b);
  fit.gyro_offset = solution.x[0];
  fit.gyro_offset_sigma = solution.sigma[0];
  const double noise = solution.sigma[1] * std::sqrt(static_cast<double>(n));
  fit.angle_sigma = noise / (truth.rowwise() - truth.colwise().mean()).norm() * std::sqrt(1.5);
}

/// R_BI f_I = f_B + (Hat(dw) + Hat(w)²) p_BI + offset df_B + bias.
void FitAccelerometer(const std::vector<Rates>& rates, const std::vector<stack::ImuSample>& samples, InertialFit& fit) {
  const auto n = static_cast<Eigen::Index>(rates.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3 * n, 7);
  Eigen::VectorXd b(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Mat3 w = base::Hat(rates[i].w_B);
    A.block<3, 3>(3 * i, 0) = base::Hat(rates[i].dw_B) + w * w;
    A.block<3, 1>(3 * i, 3) = rates[i].df_B;
    A.block<3, 3>(3 * i, 4).setIdentity();
    b.segment<3>(3 * i) = fit.R_BI * samples[i].specific_force - rates[i].f_B;
  }
  const Solution solution = LeastSquares(A, b);
  fit.p_BI = solution.x.head<3>();
  fit.p_sigma = solution.sigma.head<3>();
  fit.accelerometer_offset = solution.x[3];
  fit.accelerometer_offset_sigma = solution.sigma[3];
}

/// The largest reading while turning, or being pushed, at twice the range along all axes at once.
double LargestReading(const Rig& rig, const Motion& motion, bool gyro) {
  double largest = 0.0;
  for (const stack::Measurement& m : Record(ImuOnly(rig), nullptr, motion, base::Milliseconds(300))) {
    if (const auto* s = std::get_if<stack::ImuSample>(&m.data)) {
      largest = std::max(largest, (gyro ? s->angular_velocity : s->specific_force).cwiseAbs().maxCoeff());
    }
  }
  return largest;
}

void AddSaturation(const Rig& rig, const sim::ImuConfig& claimed, Report& report) {
  const Vec3& a = claimed.orientation;
  const Vec3 along_B = base::FromYawPitchRoll(a.x(), a.y(), a.z()) * Vec3(1, 1, 1);
  if (claimed.noise.gyro_range > 0.0) {
    const Vec3 w_B = 2.0 * claimed.noise.gyro_range * along_B;
    const Motion spin = [w_B](base::Time t) {
      return vehicles::BodyState{{base::Exp(w_B * t.Seconds()), Vec3::Zero()}, Vec3::Zero(), w_B};
    };
    report.Add(
        Compare(kName, "gyro saturation", claimed.noise.gyro_range, LargestReading(rig, spin, true), 1e-9, "rad/s"));
  }
  if (claimed.noise.accelerometer_range > 0.0) {
    const Vec3 push_W = 2.0 * claimed.noise.accelerometer_range * along_B;
    const Motion thrown = [push_W](base::Time t) {
      const double s = t.Seconds();
      return vehicles::BodyState{{base::Quat::Identity(), 0.5 * s * s * push_W}, s * push_W, Vec3::Zero()};
    };
    report.Add(Compare(kName, "accelerometer saturation", claimed.noise.accelerometer_range,
                       LargestReading(rig, thrown, false), 1e-9, "m/s^2"));
  }
}

}  // namespace

Rig ImuOnly(const Rig& rig) {
  Rig bench = rig;
  bench.sensors = {};
  bench.sensors.imu = rig.sensors.imu;
  bench.sensors.barometer.reset();
  bench.sensors.battery_rate = bench.sensors.status_rate = {1, 1};
  return bench;
}

Rates RatesAt(const Motion& motion, base::Time t) {
  constexpr base::Duration h = base::Milliseconds(1);
  return {motion(t).w_B, (motion(t + h).w_B - motion(t - h).w_B) / (2 * h.Seconds()), ForceAt(motion, t),
          (ForceAt(motion, t + h) - ForceAt(motion, t - h)) / (2 * h.Seconds())};
}

void CheckInertiaAtRest(const Rig& rig, const sim::ImuConfig& claimed, Report& report) {
  const base::Duration duration = RestNeeded(claimed.noise);
  const Axes axes = RecordRest(rig, duration);
  const double intervals = static_cast<double>(axes.gyro[0].size()) - 1.0;
  const double period = (axes.last - axes.first).Seconds() / intervals;
  report.Add(Compare(kName, "rate", claimed.rate.Hz(), 1.0 / period, 1e-6 * claimed.rate.Hz(), "Hz"));
  AddDensities(axes.gyro, period, "gyro", claimed.noise.gyro_noise, claimed.noise.gyro_bias_walk, "rad/s/sqrt(Hz)",
               "rad/s^2/sqrt(Hz)", report);
  AddDensities(axes.accelerometer, period, "accelerometer", claimed.noise.accelerometer_noise,
               claimed.noise.accelerometer_bias_walk, "m/s^2/sqrt(Hz)", "m/s^3/sqrt(Hz)", report);
  report.Note("Allan deviation of the inertial unit: three axes over " +
              std::to_string(static_cast<int>(duration.Seconds())) + " s at rest");
}

void CheckTurnOnBias(const Rig& rig, const sim::ImuConfig& claimed, Report& report) {
  constexpr int kSeeds = 300;
  constexpr double kSamples = 50.0;                         // averaged after switching on
  std::array<std::array<std::vector<double>, 3>, 2> found;  // gyro, accelerometer; by axis
  for (int i = 0; i < kSeeds; ++i) {
    Rig one = rig;
    one.seed = rig.seed + static_cast<std::uint64_t>(i);
    const Axes axes = RecordRest(one, base::Seconds(kSamples * claimed.rate.Period()));
    for (int axis = 0; axis < 3; ++axis) {
      found[0][axis].push_back(SpreadOf(axes.gyro[axis]).mean);
      found[1][axis].push_back(SpreadOf(axes.accelerometer[axis]).mean);
    }
  }
  const auto add = [&report](const char* what, double configured, const std::array<std::vector<double>, 3>& axes,
                             double white, const char* unit) {
    double variance = -white * white / kSamples;    // what the mean's noise adds
    for (const std::vector<double>& axis : axes) {  // about each axis's mean, which holds gravity too
      const double sigma = SpreadOf(axis).sigma;
      variance += sigma * sigma / 3.0;
    }
    report.Add(Compare(kName, what, configured, std::sqrt(std::max(0.0, variance)),
                       kSigmas * SigmaError(std::hypot(configured, white / std::sqrt(kSamples)), 3.0 * kSeeds) +
                           (configured > 0.0 ? 0.0 : white / std::sqrt(kSamples)),
                       unit));
  };
  const double root_rate = std::sqrt(claimed.rate.Hz());
  add("gyro turn-on bias, 1 sigma", claimed.noise.gyro_turn_on_bias, found[0], claimed.noise.gyro_noise * root_rate,
      "rad/s");
  add("accelerometer turn-on bias, 1 sigma", claimed.noise.accelerometer_turn_on_bias, found[1],
      claimed.noise.accelerometer_noise * root_rate, "m/s^2");
}

vehicles::BodyState Shaken(base::Time t) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const auto sine = [](double amplitude, double hertz, double seconds) {
    return amplitude * std::sin(kTurn * hertz * seconds);
  };
  const auto attitude = [&sine](double s) {
    return base::FromYawPitchRoll(sine(0.25, 1.1, s), sine(0.2, 1.7, s), sine(0.2, 1.3, s));
  };
  const double s = t.Seconds();
  vehicles::BodyState state;
  const Vec3 amplitude(0.2, 0.25, 0.15), hertz(1.5, 1.2, 0.9);
  for (int i = 0; i < 3; ++i) {
    state.X_WB.p[i] = sine(amplitude[i], hertz[i], s);
    state.v_WB[i] = amplitude[i] * kTurn * hertz[i] * std::cos(kTurn * hertz[i] * s);
  }
  state.X_WB.q = attitude(s);
  constexpr double h = 1e-4;  // s
  state.w_B = base::Log(attitude(s - h).conjugate() * attitude(s + h)) / (2.0 * h);
  return state;
}

InertialFit FitMotion(const std::vector<stack::Measurement>& measurements, const Motion& motion) {
  std::vector<Rates> rates;
  std::vector<stack::ImuSample> samples;
  constexpr base::Time kSettled = base::Time{} + base::Milliseconds(200);  // the filter starts from rest
  for (const stack::Measurement& m : measurements) {
    const auto* sample = std::get_if<stack::ImuSample>(&m.data);
    if (sample == nullptr || m.captured < kSettled) continue;
    rates.push_back(RatesAt(motion, m.captured));
    samples.push_back(*sample);
  }
  InertialFit fit;
  FitGyro(rates, samples, fit);
  FitAccelerometer(rates, samples, fit);
  return fit;
}

void CheckInertiaInMotion(const Rig& rig, const sim::ImuConfig& claimed, Report& report) {
  const std::vector<stack::Measurement> samples = Record(ImuOnly(rig), nullptr, Shaken, base::Milliseconds(20'200));
  const InertialFit fit = FitMotion(samples, Shaken);
  // The filter's delay grows with frequency: 12 µs more at 1.7 Hz than at none for 30 Hz of bandwidth, 1 µs for 90.
  constexpr double kLeast = 50e-6;
  report.Add(
      Compare(kName, "gyro stamps' offset", 0.0, fit.gyro_offset, kLeast + kSigmas * fit.gyro_offset_sigma, "s"));
  report.Add(Compare(kName, "accelerometer stamps' offset", 0.0, fit.accelerometer_offset,
                     kLeast + kSigmas * fit.accelerometer_offset_sigma, "s"));
  const Vec3 angles = YawPitchRoll(fit.R_BI);
  constexpr const char* kAngles[] = {"mount yaw", "mount pitch", "mount roll"};
  constexpr const char* kPlaces[] = {"position x", "position y", "position z"};
  for (int i = 0; i < 3; ++i) {
    report.Add(Compare(kName, kAngles[i], claimed.orientation[i] / kDegree, angles[i] / kDegree,
                       0.005 + kSigmas * fit.angle_sigma / kDegree, "deg"));
  }
  for (int i = 0; i < 3; ++i) {
    report.Add(Compare(kName, kPlaces[i], claimed.position[i], fit.p_BI[i], 5e-4 + kSigmas * fit.p_sigma[i], "m"));
  }
  AddSaturation(rig, claimed, report);
}

}  // namespace alula::scenarios::check

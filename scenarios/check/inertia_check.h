#pragma once

#include <vector>

#include "scenarios/check/rig.h"
#include "scenarios/check/row.h"

namespace alula::scenarios::check {

/// The suite's inertial unit alone.
Rig ImuOnly(const Rig& rig);

/// The inertial unit standing still: Allan deviation against noise densities and bias walks, rate. As long as the walk
/// needs to come out of the white noise, 10 minutes to 2 hours.
void CheckInertiaAtRest(const Rig& rig, const sim::ImuConfig& claimed, Report& report);

/// The bias found after switching on, over many seeds.
void CheckTurnOnBias(const Rig& rig, const sim::ImuConfig& claimed, Report& report);

/// The unit shaken along known sines: offset of its stamps, how it is mounted, where it sits, and where it saturates.
void CheckInertiaInMotion(const Rig& rig, const sim::ImuConfig& claimed, Report& report);

/// Rates of change of a motion at t by central differences.
struct Rates {
  base::Vec3 w_B, dw_B;  // rad/s, rad/s²
  base::Vec3 f_B, df_B;  // specific force of the body origin and its rate, m/s², m/s³
};
Rates RatesAt(const Motion& motion, base::Time t);

/// Offset of stamps (s), mount and place that inertial samples say of a known motion.
struct InertialFit {
  base::Mat3 R_BI = base::Mat3::Identity();
  base::Vec3 p_BI = base::Vec3::Zero();  // m
  base::Vec3 p_sigma = base::Vec3::Zero();
  double gyro_offset = 0.0;  // s: what must be added to a stamp to get the instant of the motion
  double gyro_offset_sigma = 0.0;
  double accelerometer_offset = 0.0;
  double accelerometer_offset_sigma = 0.0;
  double angle_sigma = 0.0;  // rad, of R_BI
};
InertialFit FitMotion(const std::vector<stack::Measurement>& samples, const Motion& motion);

/// The motion of CheckInertiaInMotion: sines of some decimetres and tenths of a radian at 0.9 to 1.7 Hz.
vehicles::BodyState Shaken(base::Time t);

}  // namespace alula::scenarios::check

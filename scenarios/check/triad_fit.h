#pragma once

#include <string>
#include <vector>

#include "base/frames.h"
#include "scenarios/check/row.h"
#include "sim/sensors/triad_errors.h"

namespace alula::scenarios::check {

/// reading = M v + G f + b of three axes, M taken apart as sim/sensors/triad_errors.h puts it together.
struct TriadFit {
  base::Vec3 scale, misalignment, nonorthogonality, bias;  // 1, rad, rad, the reading's unit
  base::Mat3 M, G;
  double axes_sigma = 0.0, G_sigma = 0.0, bias_sigma = 0.0;
};

/// By least squares. `with_force`: the readings may hold a share of specific force f (a gyro's); otherwise v is all.
TriadFit FitTriad(const std::vector<base::Vec3>& v, const std::vector<base::Vec3>& f,
                  const std::vector<base::Vec3>& read, bool with_force);

/// Rows of scale, misalignment and non-orthogonality. `least`: what the bench's own model of the motion leaves, rad.
void AddAxes(const char* sensor, const std::string& what, const sim::TriadErrors& claimed, const TriadFit& found,
             double least, Report& report);

/// Smallest step between different readings of an axis; what lies closer than `rounding` counts as the same.
double LeastStep(const std::vector<base::Vec3>& read, double rounding);

}  // namespace alula::scenarios::check

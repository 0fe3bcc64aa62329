#pragma once

#include <vector>

namespace alula::scenarios::check {

/// One point of the overlapping Allan deviation curve.
struct AllanPoint {
  int cluster = 1;        // samples averaged, m
  double variance = 0.0;  // of all axes together
  double freedom = 0.0;   // clusters that count as independent, over all axes
};

/// Overlapping Allan variance of one rate signal at m = 1, 2, 4, … up to a ninth of its length (IEEE Std 952-1997,
/// annex C). All axes have as many samples.
std::vector<AllanPoint> AllanCurve(const std::vector<std::vector<double>>& axes);

/// White noise and random walk of the bias read off the curve.
struct NoiseDensities {
  double white = 0.0;  // density N, unit/√Hz
  double walk = 0.0;   // density K, unit/s/√Hz
  double white_sigma = 0.0;
  double walk_sigma = 0.0;
};

/// Fits AVAR(τ = m T) = N²/τ + K² τ/3 · (1 + 1/(2 m²)) by weighted least squares; the last factor is what a walk in
/// steps of T adds. The standard deviations come from the clusters: var(AVAR) = 2 AVAR²/freedom.
NoiseDensities FitAllan(const std::vector<AllanPoint>& curve, double period);

}  // namespace alula::scenarios::check

#pragma once

namespace alula::scenarios::statistics {

/// log ∫ₓ¹ tᵃ⁻¹ (1-t)ᵇ⁻¹ dt for a, b > 0 and 0 < x < 1. Finite also where the integral itself is below the smallest
/// double, as with millions of runs.
double LogUpperBeta(double a, double b, double x);
/// log ∫₀ˣ tᵃ⁻¹ (1-t)ᵇ⁻¹ dt.
double LogLowerBeta(double a, double b, double x);

}  // namespace alula::scenarios::statistics

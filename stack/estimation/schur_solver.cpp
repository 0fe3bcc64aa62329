#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "stack/estimation/internal/window_linearisation.h"

namespace alula::stack::estimation {
namespace {

/// All parameters of a problem, in its order.
void Save(const WindowProblem& problem, std::vector<double>& memory) {
  memory.clear();
  for (const auto& s : problem.states) memory.insert(memory.end(), s.x, s.x + AmbientSize(s.kind));
  for (const auto& l : problem.landmarks) memory.insert(memory.end(), l.x, l.x + l.kind->ambient);
}

void Restore(const WindowProblem& problem, const std::vector<double>& memory) {
  const double* from = memory.data();
  for (const auto& s : problem.states) {
    std::copy_n(from, AmbientSize(s.kind), s.x);
    from += AmbientSize(s.kind);
  }
  for (const auto& l : problem.landmarks) {
    std::copy_n(from, l.kind->ambient, l.x);
    from += l.kind->ambient;
  }
}

}  // namespace

SolverSummary SolveWithSchur(const WindowProblem& problem, const SolverLimits& limits) {
  constexpr double kLeastGain = 1e-3;      // of the promised decrease: less, and the step is refused
  constexpr double kLargestRadius = 1e16;  // as Ceres
  const PriorProducts prior(problem);
  WindowLinearisation here(problem), there(problem);
  SolverSummary summary;
  if (!here.Linearise(problem, prior)) return summary;
  summary.usable = true;
  summary.initial_cost = summary.final_cost = here.cost();

  std::vector<double> before;
  double radius = limits.radius, shrink = 2.0;
  while (summary.iterations < limits.iterations) {
    Save(problem, before);
    const double promised = here.Step(problem, radius);
    ++summary.iterations;
    const bool last = summary.iterations == limits.iterations;
    double cost = 0.0;
    bool valid = promised > 0.0;
    if (valid && last) valid = CostOf(problem, cost);
    if (valid && !last) {
      valid = there.Linearise(problem, prior);
      cost = there.cost();
    }
    const double gained = summary.final_cost - cost, gain = valid ? gained / promised : 0.0;
    if (gain <= kLeastGain) {
      Restore(problem, before);
      radius /= shrink;
      shrink *= 2.0;
      continue;
    }
    const bool converged = gained <= limits.function_tolerance * summary.final_cost;
    summary.final_cost = cost;
    if (converged) break;
    std::swap(here, there);
    radius = std::min(kLargestRadius, radius / std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3)));
    shrink = 2.0;
  }
  return summary;
}

}  // namespace alula::stack::estimation

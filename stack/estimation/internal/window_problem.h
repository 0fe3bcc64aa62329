#pragma once

#include <ceres/cost_function.h>
#include <ceres/manifold.h>

#include <vector>

#include "stack/estimation/internal/linear_system.h"

namespace alula::stack::estimation {

/// How a landmark's parameters move. Factors write their Jacobians by the landmark's tangent into the first `tangent`
/// of `ambient` columns, as they do for poses. A new kind of landmark is one more of these.
struct LandmarkKind {
  int ambient = kLandmarkSize;
  int tangent = kLandmarkSize;          // 3 or 4: the sizes that the solver eliminates
  ceres::Manifold* manifold = nullptr;  // null: x ⊞ δ = x + δ
};
inline constexpr int kMostLandmarkParameters = 9;

/// One least-squares problem of the window, in a fixed order:
///
///   ½ |r₀ + J (x ⊟ x₀)|² (the prior) + Σ ½ |factor|² + Σ ρ(½ |sight|²), ρ Huber's kernel.
///
/// Points into its owner's parameters; a solver writes there.
struct WindowProblem {
  struct State {
    double* x = nullptr;
    BlockKind kind = BlockKind::kPose;
    bool constant = false;
  };
  struct Factor {
    const ceres::CostFunction* cost = nullptr;
    std::vector<int> states;  // in the factor's order
  };
  /// Two rows by (pose, landmark, rig).
  struct Sight {
    const ceres::CostFunction* cost = nullptr;
    int pose = 0;
  };
  struct Landmark {
    double* x = nullptr;
    const LandmarkKind* kind = nullptr;
    int first = 0, count = 0;  // in `sights`
  };

  std::vector<State> states;
  int rig = 0;  // of `states`
  const LinearPrior* prior = nullptr;
  std::vector<Factor> factors;
  std::vector<Sight> sights;
  std::vector<Landmark> landmarks;
  double huber = 1.0;  // sigmas
};

struct SolverLimits {
  int iterations = 3;
  double function_tolerance = 1e-4;  // share of the cost; a step that gains less is the last
  double radius = 1e6;               // inverse of the first damping: the prediction is good, so nearly Gauss–Newton
};

struct SolverSummary {
  bool usable = false;  // the costs are finite and the parameters are at the best of them
  double initial_cost = 0.0, final_cost = 0.0;
  int iterations = 0;  // steps tried
};

/// Levenberg–Marquardt with Ceres: the reference.
SolverSummary SolveWithCeres(const WindowProblem& problem, const SolverLimits& limits);

/// Levenberg–Marquardt as Ceres does it (damping by the diagonal, its rule for the radius, weights of the kernel to
/// first order), every landmark eliminated on its own (Triggs et al. 2000, section 6) and the states' system dense.
/// The same cost and the same minimum; no problem is built and nothing is ordered by address.
SolverSummary SolveWithSchur(const WindowProblem& problem, const SolverLimits& limits);

}  // namespace alula::stack::estimation

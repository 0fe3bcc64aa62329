#pragma once

#include <Eigen/Core>
#include <vector>

#include "stack/estimation/internal/landmark_elimination.h"
#include "stack/estimation/internal/window_problem.h"

namespace alula::stack::estimation {

/// What of a problem's prior stays the same during a solve.
struct PriorProducts {
  explicit PriorProducts(const WindowProblem& problem);

  std::vector<int> states;  // of the problem, in the prior's order
  Eigen::MatrixXd JtJ;
  Eigen::VectorXd Jtr;  // at x₀
};

/// Gauss–Newton's normal equations of a problem where its parameters stand: states dense (lower triangle), landmarks
/// each with its own block.
class WindowLinearisation {
 public:
  explicit WindowLinearisation(const WindowProblem& problem);

  /// Takes everything anew. Returns false where a factor cannot be evaluated or the cost is not finite.
  bool Linearise(const WindowProblem& problem, const PriorProducts& prior);
  double cost() const { return cost_; }
  int columns() const { return static_cast<int>(b_.size()); }
  int Column(int state) const { return columns_[static_cast<std::size_t>(state)]; }

  /// A damped step of all parameters, applied to them. Returns the decrease of the cost that the model promises; not
  /// positive where the system cannot be solved (nothing is applied then).
  double Step(const WindowProblem& problem, double radius);

 private:
  void AddPrior(const WindowProblem& problem, const PriorProducts& prior);
  bool AddFactor(const WindowProblem& problem, const WindowProblem::Factor& factor);
  template <int N>
  bool AddLandmark(const WindowProblem& problem, int index, LandmarkElimination<N>& set);
  void HoldConstants(const WindowProblem& problem);

  std::vector<int> columns_;  // by state
  double cost_ = 0.0;
  Eigen::MatrixXd H_, S_;
  Eigen::VectorXd b_, s_;
  LandmarkElimination<3> points_;
  LandmarkElimination<4> lines_;
};

/// The cost alone; false where a factor cannot be evaluated.
bool CostOf(const WindowProblem& problem, double& cost);

}  // namespace alula::stack::estimation

#include "stack/estimation/internal/window_linearisation.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "base/error.h"

namespace alula::stack::estimation {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

const WindowProblem::State& StateAt(const WindowProblem& problem, int i) {
  return problem.states[static_cast<std::size_t>(i)];
}

/// Huber's cost of a residual of norm `norm`, and in `weight` that of its normal equations to first order.
double HuberCost(double norm, double huber, double& weight) {
  if (norm <= huber) {
    weight = 1.0;
    return 0.5 * norm * norm;
  }
  weight = huber / norm;
  return huber * (norm - 0.5 * huber);
}

/// Right-hand factor of the prior's Jacobian by a block: d (x ⊞ δ ⊟ x₀) / dδ, which is not one for a turn alone.
base::Mat3 TurnJacobian(const LinearBlock& block) {
  const base::Quat turn = PoseOf(block.x0.data()).q.conjugate() * PoseOf(block.x).q;
  return base::RightJacobianInverse(base::Log(turn));
}

}  // namespace

PriorProducts::PriorProducts(const WindowProblem& problem) {
  const LinearPrior& prior = *problem.prior;
  for (const LinearBlock& block : prior.blocks) {
    int found = -1;
    for (std::size_t i = 0; i < problem.states.size(); ++i) {
      if (problem.states[i].x == block.x) found = static_cast<int>(i);
    }
    if (found < 0) throw base::FaultError("window_problem", "the prior holds a block that is not in the problem");
    states.push_back(found);
  }
  JtJ = MatrixXd::Zero(prior.J.cols(), prior.J.cols());
  JtJ.selfadjointView<Eigen::Lower>().rankUpdate(prior.J.transpose());
  JtJ.triangularView<Eigen::StrictlyUpper>() = JtJ.transpose();
  Jtr = prior.J.transpose() * prior.r;
}

WindowLinearisation::WindowLinearisation(const WindowProblem& problem) {
  int total = 0;
  for (const WindowProblem::State& state : problem.states) {
    columns_.push_back(total);
    total += TangentSize(state.kind);
  }
  H_.resize(total, total);
  b_.resize(total);
}

bool WindowLinearisation::Linearise(const WindowProblem& problem, const PriorProducts& prior) {
  H_.setZero();
  b_.setZero();
  points_.Clear();
  lines_.Clear();
  cost_ = 0.0;
  AddPrior(problem, prior);
  for (const WindowProblem::Factor& factor : problem.factors) {
    if (!AddFactor(problem, factor)) return false;
  }
  for (std::size_t i = 0; i < problem.landmarks.size(); ++i) {
    const int index = static_cast<int>(i);
    const bool line = problem.landmarks[i].kind->tangent == 4;
    if (!(line ? AddLandmark(problem, index, lines_) : AddLandmark(problem, index, points_))) return false;
  }
  HoldConstants(problem);
  return std::isfinite(cost_);
}

void WindowLinearisation::AddPrior(const WindowProblem& problem, const PriorProducts& prior) {
  const LinearPrior& p = *problem.prior;
  VectorXd d(p.J.cols());
  std::vector<int> from;
  int column = 0;
  for (const LinearBlock& block : p.blocks) {
    from.push_back(column);
    d.segment(column, TangentSize(block.kind)) = Difference(block);
    column += TangentSize(block.kind);
  }
  cost_ += 0.5 * (p.r + p.J * d).squaredNorm();
  VectorXd gradient = prior.Jtr + prior.JtJ * d;
  MatrixXd JtJ = prior.JtJ;
  for (std::size_t i = 0; i < p.blocks.size(); ++i) {
    if (p.blocks[i].kind != BlockKind::kPose) continue;
    const base::Mat3 turn = TurnJacobian(p.blocks[i]);
    const int at = from[i] + 3;
    JtJ.middleCols<3>(at) = (JtJ.middleCols<3>(at) * turn).eval();
    JtJ.middleRows<3>(at) = (turn.transpose() * JtJ.middleRows<3>(at)).eval();
    gradient.segment<3>(at) = (turn.transpose() * gradient.segment<3>(at)).eval();
  }
  for (std::size_t i = 0; i < p.blocks.size(); ++i) {
    const int ni = TangentSize(p.blocks[i].kind), ci = Column(prior.states[i]);
    b_.segment(ci, ni) += gradient.segment(from[i], ni);
    for (std::size_t j = 0; j < p.blocks.size(); ++j) {
      const int nj = TangentSize(p.blocks[j].kind), cj = Column(prior.states[j]);
      if (ci >= cj) H_.block(ci, cj, ni, nj) += JtJ.block(from[i], from[j], ni, nj);
    }
  }
}

bool WindowLinearisation::AddFactor(const WindowProblem& problem, const WindowProblem::Factor& factor) {
  constexpr int kRows = 15, kBlocks = 4;
  std::array<double, kRows> residual{};
  std::array<std::array<double, kRows * kSpeedBiasSize>, kBlocks> memory;
  std::array<const double*, kBlocks> x{};
  std::array<double*, kBlocks> out{};
  const int rows = factor.cost->num_residuals();
  if (rows > kRows || factor.states.size() > kBlocks)
    throw base::FaultError("window_problem", "a factor of more than 15 rows or 4 blocks");
  for (std::size_t a = 0; a < factor.states.size(); ++a) {
    x[a] = StateAt(problem, factor.states[a]).x;
    out[a] = memory[a].data();
  }
  if (!factor.cost->Evaluate(x.data(), residual.data(), out.data())) return false;
  const Eigen::Map<const VectorXd> r(residual.data(), rows);
  cost_ += 0.5 * r.squaredNorm();
  const auto J = [&](std::size_t a) {
    return Eigen::Map<const RowMajor>(memory[a].data(), rows, AmbientSize(StateAt(problem, factor.states[a]).kind));
  };
  for (std::size_t a = 0; a < factor.states.size(); ++a) {
    const int na = TangentSize(StateAt(problem, factor.states[a]).kind), ca = Column(factor.states[a]);
    const MatrixXd JaT = J(a).leftCols(na).transpose();
    b_.segment(ca, na).noalias() += JaT * r;
    for (std::size_t c = 0; c < factor.states.size(); ++c) {
      const int nc = TangentSize(StateAt(problem, factor.states[c]).kind), cc = Column(factor.states[c]);
      if (ca >= cc) H_.block(ca, cc, na, nc).noalias() += JaT * J(c).leftCols(nc);
    }
  }
  return true;
}

template <int N>
bool WindowLinearisation::AddLandmark(const WindowProblem& problem, int index, LandmarkElimination<N>& set) {
  const WindowProblem::Landmark& landmark = problem.landmarks[static_cast<std::size_t>(index)];
  const int ambient = landmark.kind->ambient, c_rig = Column(problem.rig);
  const double* rig = StateAt(problem, problem.rig).x;
  Eigen::Matrix<double, 2, kPoseSize, Eigen::RowMajor> J_pose;
  Eigen::Matrix<double, 2, kRigSize, Eigen::RowMajor> J_rig;
  std::array<double, 2 * kMostLandmarkParameters> J_memory{};
  set.Begin(index);
  for (int i = 0; i < landmark.count; ++i) {
    const WindowProblem::Sight& sight = problem.sights[static_cast<std::size_t>(landmark.first + i)];
    base::Vec2 r;
    const double* x[3] = {StateAt(problem, sight.pose).x, landmark.x, rig};
    double* out[3] = {J_pose.data(), J_memory.data(), J_rig.data()};
    if (!sight.cost->Evaluate(x, r.data(), out)) return false;
    double weight = 1.0;
    cost_ += HuberCost(r.norm(), problem.huber, weight);
    const double root = std::sqrt(weight);
    r *= root;
    Eigen::Matrix<double, 2, N> J_l;
    for (int k = 0; k < N; ++k) J_l.col(k) = root * base::Vec2(J_memory[k], J_memory[ambient + k]);
    const Eigen::Matrix<double, 2, 6> J_p = root * J_pose.template leftCols<6>();
    const Eigen::Matrix<double, 2, 6> J_r = root * J_rig;
    const int c_pose = Column(sight.pose);
    H_.block<6, 6>(c_pose, c_pose).noalias() += J_p.transpose() * J_p;
    H_.block<6, 6>(c_rig, c_rig).noalias() += J_r.transpose() * J_r;
    if (c_pose > c_rig) {
      H_.block<6, 6>(c_pose, c_rig).noalias() += J_p.transpose() * J_r;
    } else {
      H_.block<6, 6>(c_rig, c_pose).noalias() += J_r.transpose() * J_p;
    }
    b_.segment<6>(c_pose).noalias() += J_p.transpose() * r;
    b_.segment<6>(c_rig).noalias() += J_r.transpose() * r;
    set.AddDiagonal(J_l, r);
    set.AddCoupling(c_rig, J_r, J_l);
    set.AddCoupling(c_pose, J_p, J_l);
  }
  return true;
}

/// A constant block keeps its columns, so that nothing else moves; they are taken out of the system in Step.
void WindowLinearisation::HoldConstants(const WindowProblem& problem) {
  for (std::size_t i = 0; i < problem.states.size(); ++i) {
    if (!problem.states[i].constant) continue;
    b_.segment(columns_[i], TangentSize(problem.states[i].kind)).setZero();
  }
}

double WindowLinearisation::Step(const WindowProblem& problem, double radius) {
  VectorXd damping(columns());
  for (int i = 0; i < columns(); ++i) damping[i] = DampingOf(H_(i, i)) / radius;
  S_ = H_;
  s_ = b_;
  S_.diagonal() += damping;
  points_.Eliminate(radius, S_, s_);
  lines_.Eliminate(radius, S_, s_);
  for (std::size_t i = 0; i < problem.states.size(); ++i) {
    if (!problem.states[i].constant) continue;
    const int c = columns_[i], n = TangentSize(problem.states[i].kind);
    S_.middleRows(c, n).setZero();
    S_.middleCols(c, n).setZero();
    S_.diagonal().segment(c, n).setOnes();
    s_.segment(c, n).setZero();
  }
  const Eigen::LLT<Eigen::Ref<MatrixXd>, Eigen::Lower> factorised(S_);
  if (factorised.info() != Eigen::Success) return 0.0;
  const VectorXd delta = factorised.solve(-s_);
  if (!delta.allFinite()) return 0.0;

  double decrease = 0.5 * (delta.dot(damping.cwiseProduct(delta)) - b_.dot(delta));
  const auto apply = [&problem](int owner, const auto& step) {
    const WindowProblem::Landmark& landmark = problem.landmarks[static_cast<std::size_t>(owner)];
    if (landmark.kind->manifold == nullptr) {
      for (int k = 0; k < landmark.kind->tangent; ++k) landmark.x[k] += step[k];
      return;
    }
    std::array<double, kMostLandmarkParameters> moved{};
    landmark.kind->manifold->Plus(landmark.x, step.data(), moved.data());
    std::copy_n(moved.begin(), landmark.kind->ambient, landmark.x);
  };
  decrease += points_.Substitute(delta, apply);
  decrease += lines_.Substitute(delta, apply);
  for (std::size_t i = 0; i < problem.states.size(); ++i) {
    const WindowProblem::State& state = problem.states[i];
    const double* step = delta.data() + columns_[i];
    if (state.constant) continue;
    if (state.kind == BlockKind::kPose) {
      std::array<double, kPoseSize> moved{};
      PosePlus(state.x, step, moved.data());
      std::copy_n(moved.begin(), kPoseSize, state.x);
    } else {
      for (int k = 0; k < TangentSize(state.kind); ++k) state.x[k] += step[k];
    }
  }
  return decrease;
}

bool CostOf(const WindowProblem& problem, double& cost) {
  cost = 0.5 * problem.prior->Residual().squaredNorm();
  std::array<double, 15> r{};
  std::array<const double*, 4> x{};
  for (const WindowProblem::Factor& factor : problem.factors) {
    for (std::size_t a = 0; a < factor.states.size(); ++a) x[a] = StateAt(problem, factor.states[a]).x;
    if (!factor.cost->Evaluate(x.data(), r.data(), nullptr)) return false;
    for (int i = 0; i < factor.cost->num_residuals(); ++i) cost += 0.5 * r[static_cast<std::size_t>(i)] * r[i];
  }
  const double* rig = StateAt(problem, problem.rig).x;
  for (const WindowProblem::Landmark& landmark : problem.landmarks) {
    for (int i = 0; i < landmark.count; ++i) {
      const WindowProblem::Sight& sight = problem.sights[static_cast<std::size_t>(landmark.first + i)];
      base::Vec2 error;
      const double* blocks[3] = {StateAt(problem, sight.pose).x, landmark.x, rig};
      if (!sight.cost->Evaluate(blocks, error.data(), nullptr)) return false;
      double unused = 0.0;
      cost += HuberCost(error.norm(), problem.huber, unused);
    }
  }
  return std::isfinite(cost);
}

}  // namespace alula::stack::estimation

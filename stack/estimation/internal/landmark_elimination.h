#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace alula::stack::estimation {

/// Damping of a diagonal entry of the normal equations, per unit of 1/radius; no direction is left without.
inline double DampingOf(double diagonal) { return std::max(diagonal, 1e-6); }

/// Landmarks of N parameters in the normal equations of a window, each with its own block and its couplings to
/// six-wide blocks of columns (poses, rig). They are eliminated one by one and found again from the states' step.
template <int N>
class LandmarkElimination {
 public:
  using MatN = Eigen::Matrix<double, N, N>;
  using VecN = Eigen::Matrix<double, N, 1>;
  using Mat6N = Eigen::Matrix<double, 6, N>;

  void Clear() {
    landmarks_.clear();
    couplings_.clear();
  }
  /// What follows belongs to a new landmark. `owner`: the caller's index for it.
  void Begin(int owner) { landmarks_.push_back({owner, static_cast<int>(couplings_.size()), 0}); }
  /// Adds JᵀJ and Jᵀr of one factor, which touches the six columns from `column` on through J_c [rows×6] (weights in).
  template <typename DerivedJ, typename DerivedR>
  void AddDiagonal(const Eigen::MatrixBase<DerivedJ>& J_l, const Eigen::MatrixBase<DerivedR>& r) {
    Landmark& l = landmarks_.back();
    l.H.noalias() += J_l.transpose() * J_l;
    l.b.noalias() += J_l.transpose() * r;
  }
  template <typename DerivedC, typename DerivedJ>
  void AddCoupling(int column, const Eigen::MatrixBase<DerivedC>& J_c, const Eigen::MatrixBase<DerivedJ>& J_l) {
    CouplingWith(column).noalias() += J_c.transpose() * J_l;
  }

  /// Damps by 1/radius and subtracts the landmarks' Schur complement from the lower triangle of S and from s.
  void Eliminate(double radius, Eigen::MatrixXd& S, Eigen::VectorXd& s) {
    for (Landmark& l : landmarks_) {
      for (int i = 0; i < N; ++i) l.damping[i] = DampingOf(l.H(i, i)) / radius;
      MatN damped = l.H;
      damped.diagonal() += l.damping;
      l.inverse = damped.llt().solve(MatN::Identity());
      const Coupling* first = couplings_.data() + l.first;
      for (int a = 0; a < l.count; ++a) {
        const Mat6N K = first[a].H * l.inverse;
        s.template segment<6>(first[a].column).noalias() -= K * l.b;
        for (int c = 0; c <= a; ++c) {
          if (first[a].column >= first[c].column) {
            S.template block<6, 6>(first[a].column, first[c].column).noalias() -= K * first[c].H.transpose();
          } else {
            S.template block<6, 6>(first[c].column, first[a].column).noalias() -= first[c].H * K.transpose();
          }
        }
      }
    }
  }

  /// The landmarks' steps that belong to the states' step `delta`: calls `apply(owner, step)` for each. Returns their
  /// share of the model's decrease, ½ (δᵀ D δ − bᵀ δ).
  template <typename Apply>
  double Substitute(const Eigen::VectorXd& delta, Apply apply) const {
    double decrease = 0.0;
    for (const Landmark& l : landmarks_) {
      VecN right = -l.b;
      for (int a = 0; a < l.count; ++a) {
        const Coupling& coupling = couplings_[static_cast<std::size_t>(l.first + a)];
        right.noalias() -= coupling.H.transpose() * delta.template segment<6>(coupling.column);
      }
      const VecN step = l.inverse * right;
      decrease += 0.5 * (step.dot(l.damping.cwiseProduct(step)) - l.b.dot(step));
      apply(l.owner, step);
    }
    return decrease;
  }

 private:
  struct Landmark {
    int owner = 0, first = 0, count = 0;  // couplings
    MatN H = MatN::Zero();
    VecN b = VecN::Zero();
    VecN damping = VecN::Zero();
    MatN inverse = MatN::Zero();
  };
  struct Coupling {
    int column = 0;
    Mat6N H = Mat6N::Zero();
  };

  Mat6N& CouplingWith(int column) {
    Landmark& l = landmarks_.back();
    // From the back: the two eyes of a pair come after each other.
    for (int i = static_cast<int>(couplings_.size()) - 1; i >= l.first; --i) {
      Coupling& known = couplings_[static_cast<std::size_t>(i)];
      if (known.column == column) return known.H;
    }
    ++l.count;
    couplings_.push_back({column, Mat6N::Zero()});
    return couplings_.back().H;
  }

  std::vector<Landmark> landmarks_;
  std::vector<Coupling> couplings_;  // of all landmarks, one after the other
};

}  // namespace alula::stack::estimation

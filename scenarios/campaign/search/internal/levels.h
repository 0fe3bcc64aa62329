#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "scenarios/campaign/search/failure_search.h"
#include "scenarios/campaign/search/internal/proposal.h"

namespace alula::scenarios::search {

/// All runs of all levels, each weighted against the mixture of all proposals (the balance heuristic of Veach & Guibas
/// 1995): w = φ(u) / Σ_l n_l q_l(u), so that Σ w estimates 1.
struct LevelPool {
  Eigen::MatrixXd points;            // [d×n]
  Eigen::VectorXd margins;           // [n]
  Eigen::VectorXd log_density_sum;   // [n] log Σ_l n_l q_l(u)
  std::vector<Proposal> proposals;   // q_l
  std::vector<std::int64_t> counts;  // n_l
};

void AddLevel(LevelPool& pool, const Proposal& proposal, const Eigen::MatrixXd& points,
              std::span<const double> margins);
/// [n] w of every run.
Eigen::VectorXd PoolWeights(const LevelPool& pool);

/// The runs with margins up to a level.
struct LevelSet {
  double level = 0.0;  // 0: the failures themselves
  std::vector<Eigen::Index> members;
};
/// The lowest level ≥ 0 whose set has the effective size asked for; runs of equal margin stay together. Where only
/// runs without a finite margin would fill it up, those with one must do.
LevelSet LowestLevel(const LevelPool& pool, const Eigen::VectorXd& weights, double effective_size);

/// Mixture fitted to the level set, with the guarding shares of the configuration.
Proposal FitProposal(const LevelPool& pool, const Eigen::VectorXd& weights, const LevelSet& set,
                     const FailureSearchConfig& config, base::RandomStream& random);

/// Var(1(margin ≤ level) φ/q) / p² of one run drawn from `proposal`, as the pool foretells it.
double RelativeVariance(const LevelPool& pool, const Eigen::VectorXd& weights, const LevelSet& set,
                        const Proposal& proposal);

}  // namespace alula::scenarios::search

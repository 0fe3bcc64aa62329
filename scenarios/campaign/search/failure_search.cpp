#include "scenarios/campaign/search/failure_search.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scenarios/campaign/search/internal/final_sample.h"
#include "scenarios/campaign/search/internal/levels.h"
#include "scenarios/campaign/search/internal/proposal.h"

namespace alula::scenarios::search {

namespace {

constexpr double kGoodRelativeVariance = 4.0;  // of one final run: a better proposal would not pay for its level
constexpr double kFirstNominalShare = 0.5;     // of the first level; the rest looks further out
constexpr double kBoundConfidence = 0.975;     // the bound from the levels has the other half of 5 %
constexpr int kMinRefinements = 1;             // levels at margin 0 that better the proposal only
constexpr int kMaxRefinements = 3;

void Require(bool good, const std::string& key, const std::string& range) {
  if (!good) throw base::InputError("failure search: " + key + " must be " + range);
}

}  // namespace

void FailureSearchConfig::Validate() const {
  Require(level_runs >= 20, "level_runs", "at least 20");
  Require(min_final_runs >= 20, "min_final_runs", "at least 20");
  Require(max_runs >= level_runs + min_final_runs, "max_runs", "at least level_runs + min_final_runs");
  Require(level_share > 0.0 && level_share < 1.0, "level_share", "in (0, 1)");
  Require(final_share >= 0.0 && final_share < 1.0, "final_share", "in [0, 1)");
  Require(relative_error > 0.0, "relative_error", "positive");
  Require(nominal_share > 0.0, "nominal_share", "positive");
  Require(wide_share >= 0.0 && nominal_share + wide_share < 1.0, "nominal_share + wide_share", "below 1");
  Require(max_components >= 1, "max_components", "at least 1");
}

struct FailureSearch::State {
  FailureSearchConfig config;
  Eigen::Index dimensions = 0;
  std::uint64_t seed = 0;
  LevelPool pool;
  Proposal proposal;
  Eigen::MatrixXd batch;  // [d×n] asked, not yet told
  int batches = 0;
  int refinements = 0;
  double level = 0.0;
  bool final = false;
  FailureEstimate estimate;

  base::RandomStream Stream(const std::string& purpose) const {
    return {seed, "search/" + purpose + "/" + std::to_string(batches)};
  }

  void DrawBatch(std::int64_t runs) {
    base::RandomStream random = Stream("points");
    batch = Draw(proposal, dimensions, runs, random);
    ++batches;
  }

  bool RoomForLevel() const {
    const double most = static_cast<double>(config.max_runs) * (1.0 - config.final_share);
    const std::int64_t after = pool.points.cols() + config.level_runs;
    return static_cast<double>(after) <= most && after + config.min_final_runs <= config.max_runs;
  }

  std::int64_t FinalRuns(double relative_variance) const {
    const double needed = relative_variance / (config.relative_error * config.relative_error);
    const std::int64_t left = config.max_runs - pool.points.cols();
    if (level > 0.0 || needed >= static_cast<double>(left)) return left;
    return std::max(config.min_final_runs, static_cast<std::int64_t>(std::ceil(needed)));
  }

  /// After each level: fit the next proposal, then draw either the next level or the final sample from it.
  void TellLevel(std::span<const double> margins) {
    AddLevel(pool, proposal, batch, margins);
    const Eigen::VectorXd weights = PoolWeights(pool);
    const LevelSet set = LowestLevel(pool, weights, config.level_share * static_cast<double>(config.level_runs));
    base::RandomStream random = Stream("fit");
    proposal = FitProposal(pool, weights, set, config, random);
    level = set.level;
    const double relative_variance = RelativeVariance(pool, weights, set, proposal);
    const bool good = level <= 0.0 && refinements >= kMinRefinements &&
                      (relative_variance <= kGoodRelativeVariance || refinements >= kMaxRefinements);
    if (!good && RoomForLevel()) {
      refinements += level <= 0.0 ? 1 : 0;
      DrawBatch(config.level_runs);
    } else {
      final = true;
      DrawBatch(FinalRuns(relative_variance));
    }
  }

  /// The nominal density is a share of the first proposal, so that p is at most the chance that a run of the first
  /// level fails, divided by that share.
  double FirstBound() const {
    const std::int64_t runs = pool.counts.front();
    const auto failures = static_cast<std::int64_t>((pool.margins.head(runs).array() <= 0.0).count());
    return std::min(1.0, statistics::UpperBound(failures, runs, kBoundConfidence) / kFirstNominalShare);
  }

  void TellFinal(std::span<const double> margins) {
    estimate = Estimate({proposal, batch, margins}, level, FirstBound());
    estimate.runs = pool.points.cols() + batch.cols();
    estimate.levels = static_cast<int>(pool.counts.size());
    batch.resize(batch.rows(), 0);
  }
};

FailureSearch::FailureSearch(const FailureSearchConfig& config, std::size_t dimensions, std::uint64_t seed)
    : state_(std::make_unique<State>()) {
  config.Validate();
  Require(dimensions >= 1, "the number of drawn parameters", "at least 1");
  state_->config = config;
  state_->seed = seed;
  state_->dimensions = static_cast<Eigen::Index>(dimensions);
  state_->proposal = {{}, kFirstNominalShare, 1.0 - kFirstNominalShare};
  state_->DrawBatch(config.level_runs);
}

FailureSearch::~FailureSearch() = default;
FailureSearch::FailureSearch(FailureSearch&&) noexcept = default;
FailureSearch& FailureSearch::operator=(FailureSearch&&) noexcept = default;

std::vector<std::vector<double>> FailureSearch::Ask() const {
  std::vector<std::vector<double>> points;
  for (Eigen::Index i = 0; i < state_->batch.cols(); ++i) {
    const auto column = state_->batch.col(i);
    points.emplace_back(column.begin(), column.end());
  }
  return points;
}

void FailureSearch::Tell(std::span<const double> margins) {
  if (done() || static_cast<Eigen::Index>(margins.size()) != state_->batch.cols()) {
    throw base::FaultError("margins", "a failure search is told one margin for each point that it asked for");
  }
  if (std::any_of(margins.begin(), margins.end(), [](double margin) { return std::isnan(margin); })) {
    throw base::FaultError("margins", "a margin is not a number; a run without one is -inf (failed) or +inf (passed)");
  }
  if (state_->final) {
    state_->TellFinal(margins);
  } else {
    state_->TellLevel(margins);
  }
}

bool FailureSearch::done() const { return state_->batch.cols() == 0; }

const FailureEstimate& FailureSearch::estimate() const {
  if (!done()) throw base::FaultError("not_done", "a failure search has no estimate before it is done");
  return state_->estimate;
}

}  // namespace alula::scenarios::search

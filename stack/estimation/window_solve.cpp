#include <algorithm>
#include <array>

#include "stack/estimation/internal/sliding_window.h"
#include "stack/estimation/internal/window_problem.h"

namespace alula::stack::estimation {
namespace {

/// Biases that far from where an interval was linearised make it worth integrating again.
constexpr double kGyroShift = 0.01, kAccelShift = 0.2;  // rad/s, m/s²

constexpr LandmarkKind kPoint;

}  // namespace

void SlidingWindow::RelineariseFactors() {
  for (std::size_t i = 1; i < frames_.size(); ++i) {
    Frame& frame = *frames_[i];
    const ImuState state = ReadState(*frames_[i - 1]);
    if ((state.gyro_bias - frame.integral->gyro_bias()).norm() > kGyroShift ||
        (state.accel_bias - frame.integral->accel_bias()).norm() > kAccelShift) {
      frame.integral->Relinearise(state.gyro_bias, state.accel_bias);
      frame.factor.reset();
    }
    if (!frame.factor) frame.factor = std::make_unique<ImuFactor>(*frame.integral, gravity_);
  }
}

WindowProblem SlidingWindow::Problem() const {
  WindowProblem problem;
  problem.huber = config_.huber;
  problem.prior = &prior_;
  problem.states.push_back({rig_parameters(), BlockKind::kRig, !config_.refine_calibration});
  std::vector<int> pose_of(static_cast<std::size_t>(config_.frames) + 1);  // by slot
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const std::size_t slot = frames_[i]->slot;
    const int at = static_cast<int>(problem.states.size());
    pose_of[slot] = at;
    problem.states.push_back({pose(slot), BlockKind::kPose});
    problem.states.push_back({speed_bias(slot), BlockKind::kSpeedBias});
    if (i > 0) problem.factors.push_back({frames_[i]->factor.get(), {at - 2, at - 1, at, at + 1}});
  }
  for (const auto& [track, landmark] : landmarks_) {
    if (!UsesPoint(landmark)) continue;
    const int first = static_cast<int>(problem.sights.size());
    for (const Sight& sight : landmark.sights) {
      problem.sights.push_back({sight.left.get(), pose_of[sight.slot]});
      if (sight.right) problem.sights.push_back({sight.right.get(), pose_of[sight.slot]});
    }
    problem.landmarks.push_back(
        {point(landmark.slot), &kPoint, first, static_cast<int>(problem.sights.size()) - first});
  }
  AddLinesTo(problem, pose_of);
  return problem;
}

bool SlidingWindow::Solve() {
  RefreshModels();
  DropUnusable();
  const std::vector<double> before(arena_.get(), arena_.get() + arena_size_);

  JudgeLines();
  RelineariseFactors();
  const SolverLimits limits{.iterations = config_.iterations};
  const WindowProblem problem = Problem();
  const SolverSummary summary =
      config_.solver == WindowSolver::kSchur ? SolveWithSchur(problem, limits) : SolveWithCeres(problem, limits);
  const bool finite = std::all_of(arena_.get(), arena_.get() + arena_size_, [](double x) { return std::isfinite(x); });
  if (!summary.usable || !finite) {
    std::copy(before.begin(), before.end(), arena_.get());
    return false;
  }
  return true;
}

void SlidingWindow::MarginaliseOldest() {
  RefreshModels();
  DropUnusable();
  const std::size_t oldest = frames_[0]->slot;
  const std::size_t settled = frames_.size() - static_cast<std::size_t>(config_.recent_frames);
  const auto is_settled = [&](const Sight& s) {
    for (std::size_t i = 0; i < settled; ++i) {
      if (frames_[i]->slot == s.slot) return true;
    }
    return false;
  };

  // Which landmarks go into the prior.
  std::vector<std::map<std::uint64_t, MapPoint>::iterator> consumed;
  for (auto it = landmarks_.begin(); it != landmarks_.end(); ++it) {
    const auto& sights = it->second.sights;
    if (!it->second.placed) continue;
    if (std::none_of(sights.begin(), sights.end(), [oldest](const Sight& s) { return s.slot == oldest; })) continue;
    const bool followed = !std::all_of(sights.begin(), sights.end(), is_settled);
    if (followed) {
      const auto before = static_cast<std::uint64_t>(static_cast<double>(consumption_) * config_.consumed_share);
      const auto after = static_cast<std::uint64_t>(static_cast<double>(++consumption_) * config_.consumed_share);
      if (before == after) continue;
    }
    if (std::count_if(sights.begin(), sights.end(), is_settled) >= 2) consumed.push_back(it);
  }

  // Columns: what leaves first; then the rig and all that the prior or the leaving factors touch.
  const auto linearisation_point = [this](const double* x) -> const double* {
    if (!config_.first_estimates) return nullptr;
    for (const LinearBlock& block : prior_.blocks) {
      if (block.x == x) return block.x0.data();
    }
    return nullptr;
  };
  NormalEquations system;
  const auto add = [&](double* x, BlockKind kind) {
    const int known = system.Find(x);
    return known >= 0 ? known : system.AddBlock(x, kind, linearisation_point(x));
  };
  const int pose_0 = add(pose(oldest), BlockKind::kPose), speed_0 = add(speed_bias(oldest), BlockKind::kSpeedBias);
  const int rig = add(rig_parameters(), BlockKind::kRig);
  const Frame& next = *frames_[1];
  const int pose_1 = add(pose(next.slot), BlockKind::kPose),
            speed_1 = add(speed_bias(next.slot), BlockKind::kSpeedBias);
  for (const LinearBlock& block : prior_.blocks) add(block.x, block.kind);
  for (const auto& it : consumed) {
    for (const Sight& s : it->second.sights) {
      if (is_settled(s)) add(pose(s.slot), BlockKind::kPose);
    }
  }
  system.Allocate();
  system.Add(prior_);
  if (!next.factor) frames_[1]->factor = std::make_unique<ImuFactor>(*next.integral, gravity_);
  system.Add(*next.factor, std::array{pose_0, speed_0, pose_1, speed_1});
  for (const auto& it : consumed) {
    std::vector<NormalEquations::Sight> sights;
    for (const Sight& s : it->second.sights) {
      if (!is_settled(s)) continue;
      const int block = system.Find(pose(s.slot));
      sights.push_back({s.left.get(), block});
      if (s.right) sights.push_back({s.right.get(), block});
    }
    system.AddLandmark(point(it->second.slot), sights, rig, config_.huber);
  }
  prior_ = Marginalise(system, kPoseTangent + kSpeedBiasSize);

  for (const auto& it : consumed) {
    std::erase_if(it->second.sights, is_settled);
    if (it->second.sights.empty()) ErasePoint(it);
  }
  EraseSights(oldest);
  frames_[1]->integral.reset();
  frames_[1]->factor.reset();
  free_slots_.push_back(oldest);
  frames_.erase(frames_.begin());
}

Mat15 SlidingWindow::NewestCovariance() const {
  NormalEquations system;
  const int rig = system.AddBlock(rig_parameters(), BlockKind::kRig);
  std::vector<int> poses, speeds;
  for (const auto& frame : frames_) {
    poses.push_back(system.AddBlock(pose(frame->slot), BlockKind::kPose));
    speeds.push_back(system.AddBlock(speed_bias(frame->slot), BlockKind::kSpeedBias));
  }
  system.Allocate();
  system.Add(prior_);
  for (std::size_t i = 1; i < frames_.size(); ++i) {
    if (frames_[i]->factor)
      system.Add(*frames_[i]->factor, std::array{poses[i - 1], speeds[i - 1], poses[i], speeds[i]});
  }
  for (const auto& [track, landmark] : landmarks_) {
    if (!UsesPoint(landmark)) continue;
    std::vector<NormalEquations::Sight> sights;
    for (const Sight& s : landmark.sights) {
      const int block = system.Find(pose(s.slot));
      sights.push_back({s.left.get(), block});
      if (s.right) sights.push_back({s.right.get(), block});
    }
    system.AddLandmark(point(landmark.slot), sights, rig, config_.huber);
  }
  return MarginalCovariance(system.H(), system.Column(poses.back()), 15);
}

}  // namespace alula::stack::estimation

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>

#include "stack/estimation/internal/sliding_window.h"

namespace alula::stack::estimation {

using base::Transform;
using base::Vec2;
using base::Vec3;

namespace {

/// How a line's parameters move; the manifold has no state.
const LandmarkKind& LineKind() {
  static LineManifold manifold;
  static const LandmarkKind kind{kLineSize, kLineTangent, &manifold};
  return kind;
}

constexpr double kImpossible = 1e300;  // cost of a line that passes through an eye
constexpr int kFits = 3;               // steps of a line by itself a frame
constexpr double kDamping = 1e-3;
constexpr double kGate = 3.5;  // σ of a sight's residual beyond which it is dropped: χ² with two at 99.8 %

}  // namespace

void SlidingWindow::AddLines(const Frame& frame, const std::vector<LineSighting>& lines) {
  const double sigma = lines_config_.sigma / rig_.left.fx;
  for (const LineSighting& seen : lines) {
    auto it = lines_.find(seen.track);
    if (it == lines_.end()) {
      if (!seen.ends_L || free_lines_.empty()) continue;
      const ImuState state = ReadState(frame);
      const double t = rig_parameters()[5];
      const Transform X_OL =
          Transform{state.X_OI.q * base::Exp(frame.pair.w_I * t), state.X_OI.p + state.v_OI * t} * X_IC();
      MapLine made;
      made.slot = free_lines_.back();
      free_lines_.pop_back();
      made.ends_O = {X_OL * (*seen.ends_L)[0], X_OL * (*seen.ends_L)[1]};
      SetLine(LineThrough(made.ends_O[0], made.ends_O[1]), line(made.slot));
      it = lines_.emplace(seen.track, std::move(made)).first;
    }
    LineSight sight;
    sight.slot = frame.slot;
    sight.left = std::make_unique<LineFactor>(frame.pair, false, seen.left, sigma);
    if (seen.right) sight.right = std::make_unique<LineFactor>(frame.pair, true, *seen.right, sigma);
    it->second.sights.push_back(std::move(sight));
  }
}

double SlidingWindow::LineCost(const MapLine& one, const double* x, Eigen::Matrix4d* H, Eigen::Vector4d* b) const {
  Eigen::Matrix<double, 2, 5, Eigen::RowMajor> J;
  double* out[3] = {nullptr, J.data(), nullptr};
  double cost = 0.0;
  for (const LineSight& s : one.sights) {
    const double* at[3] = {pose(s.slot), x, rig_parameters()};
    Vec2 r;
    for (const LineFactor* factor : {s.left.get(), s.right.get()}) {
      if (factor == nullptr) continue;
      if (!factor->Evaluate(at, r.data(), H != nullptr ? out : nullptr)) return kImpossible;
      const double norm = r.norm(), w = norm > config_.huber ? config_.huber / norm : 1.0;
      cost += w < 1.0 ? config_.huber * (norm - 0.5 * config_.huber) : 0.5 * norm * norm;
      if (H == nullptr) continue;
      *H += w * J.leftCols<4>().transpose() * J.leftCols<4>();
      *b += w * J.leftCols<4>().transpose() * r;
    }
  }
  return cost;
}

void SlidingWindow::FitLine(MapLine& one) {
  double* x = line(one.slot);
  for (int i = 0; i < kFits; ++i) {
    Eigen::Matrix4d H = Eigen::Matrix4d::Zero();
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    const double cost = LineCost(one, x, &H, &b);
    if (cost >= kImpossible) return;
    H.diagonal() *= 1.0 + kDamping;
    H.diagonal().array() += 1e-9 * H.trace();
    const Eigen::Vector4d step = -H.ldlt().solve(b);
    std::array<double, kLineSize> moved{};
    LinePlus(x, step.data(), moved.data());
    if (!(LineCost(one, moved.data(), nullptr, nullptr) < cost)) return;
    std::copy(moved.begin(), moved.end(), x);
  }
}

void SlidingWindow::JudgeLines() {
  for (auto it = lines_.begin(); it != lines_.end();) {
    const auto next = std::next(it);
    MapLine& one = it->second;
    if (!one.used) FitLine(one);
    Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
    Eigen::Vector4d unused = Eigen::Vector4d::Zero();
    if (LineCost(one, line(one.slot), &information, &unused) >= kImpossible) {
      EraseLine(it);
    } else {
      const auto spread = SpreadOf(line(one.slot), information, 0.5 * (one.ends_O[0] + one.ends_O[1]));
      one.used = one.sights.size() >= 2 && spread && spread->direction < lines_config_.max_direction &&
                 spread->place < lines_config_.max_place;
    }
    it = next;
  }
}

void SlidingWindow::AddLinesTo(WindowProblem& problem, const std::vector<int>& pose_of) const {
  for (const auto& [track, one] : lines_) {
    if (!one.used) continue;
    const int first = static_cast<int>(problem.sights.size());
    for (const LineSight& sight : one.sights) {
      problem.sights.push_back({sight.left.get(), pose_of[sight.slot]});
      if (sight.right) problem.sights.push_back({sight.right.get(), pose_of[sight.slot]});
    }
    problem.landmarks.push_back({line(one.slot), &LineKind(), first, static_cast<int>(problem.sights.size()) - first});
  }
}

void SlidingWindow::RejectLines() {
  const std::size_t newest = frames_.back()->slot;
  for (auto it = lines_.begin(); it != lines_.end();) {
    const auto next = std::next(it);
    MapLine& one = it->second;
    bool lost = false;
    std::erase_if(one.sights, [&](const LineSight& s) {
      const double* at[3] = {pose(s.slot), line(one.slot), rig_parameters()};
      Vec2 r;
      for (const LineFactor* factor : {s.left.get(), s.right.get()}) {
        if (factor == nullptr || (factor->Evaluate(at, r.data(), nullptr) && r.norm() < kGate)) continue;
        lost = lost || s.slot == newest;
        return true;
      }
      return false;
    });
    // Followed wrongly, or never a line in space: an outline of something round.
    if (lost || one.sights.empty()) {
      EraseLine(it);
    } else {
      const PluckerLine known = LineAt(line(one.slot));
      for (Vec3& end : one.ends_O) end = NearestOn(known, end);
    }
    it = next;
  }
}

void SlidingWindow::EraseLine(std::map<std::uint64_t, MapLine>::iterator it) {
  free_lines_.push_back(it->second.slot);
  lines_.erase(it);
}

void SlidingWindow::EraseLineSights(std::size_t slot) {
  for (auto it = lines_.begin(); it != lines_.end();) {
    const auto next = std::next(it);
    std::erase_if(it->second.sights, [slot](const LineSight& s) { return s.slot == slot; });
    if (it->second.sights.empty()) EraseLine(it);
    it = next;
  }
}

std::vector<KnownLine> SlidingWindow::Lines() const {
  std::vector<KnownLine> known;
  for (const auto& [track, one] : lines_) known.push_back({track, one.ends_O});
  return known;
}

int SlidingWindow::UsedLines() const {
  return static_cast<int>(std::count_if(lines_.begin(), lines_.end(), [](const auto& l) { return l.second.used; }));
}

}  // namespace alula::stack::estimation

#include "stack/estimation/internal/sliding_window.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace alula::stack::estimation {

using base::Exp;
using base::Time;
using base::Transform;
using base::Vec3;

ImuState Propagate(const ImuState& from, const std::vector<TimedImu>& samples, const Vec3& gravity) {
  ImuPreintegration integral({}, from.gyro_bias, from.accel_bias);
  integral.Append(samples);
  const double dt = integral.dt();
  ImuState to = from;
  to.stamp = samples.back().time;
  to.X_OI.p += from.v_OI * dt + 0.5 * gravity * dt * dt + from.X_OI.q * integral.dp();
  to.v_OI += gravity * dt + from.X_OI.q * integral.dv();
  to.X_OI.q = (from.X_OI.q * integral.dR()).normalized();
  return to;
}

SlidingWindow::SlidingWindow(const features::StereoRig& rig, const Transform& X_IC, const ImuNoise& noise,
                             const WindowConfig& config, const LinesConfig& lines, const Vec3& gravity)
    : rig_(rig),
      X_IC_(X_IC),
      X_RL_(rig.X_LR.Inverse()),
      noise_(noise),
      gravity_(gravity),
      config_(config),
      lines_config_(lines),
      max_points_(4000),
      max_lines_(lines.enabled ? 1000 : 0) {
  noise_.gyro_noise *= config.imu_noise_scale;
  noise_.accelerometer_noise *= config.imu_noise_scale;
  MakeArena();
}

void SlidingWindow::MakeArena() {
  const auto frames = static_cast<std::size_t>(config_.frames) + 1;
  pose_begin_ = 8;
  speed_begin_ = pose_begin_ + 8 * frames;
  point_begin_ = speed_begin_ + 10 * frames;
  line_begin_ = point_begin_ + 4 * max_points_;
  arena_size_ = line_begin_ + 8 * max_lines_;
  arena_ = std::make_unique<double[]>(arena_size_);
  std::fill_n(arena_.get(), arena_size_, 0.0);
  for (std::size_t i = frames; i-- > 0;) free_slots_.push_back(i);
  for (std::size_t i = max_points_; i-- > 0;) free_points_.push_back(i);
  for (std::size_t i = max_lines_; i-- > 0;) free_lines_.push_back(i);
}

void SlidingWindow::Start(const ImuState& state, const StartSigmas& s, const std::vector<Sighting>& sightings,
                          const std::vector<LineSighting>& lines) {
  while (!landmarks_.empty()) ErasePoint(landmarks_.begin());
  while (!lines_.empty()) EraseLine(lines_.begin());
  for (const auto& frame : frames_) free_slots_.push_back(frame->slot);
  frames_.clear();
  const Frame& frame = AppendFrame(state.stamp, true, state.gyro_bias);
  WriteState(frame.slot, state);

  // Attitude is known as tilt and heading, in the axes of O; the block's tangent is in those of I.
  prior_ = LinearPrior();
  const auto block = [this](double* x, BlockKind kind) {
    LinearBlock b{x, kind, {}};
    std::copy_n(x, AmbientSize(kind), b.x0.begin());
    prior_.blocks.push_back(b);
  };
  block(rig_parameters(), BlockKind::kRig);
  block(pose(frame.slot), BlockKind::kPose);
  block(speed_bias(frame.slot), BlockKind::kSpeedBias);
  prior_.J = Eigen::MatrixXd::Zero(21, 21);
  prior_.r = Eigen::VectorXd::Zero(21);
  const auto diagonal = [this](int at, int n, double sigma) {
    prior_.J.diagonal().segment(at, n).setConstant(1.0 / sigma);
  };
  diagonal(0, 3, config_.camera_rotation_sigma);
  diagonal(3, 2, config_.eye_rotation_sigma);
  diagonal(5, 1, config_.time_offset_sigma);
  prior_.r.head(6) = prior_.J.topLeftCorner(6, 6) * Eigen::Map<const base::Vec6>(rig_parameters());
  diagonal(6, 3, s.position);
  prior_.J.block<3, 3>(9, 9) = Vec3(1.0 / s.tilt, 1.0 / s.tilt, 1.0 / s.heading).asDiagonal() * state.X_OI.R();
  diagonal(12, 3, s.velocity);
  diagonal(15, 3, s.gyro_bias);
  diagonal(18, 3, s.accel_bias);
  RefreshModels();
  AddSightings(frame, sightings);
  AddLines(frame, lines);
}

SlidingWindow::Frame& SlidingWindow::AppendFrame(Time stamp, bool keyframe, const Vec3& gyro) {
  auto frame = std::make_unique<Frame>();
  frame->slot = free_slots_.back();
  free_slots_.pop_back();
  frame->stamp = stamp;
  frame->keyframe = keyframe;
  frame->gyro = gyro;
  frame->pair.X_IC = X_IC_;
  frame->pair.X_RL = X_RL_;
  frame->pair.weight = rig_.left.fx / config_.pixel_sigma;
  frames_.push_back(std::move(frame));
  return *frames_.back();
}

void SlidingWindow::AddFrame(const std::vector<TimedImu>& samples, const std::vector<Sighting>& sightings,
                             bool keyframe, const std::vector<LineSighting>& lines,
                             const std::optional<Transform>& X_OI, const std::optional<ImuNoise>& noise) {
  const ImuState before = Newest();
  ImuState predicted = Propagate(before, samples, gravity_);
  if (X_OI) predicted.X_OI = *X_OI;
  Frame& frame = AppendFrame(predicted.stamp, keyframe, samples.back().gyro);
  frame.integral = std::make_unique<ImuPreintegration>(noise.value_or(noise_), before.gyro_bias, before.accel_bias);
  frame.integral->Append(samples);
  WriteState(frame.slot, predicted);
  RefreshModels();
  AddSightings(frame, sightings);
  AddLines(frame, lines);
}

void SlidingWindow::WriteState(std::size_t slot, const ImuState& state) {
  SetPose(state.X_OI, pose(slot));
  double* s = speed_bias(slot);
  for (int i = 0; i < 3; ++i) {
    s[i] = state.v_OI[i];
    s[3 + i] = state.gyro_bias[i];
    s[6 + i] = state.accel_bias[i];
  }
}

ImuState SlidingWindow::ReadState(const Frame& frame) const {
  const double* s = speed_bias(frame.slot);
  return {frame.stamp, PoseOf(pose(frame.slot)), Vec3At(s), Vec3At(s + 3), Vec3At(s + 6)};
}

ImuState SlidingWindow::Newest() const { return ReadState(*frames_.back()); }

std::vector<ImuState> SlidingWindow::KeyframesBefore() const {
  std::vector<ImuState> states;
  for (std::size_t i = 0; i + 1 < frames_.size(); ++i) {
    if (frames_[i]->keyframe) states.push_back(ReadState(*frames_[i]));
  }
  return states;
}

/// During the time offset the IMU moves on with the speed and rate it has at the stamp.
void SlidingWindow::RefreshModels() {
  for (const auto& frame : frames_) {
    const ImuState state = ReadState(*frame);
    frame->pair.v_OI = state.v_OI;
    frame->pair.w_I = frame->gyro - state.gyro_bias;
    frame->pair.Invalidate();
  }
}

void SlidingWindow::AddSightings(const Frame& frame, const std::vector<Sighting>& sightings) {
  const bool waits = rig_.depth == features::DepthSource::kNone;  // for motion to tell depths
  for (const Sighting& seen : sightings) {
    auto it = landmarks_.find(seen.track);
    if (it == landmarks_.end()) {
      const std::optional<Vec3> p_O = ByStereo(frame, seen);
      if ((!p_O && !waits) || free_points_.empty()) continue;
      MapPoint landmark;
      landmark.slot = free_points_.back();
      free_points_.pop_back();
      if (p_O) Place(landmark, *p_O);
      it = landmarks_.emplace(seen.track, std::move(landmark)).first;
    }
    Sight sight;
    sight.slot = frame.slot;
    sight.left = std::make_unique<ReprojectionFactor>(frame.pair, false, seen.left);
    if (seen.right) sight.right = std::make_unique<ReprojectionFactor>(frame.pair, true, *seen.right);
    it->second.sights.push_back(std::move(sight));
    if (it->second.placed) continue;
    if (const std::optional<Vec3> p_O = ByMotion(it->second)) Place(it->second, *p_O);
  }
}

void SlidingWindow::Place(MapPoint& landmark, const Vec3& p_O) {
  for (int i = 0; i < 3; ++i) point(landmark.slot)[i] = p_O[i];
  landmark.placed = true;
}

Transform SlidingWindow::X_OC(const Frame& frame) const {
  const double t = rig_parameters()[5];
  const ImuState state = ReadState(frame);
  const Transform X_OI{state.X_OI.q * Exp(frame.pair.w_I * t), state.X_OI.p + state.v_OI * t};
  return X_OI * X_IC();
}

std::optional<Vec3> SlidingWindow::ByStereo(const Frame& frame, const Sighting& seen) const {
  if (!seen.right) return std::nullopt;
  const double* rig = rig_parameters();
  Transform X_RL = X_RL_;
  const base::Quat eye = Exp(Vec3(rig[3], rig[4], 0.0)).conjugate();
  X_RL = {eye * X_RL_.q, eye * X_RL_.p};
  double depth = features::TriangulatedDepth(X_RL.Inverse(), seen.left, *seen.right);
  if (depth > 0 && depth < config_.min_depth) return std::nullopt;
  if (depth <= 0 || depth > config_.max_depth) depth = config_.max_depth;
  return X_OC(frame) * Vec3(depth * seen.left.homogeneous());
}

std::optional<Vec3> SlidingWindow::ByMotion(const MapPoint& landmark) const {
  if (landmark.sights.size() < 2) return std::nullopt;
  base::Mat3 A = base::Mat3::Zero();
  Vec3 b = Vec3::Zero();
  std::vector<Transform> cameras;
  Vec3 first = Vec3::Zero();
  double widest = 0.0;
  for (const Sight& sight : landmark.sights) {
    cameras.push_back(X_OC(*FrameOf(sight.slot)));
    const Vec3 ray = cameras.back().q * Vec3(sight.left->seen().homogeneous().normalized());
    if (cameras.size() == 1) first = ray;
    widest = std::max(widest, first.cross(ray).norm());
    const base::Mat3 across = base::Mat3::Identity() - ray * ray.transpose();
    A += across;
    b += across * cameras.back().p;
  }
  if (widest < config_.min_ray_angle) return std::nullopt;
  const Vec3 p_O = A.ldlt().solve(b);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Vec3 p_C = cameras[i].Inverse() * p_O;
    if (!(p_C.z() > config_.min_depth && p_C.z() < config_.max_depth)) return std::nullopt;
    const base::Vec2 error = p_C.head<2>() / p_C.z() - landmark.sights[i].left->seen();
    if (error.norm() * rig_.left.fx > config_.outlier_gate) return std::nullopt;
  }
  return p_O;
}

std::optional<Vec3> SlidingWindow::Landmark(std::uint64_t track) const {
  const auto it = landmarks_.find(track);
  if (it == landmarks_.end() || !it->second.placed) return std::nullopt;
  return Vec3At(point(it->second.slot));
}

bool SlidingWindow::SeenInNewest(std::uint64_t track) const {
  const auto it = landmarks_.find(track);
  return it != landmarks_.end() && !it->second.sights.empty() && it->second.sights.back().slot == frames_.back()->slot;
}

CalibrationEstimate SlidingWindow::Rig() const {
  const double* rig = rig_parameters();
  return {Vec3At(rig), {rig[3], rig[4]}, rig[5]};
}

Transform SlidingWindow::X_IC() const { return {X_IC_.q * Exp(Vec3At(rig_parameters())), X_IC_.p}; }

void SlidingWindow::ErasePoint(std::map<std::uint64_t, MapPoint>::iterator it) {
  free_points_.push_back(it->second.slot);
  landmarks_.erase(it);
}

void SlidingWindow::EraseSights(std::size_t slot) {
  EraseLineSights(slot);
  for (auto it = landmarks_.begin(); it != landmarks_.end();) {
    const auto next = std::next(it);
    std::erase_if(it->second.sights, [slot](const Sight& s) { return s.slot == slot; });
    if (it->second.sights.empty()) ErasePoint(it);
    it = next;
  }
}

std::optional<double> SlidingWindow::SightError(const Sight& sight, const double* landmark) const {
  const double* parameters[3] = {pose(sight.slot), landmark, rig_parameters()};
  double worst = 0.0;
  for (const auto* factor : {sight.left.get(), sight.right.get()}) {
    if (factor == nullptr) continue;
    base::Vec2 r;
    if (!factor->Evaluate(parameters, r.data(), nullptr)) return std::nullopt;
    worst = std::max(worst, r.norm() * config_.pixel_sigma);
  }
  return worst;
}

void SlidingWindow::DropUnusable() {
  for (auto it = landmarks_.begin(); it != landmarks_.end();) {
    const auto next = std::next(it);
    const double* p = point(it->second.slot);
    if (it->second.placed) std::erase_if(it->second.sights, [this, p](const Sight& s) { return !SightError(s, p); });
    if (it->second.sights.empty()) ErasePoint(it);
    it = next;
  }
}

std::vector<std::uint64_t> SlidingWindow::RejectOutliers() {
  RejectLines();
  std::vector<std::uint64_t> dropped;
  const std::size_t newest = frames_.back()->slot;
  for (auto it = landmarks_.begin(); it != landmarks_.end();) {
    const auto next = std::next(it);
    MapPoint& landmark = it->second;
    if (UsesPoint(landmark)) {
      const double* p = point(landmark.slot);
      bool lost = false;
      std::erase_if(landmark.sights, [&](const Sight& s) {
        const std::optional<double> error = SightError(s, p);
        const bool bad = !error || *error > config_.outlier_gate;
        lost = lost || (bad && s.slot == newest);
        return bad;
      });
      if (lost) dropped.push_back(it->first);
      if (lost || landmark.sights.empty()) ErasePoint(it);
    }
    it = next;
  }
  return dropped;
}

void SlidingWindow::Slide() {
  if (frames_.size() < static_cast<std::size_t>(config_.frames)) return;
  const std::size_t settled = frames_.size() - static_cast<std::size_t>(config_.recent_frames);
  for (std::size_t i = 0; i < settled; ++i) {
    if (frames_[i]->keyframe) continue;
    RemoveFrame(i);
    return;
  }
  MarginaliseOldest();
}

void SlidingWindow::RemoveFrame(std::size_t index) {
  EraseSights(frames_[index]->slot);
  Frame& next = *frames_[index + 1];
  frames_[index]->integral->Append(next.integral->samples());
  next.integral = std::move(frames_[index]->integral);
  next.factor.reset();
  free_slots_.push_back(frames_[index]->slot);
  frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(index));
}

const SlidingWindow::Frame* SlidingWindow::FrameOf(std::size_t slot) const {
  for (const auto& frame : frames_) {
    if (frame->slot == slot) return frame.get();
  }
  throw base::FaultError("sliding_window", "a sight of a frame that has left the window");
}

}  // namespace alula::stack::estimation

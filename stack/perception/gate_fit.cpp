#include "stack/perception/internal/gate_fit.h"

#include <algorithm>
#include <cmath>

namespace alula::stack::perception::internal {

namespace {

constexpr double kModelSigma = 0.03;        // m, how flat real bars are
constexpr float kMinIncidence = 0.25F;      // |cos| between ray and normal; flatter views tell nothing
constexpr double kCorrelatedPixels = 64.0;  // depths in a window of 8×8 pixels err together
constexpr double kHintNormalSigma = 0.4;    // m, of the survey and the map frame along the normal
constexpr double kHintYawSigma = 0.15;      // rad
constexpr int kSegments = 8;                // a bar's length is judged in so many pieces

/// How a refinement goes: rounds, first step in the plane (m, it shrinks to 1 cm), softness of the evidence (m), and
/// every how-many-th sample is looked at.
struct Schedule {
  int rounds;
  double step;
  double softness;
  int stride;
};
constexpr Schedule kCoarse{3, 0.08, 0.05, 2};
constexpr Schedule kFine{4, 0.03, 0.0, 1};

/// Distance outside the opening (Chebyshev), m; negative inside.
float Outside(float y, float z, float half) { return std::max(std::abs(y), std::abs(z)) - half; }

/// A ray clears the opening only if it clears it at both faces of the slab.
float Blocked(const Crossing& c, float dy, float dz, float half) {
  return std::max(Outside(c.y_in - dy, c.z_in - dz, half), Outside(c.y_out - dy, c.z_out - dz, half));
}

/// +1 on the bars, −1 in the opening, 0 beyond, with ramps of ±`ramp` m.
float Mask(float q, float width, float ramp) {
  const float edge = std::clamp(q / ramp, -1.0F, 1.0F);
  const float end = std::clamp((width - q) / ramp, -1.0F, 1.0F);
  return q < 0.5F * width ? edge : 0.5F * (end + 1.0F);
}

float Evidence(float z, float near_face, float far_face, float sigma) {
  if (!std::isfinite(z)) return -1.0F;
  const float r = (z < near_face ? z - near_face : std::max(0.0F, z - far_face)) / sigma;
  const float agreement = std::abs(r) > 4.0F ? 0.0F : std::exp(-0.5F * r * r);
  return r < 0 ? agreement : 2.0F * agreement - 1.0F;  // what stands in front says nothing of the gate
}

}  // namespace

void GateFit::Cross(const std::vector<GateView>& views, const GatePose& pose, double margin, double extra_sigma,
                    int stride, std::vector<Crossing>& out) const {
  out.clear();
  const Eigen::Vector3f n = pose.Normal().cast<float>();
  const Eigen::Vector3f l = pose.Left().cast<float>();
  const float reach = static_cast<float>(0.5 * opening_ + margin);
  const float half_depth = static_cast<float>(0.5 * config_.bar_depth);
  for (const GateView& view : views) {
    const Eigen::Vector3f p_GC = (view.X_OC.p - pose.p_O).cast<float>();  // axes of O
    const float height = n.dot(p_GC);                                     // negative in front of the gate
    const float side = height < 0 ? 1.0F : -1.0F;
    const float per_px2 = static_cast<float>(config_.disparity_sigma / view.focal_baseline);
    for (std::size_t at = 0; at < view.samples.size(); at += stride) {
      const Sample& s = view.samples[at];
      const float along = n.dot(s.ray_O) * side;  // towards the far face
      if (along < kMinIncidence * s.ray_O.norm()) continue;
      const float t_in = (std::abs(height) - half_depth) / along;
      const float t_out = (std::abs(height) + half_depth) / along;
      if (t_in < 0.2F) continue;
      Crossing c;
      c.y_in = l.dot(p_GC) + t_in * l.dot(s.ray_O);
      c.z_in = p_GC.z() + t_in * s.ray_O.z();
      if (std::abs(c.y_in) > reach || std::abs(c.z_in) > reach) continue;
      c.y_out = l.dot(p_GC) + t_out * l.dot(s.ray_O);
      c.z_out = p_GC.z() + t_out * s.ray_O.z();
      const float depth_sigma = t_in * t_in * per_px2;
      c.sigma = std::sqrt(depth_sigma * depth_sigma + static_cast<float>(kModelSigma * kModelSigma));
      c.evidence = Evidence(s.z, t_in, t_out, c.sigma + static_cast<float>(extra_sigma));
      c.weight = static_cast<float>(view.pixels_per_sample) * static_cast<float>(stride);
      c.depth_error = s.z - t_in;
      c.slope = side / along;
      c.depth = t_in;
      out.push_back(c);
    }
  }
}

double GateFit::InPlaneObjective(const std::vector<Crossing>& crossings, double dy, double dz, double ramp) const {
  const float half = static_cast<float>(0.5 * opening_);
  const float width = static_cast<float>(config_.bar_width);
  double sum = 0.0;
  for (const Crossing& c : crossings) {
    const float q = Blocked(c, static_cast<float>(dy), static_cast<float>(dz), half);
    sum += static_cast<double>(c.weight * c.evidence * Mask(q, width, static_cast<float>(ramp)));
  }
  return sum;
}

void GateFit::AdjustInPlane(const std::vector<Crossing>& crossings, double step, GatePose& pose) const {
  const double ramp = std::max(step, 0.02);
  const double here = InPlaneObjective(crossings, 0, 0, ramp);
  double move[2];
  for (int axis = 0; axis < 2; ++axis) {
    const double d[2] = {axis == 0 ? step : 0.0, axis == 1 ? step : 0.0};
    const double ahead = InPlaneObjective(crossings, d[0], d[1], ramp);
    const double back = InPlaneObjective(crossings, -d[0], -d[1], ramp);
    const double curvature = 2 * here - ahead - back;
    const double uphill = ahead > back ? step : -step;
    move[axis] = curvature > 0 ? std::clamp(0.5 * step * (ahead - back) / curvature, -step, step)
                               : (std::max(ahead, back) > here ? uphill : 0.0);
  }
  pose.p_O += move[0] * pose.Left() + move[1] * base::Vec3::UnitZ();
}

/// One Gauss–Newton step of (normal offset, yaw) on the depths seen on the bars. The near face lies at
/// t = n·(p − p_C)/n·r, so ∂t/∂normal = 1/(n·r) and ∂t/∂yaw = −y/(n·r), y the lateral coordinate.
GateFit::PlaneStep GateFit::AdjustPlane(const std::vector<Crossing>& crossings, const GatePose& pose,
                                        const GatePose& hint) const {
  const float half = static_cast<float>(0.5 * opening_);
  const double offset = hint.Normal().dot(pose.p_O - hint.p_O);
  const double turned = base::WrapAngle(pose.yaw - hint.yaw);
  double h00 = 1 / (kHintNormalSigma * kHintNormalSigma);
  double h11 = 1 / (kHintYawSigma * kHintYawSigma);
  double h01 = 0.0;
  double g0 = -offset * h00;
  double g1 = -turned * h11;
  double depth_sum = 0.0;
  double weight_sum = 0.0;
  for (const Crossing& c : crossings) {
    const float q = Outside(c.y_in, c.z_in, half);
    if (q < 0.0F || q > static_cast<float>(config_.bar_width) || !std::isfinite(c.depth_error)) continue;
    const double r = static_cast<double>(c.depth_error / c.sigma);
    if (std::abs(r) > 4.0) continue;
    const double robust = 1.0 / (1.0 + 0.5 * r * r);
    const double w = robust * std::min(1.0, static_cast<double>(c.weight) / kCorrelatedPixels) /
                     (static_cast<double>(c.sigma) * c.sigma);
    const double j0 = c.slope;
    const double j1 = -static_cast<double>(c.y_in) * c.slope;
    h00 += w * j0 * j0;
    h01 += w * j0 * j1;
    h11 += w * j1 * j1;
    g0 += w * j0 * c.depth_error;
    g1 += w * j1 * c.depth_error;
    depth_sum += w * c.depth;
    weight_sum += w;
  }
  const double determinant = h00 * h11 - h01 * h01;
  PlaneStep step;
  step.normal = (h11 * g0 - h01 * g1) / determinant;
  step.yaw = (h00 * g1 - h01 * g0) / determinant;
  step.normal_sigma = std::sqrt(h11 / determinant);
  step.yaw_sigma = std::sqrt(h00 / determinant);
  step.depth = weight_sum > 0 ? depth_sum / weight_sum : 0.0;
  return step;
}

GateFit::Result GateFit::Refine(const std::vector<GateView>& views, const GatePose& start, const GatePose& hint,
                                Steps steps) const {
  constexpr double kMargin = 0.45;  // m outside the opening
  const Schedule& schedule = steps == Steps::kCoarse ? kCoarse : kFine;
  Result result;
  result.pose = start;
  std::vector<Crossing> crossings;
  PlaneStep plane;
  double step = schedule.step;
  const auto cross = [&] { Cross(views, result.pose, kMargin, schedule.softness, schedule.stride, crossings); };
  for (int round = 0; round < schedule.rounds; ++round) {
    cross();
    AdjustInPlane(crossings, step, result.pose);
    cross();
    plane = AdjustPlane(crossings, result.pose, hint);
    result.pose.p_O += std::clamp(plane.normal, -0.2, 0.2) * result.pose.Normal();
    result.pose.yaw += std::clamp(plane.yaw, -0.15, 0.15);
    step = std::max(0.01, 0.7 * step);
  }
  cross();
  result.quality = Judge(crossings);

  const GateView& last = views.back();
  const double pixel = plane.depth / last.focal;
  const double common = plane.depth * plane.depth * config_.disparity_bias / last.focal_baseline;
  constexpr double kExtrinsics =
      0.015;  // m, of the camera in the body and of stereo at edges, measured in rendered courtyards
  constexpr double kDepthOfBars = 0.02;  // m, unknown half depth of the bars
  result.position_sigma = std::hypot(0.8 * pixel, kExtrinsics) * (result.quality.bars < 4 ? 1.5 : 1.0);
  result.normal_sigma = std::hypot(plane.normal_sigma, std::hypot(common, kDepthOfBars));
  result.yaw_sigma = std::hypot(plane.yaw_sigma, 0.015);
  return result;
}

Quality GateFit::Judge(const std::vector<Crossing>& crossings) const {
  struct Cell {
    double sum = 0.0;
    double weight = 0.0;
    void Add(const Crossing& c) {
      sum += static_cast<double>(c.evidence * c.weight);
      weight += static_cast<double>(c.weight);
    }
  };
  std::array<std::array<Cell, kSegments>, 4> bars{};
  std::array<std::array<Cell, kSegments>, kSegments> opening{};
  const float half = static_cast<float>(0.5 * opening_);
  const auto segment = [&](float along) {
    return std::clamp(static_cast<int>((along + half) / (2 * half) * kSegments), 0, kSegments - 1);
  };
  Quality quality;
  for (const Crossing& c : crossings) {
    const float q = Outside(c.y_in, c.z_in, half);
    if (q > 0.0F && q < static_cast<float>(config_.bar_width)) {
      const bool upright = std::abs(c.y_in) > std::abs(c.z_in);
      const int which = upright ? (c.y_in > 0 ? 0 : 1) : (c.z_in < 0 ? 2 : 3);
      bars[which][segment(upright ? c.z_in : c.y_in)].Add(c);
      if (c.evidence > 0.3F) ++quality.support;
    } else if (Blocked(c, 0, 0, half) < -0.08F) {
      opening[segment(c.y_in)][segment(c.z_in)].Add(c);
    }
  }
  double seen_score = 0.0;
  bool contradicted = false;
  for (int b = 0; b < 4; ++b) {
    int looked_at = 0;
    for (const Cell& cell : bars[b]) {
      if (cell.weight <= 0) continue;
      ++looked_at;
      quality.bar[b] += cell.sum / cell.weight;
    }
    if (looked_at > 0) quality.bar[b] /= looked_at;
    quality.coverage[b] = static_cast<double>(looked_at) / kSegments;
    if (quality.coverage[b] >= config_.min_coverage && quality.bar[b] >= config_.min_bar_support) {
      ++quality.bars;
      seen_score += quality.bar[b];
    } else if (quality.coverage[b] >= config_.min_coverage && quality.bar[b] < 0.0) {
      contradicted = true;
    }
  }
  int open_cells = 0;
  for (const auto& row : opening) {
    for (const Cell& cell : row) {
      if (cell.weight <= 0) continue;
      ++open_cells;
      quality.opening -= cell.sum / cell.weight;
    }
  }
  if (open_cells > 0) quality.opening /= open_cells;
  quality.opening_coverage = static_cast<double>(open_cells) / (kSegments * kSegments);
  const bool seen_through = quality.opening_coverage > 0.2 && quality.opening >= config_.min_opening;
  const bool before_sky = quality.opening_coverage <= 0.2 && quality.bars == 4;
  quality.accepted = quality.bars >= 3 && !contradicted && (seen_through || before_sky);
  quality.score = 0.5 * seen_score / 4.0 + 0.5 * (quality.opening_coverage > 0.2 ? quality.opening : 0.0);
  return quality;
}

}  // namespace alula::stack::perception::internal

#include "stack/perception/gate_finder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "stack/perception/internal/gate_fit.h"

namespace alula::stack::perception {

namespace {

using internal::GateFit;
using internal::GatePose;
using internal::GateView;

constexpr double kSurroundings = 0.35;  // m kept of what stands around the widest place of the frame
constexpr int kSearchViews = 5;         // latest views that the exhaustive search looks at
constexpr double kSearchAgain = 1.7;    // search anew when the evidence has grown by this factor

/// The pixels of a depth map that look at a gate's surroundings, thinned on a lattice without a grain, so that
/// upright and level edges are not aliased.
GateView TakeView(const mapping::DepthMap& depth, const base::Transform& X_OC, const GatePose& hint, double reach,
                  const GateFinderConfig& config) {
  GateView view;
  view.X_OC = X_OC;
  view.focal = depth.fx;
  view.focal_baseline = depth.fx * depth.baseline;
  view.depth = (X_OC.Inverse() * hint.p_O).z();
  const base::Mat3 R_OC = X_OC.R();
  const base::Vec3 n = hint.Normal();
  const double height = n.dot(hint.p_O - X_OC.p);
  const auto look = [&](int u, int v, base::Vec3& ray_O) {
    const float z = depth.At(u, v);
    if (!(z > 0.0F)) return false;
    ray_O = R_OC * depth.Ray(u, v);
    const double t = height / n.dot(ray_O);
    if (!(t > 0.3) || t > 2 * config.max_range) return false;
    const base::Vec3 p_GX = X_OC.p + t * ray_O - hint.p_O;
    return std::abs(hint.Left().dot(p_GX)) < reach && std::abs(p_GX.z()) < reach;
  };
  base::Vec3 ray_O;
  int pixels = 0;  // estimated on every fourth row and column
  for (int v = 0; v < depth.height; v += 4) {
    for (int u = 0; u < depth.width; u += 4) pixels += look(u, v, ray_O) ? 16 : 0;
  }
  const int period = std::max(1, pixels / config.max_samples);
  const int shift = std::max(1, static_cast<int>(std::lround(0.381966 * period)));  // golden section
  view.pixels_per_sample = period;
  for (int v = 0; v < depth.height; ++v) {
    for (int u = (v * shift) % period; u < depth.width; u += period) {
      if (look(u, v, ray_O)) view.samples.push_back({ray_O.cast<float>(), depth.At(u, v)});
    }
  }
  return view;
}

double Evidence(const std::vector<GateView>& views) {
  double sum = 0.0;
  for (const GateView& v : views) sum += static_cast<double>(v.samples.size()) * v.pixels_per_sample;
  return sum;
}

}  // namespace

void Describe(base::Description& d, GateFinderConfig& c) {
  d.Field("search_in_plane", c.search_in_plane,
          {.unit = "m", .meaning = "search to each side of the hint, across and up", .min = 0.1, .max = 4});
  d.Field("search_normal", c.search_normal,
          {.unit = "m", .meaning = "search to each side along the passage", .min = 0.1, .max = 4});
  d.Field("search_yaw", c.search_yaw, {.unit = "rad", .meaning = "search to each side", .min = 0.02, .max = 1});
  d.Field("bar_width", c.bar_width, {.unit = "m", .meaning = "width of the thinnest bars", .min = 0.02, .max = 1});
  d.Field("bar_depth", c.bar_depth, {.unit = "m", .meaning = "bars along the passage", .min = 0.0, .max = 1});
  d.Field("disparity_sigma", c.disparity_sigma,
          {.meaning = "1σ of a disparity, px of the depth map", .min = 0.01, .max = 10});
  d.Field("disparity_bias", c.disparity_bias,
          {.meaning = "1σ common to all disparities of a view, px", .min = 0, .max = 10});
  d.Field("max_range", c.max_range, {.unit = "m", .meaning = "farthest view of a gate used", .min = 1, .max = 50});
  d.Field("min_bar_support", c.min_bar_support,
          {.meaning = "mean evidence that makes a bar seen", .min = -1, .max = 1});
  d.Field("min_opening", c.min_opening,
          {.meaning = "mean evidence that the opening is seen through", .min = -1, .max = 1});
  d.Field("min_coverage", c.min_coverage, {.meaning = "share of a bar that was looked at", .min = 0, .max = 1});
  d.Field("max_views", c.max_views, {.meaning = "views kept of each gate", .min = 1, .max = 200});
  d.Field("view_spacing", c.view_spacing, {.unit = "m", .meaning = "travel between kept views", .min = 0, .max = 5});
  d.Field("max_samples", c.max_samples, {.meaning = "pixels kept of one view", .min = 100, .max = 100000});
}

struct GateFinder::Impl {
  struct Gate {
    GateHint hint;
    std::vector<GateView> views;
    std::optional<GatePose> pose;  // the best so far, accepted or not
    std::optional<GateObservation> best;
    double searched_at = 0.0;  // evidence at the last exhaustive search
  };

  bool Useful(const Gate& gate, const GateView& view) const;
  void Fit(Gate& gate, const GatePose& hint) const;
  bool Near(const GatePose& pose, const GatePose& hint) const;

  GateFinderConfig config;
  std::vector<Gate> gates;
};

GateFinder::GateFinder(std::vector<GateHint> hints, const GateFinderConfig& config) : impl_(std::make_unique<Impl>()) {
  impl_->config = config;
  for (GateHint& hint : hints) {
    if (!(hint.opening > 0.1)) throw base::InputError("mission: gate " + hint.name + ": opening must be above 0.1 m");
    Impl::Gate gate;
    gate.hint = std::move(hint);
    impl_->gates.push_back(std::move(gate));
  }
}
GateFinder::~GateFinder() = default;
GateFinder::GateFinder(GateFinder&&) noexcept = default;
GateFinder& GateFinder::operator=(GateFinder&&) noexcept = default;

int GateFinder::size() const { return static_cast<int>(impl_->gates.size()); }
std::optional<GateObservation> GateFinder::Best(int gate) const { return impl_->gates.at(gate).best; }

/// A view is kept when it shows something new: the camera has moved, and once the gate is found it still sees bars
/// (close before a gate only the opening is left in the picture, and good views must not be pushed out by those).
bool GateFinder::Impl::Useful(const Gate& gate, const GateView& view) const {
  if (view.samples.size() < 100) return false;
  if (!gate.views.empty()) {
    const base::Transform& last = gate.views.back().X_OC;
    const double turned = base::Log(last.q.conjugate() * view.X_OC.q).norm();
    if ((last.p - view.X_OC.p).norm() < config.view_spacing && turned < 0.1) return false;
  }
  if (!gate.best) return true;
  std::vector<internal::Crossing> crossings;
  const GateFit fit(config, gate.hint.opening);
  fit.Cross({view}, *gate.pose, config.bar_width, 0.0, 1, crossings);
  const auto quality = fit.Judge(crossings);
  int looked_at = 0;
  for (const double coverage : quality.coverage) looked_at += coverage >= config.min_coverage ? 1 : 0;
  return looked_at >= 2;
}

bool GateFinder::Impl::Near(const GatePose& pose, const GatePose& hint) const {
  const base::Vec3 off = pose.p_O - hint.p_O;
  return std::abs(hint.Left().dot(off)) < config.search_in_plane + 0.1 &&
         std::abs(off.z()) < config.search_in_plane + 0.1 &&
         std::abs(hint.Normal().dot(off)) < config.search_normal + 0.2 &&
         std::abs(base::WrapAngle(pose.yaw - hint.yaw)) < config.search_yaw + 0.05;
}

void GateFinder::Impl::Fit(Gate& gate, const GatePose& hint) const {
  const GateFit fit(config, gate.hint.opening);
  const auto better = [&](const GateFit::Result& one, const std::optional<GateFit::Result>& best) {
    return Near(one.pose, hint) && (!best || one.quality.score > best->quality.score);
  };
  std::optional<GateFit::Result> best;
  if (gate.pose) {
    const GateFit::Result tracked = fit.Refine(gate.views, *gate.pose, hint, GateFit::Steps::kFine);
    if (better(tracked, best)) best = tracked;
  }
  const double evidence = Evidence(gate.views);
  if (!gate.best || evidence > kSearchAgain * gate.searched_at) {
    gate.searched_at = evidence;
    const std::size_t first = gate.views.size() > kSearchViews ? gate.views.size() - kSearchViews : 0;
    const std::vector<GateView> latest(gate.views.begin() + static_cast<std::ptrdiff_t>(first), gate.views.end());
    std::optional<GateFit::Result> found;
    for (const GatePose& pose : fit.Search(latest, hint)) {
      const GateFit::Result coarse = fit.Refine(gate.views, pose, hint, GateFit::Steps::kCoarse);
      if (better(coarse, found)) found = coarse;
    }
    if (found) {
      const GateFit::Result fine = fit.Refine(gate.views, found->pose, hint, GateFit::Steps::kFine);
      if (better(fine, best)) best = fine;
    }
  }
  // A fit that fell below the bar (a view through a glare, a passer-by) does not make a gate unseen that was seen.
  if (!best || (gate.best && !best->quality.accepted)) return;
  gate.pose = best->pose;
  if (!best->quality.accepted) return;
  GateObservation seen;
  seen.X_OG = {base::FromYaw(best->pose.yaw), best->pose.p_O};
  seen.opening = gate.hint.opening;
  seen.score = best->quality.score;
  seen.position_sigma = best->position_sigma;
  seen.normal_sigma = best->normal_sigma;
  seen.yaw_sigma = best->yaw_sigma;
  seen.support = best->quality.support;
  seen.bars = best->quality.bars;
  seen.nearest = gate.views.front().depth;
  for (const GateView& view : gate.views) seen.nearest = std::min(seen.nearest, view.depth);
  gate.best = seen;
}

void GateFinder::Add(const mapping::DepthMap& depth, const base::Transform& X_OC, const base::Transform& X_MO) {
  const base::Transform X_OM = X_MO.Inverse();
  for (Impl::Gate& gate : impl_->gates) {
    const base::Transform X_OG = X_OM * gate.hint.X_WG;
    const GatePose hint{X_OG.p, base::Yaw(X_OG.q)};
    const base::Vec3 p_CG = X_OC.Inverse() * hint.p_O;
    const double slack = impl_->config.search_in_plane;
    if (p_CG.z() < -slack || p_CG.norm() > impl_->config.max_range + slack) continue;
    const double reach = 0.5 * gate.hint.opening + slack + kSurroundings;
    GateView view = TakeView(depth, X_OC, hint, reach, impl_->config);
    if (!impl_->Useful(gate, view)) continue;
    gate.views.push_back(std::move(view));
    if (static_cast<int>(gate.views.size()) > impl_->config.max_views) gate.views.erase(gate.views.begin());
    impl_->Fit(gate, hint);
  }
}

}  // namespace alula::stack::perception

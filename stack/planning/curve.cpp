#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "stack/planning/trajectory.h"

namespace alula::stack::planning {

using base::Vec3;

namespace {
constexpr int kSamples = 8;  // of the arc length table, per span: 2.5 cm at the usual spacing
}

Curve::Curve(std::vector<Vec3> control) {
  if (control.size() < 2) throw base::FaultError("curve", "a curve needs at least two control points");
  const std::size_t n = control.size();
  control_.reserve(n + 2);
  // Phantoms mirrored about the ends make the curve begin and end exactly there, without curvature.
  control_.push_back(2.0 * control[0] - control[1]);
  control_.insert(control_.end(), control.begin(), control.end());
  control_.push_back(2.0 * control[n - 1] - control[n - 2]);
  const std::size_t count = (n - 1) * kSamples;
  arc_.assign(count + 1, 0.0);
  Vec3 last = control_[1];
  for (std::size_t i = 1; i <= count; ++i) {
    Vec3 p;
    Derivatives(static_cast<double>(i) / kSamples, &p, nullptr, nullptr);
    arc_[i] = arc_[i - 1] + (p - last).norm();
    last = p;
  }
}

void Curve::Derivatives(double u, Vec3* p, Vec3* d1, Vec3* d2) const {
  const std::size_t spans = control_.size() - 3;
  const auto i = std::min(static_cast<std::size_t>(std::max(u, 0.0)), spans - 1);
  const double x = u - static_cast<double>(i);
  const double y = 1.0 - x;
  const Vec3 &a = control_[i], &b = control_[i + 1], &c = control_[i + 2], &d = control_[i + 3];
  if (p != nullptr) {
    *p = (y * y * y * a + (3.0 * x * x * x - 6.0 * x * x + 4.0) * b + (3.0 * y * y * y - 6.0 * y * y + 4.0) * c +
          x * x * x * d) /
         6.0;
  }
  if (d1 != nullptr) {
    *d1 = 0.5 * (y * y * (b - a) + (1.0 + 2.0 * x * y) * (c - b) + x * x * (d - c));
  }
  if (d2 != nullptr) *d2 = y * (c - 2.0 * b + a) + x * (d - 2.0 * c + b);
}

double Curve::Parameter(double s) const {
  s = std::clamp(s, 0.0, length());
  const auto upper = std::upper_bound(arc_.begin(), arc_.end(), s);
  const auto i = static_cast<std::size_t>(
                     std::min<std::ptrdiff_t>(upper - arc_.begin(), static_cast<std::ptrdiff_t>(arc_.size()) - 1)) -
                 1;
  const double span = arc_[i + 1] - arc_[i];
  const double share = span > 1e-12 ? std::clamp((s - arc_[i]) / span, 0.0, 1.0) : 0.0;
  return (static_cast<double>(i) + share) / kSamples;
}

Vec3 Curve::Position(double s) const {
  Vec3 p;
  Derivatives(Parameter(s), &p, nullptr, nullptr);
  return p;
}

Vec3 Curve::Tangent(double s) const {
  Vec3 d1;
  Derivatives(Parameter(s), nullptr, &d1, nullptr);
  const double norm = d1.norm();
  return norm > 1e-9 ? Vec3(d1 / norm) : Vec3(Vec3::UnitX());
}

double Curve::Curvature(double s) const {
  Vec3 d1, d2;
  Derivatives(Parameter(s), nullptr, &d1, &d2);
  const double norm = d1.norm();
  return norm > 1e-6 ? d1.cross(d2).norm() / (norm * norm * norm) : 0.0;
}

double Curve::HorizontalCurvature(double s) const {
  Vec3 d1, d2;
  Derivatives(Parameter(s), nullptr, &d1, &d2);
  const double flat = d1.head<2>().squaredNorm();
  if (flat < 0.04 * d1.squaredNorm()) return 0.0;  // all but vertical: there is no heading to follow
  return std::abs(d1.x() * d2.y() - d1.y() * d2.x()) / flat / d1.norm();
}

double Curve::Nearest(const Vec3& p, double from) const {
  double best = std::numeric_limits<double>::infinity();
  double best_s = from;
  for (std::size_t i = 0; i < arc_.size(); ++i) {
    if (arc_[i] < from) continue;
    Vec3 q;
    Derivatives(static_cast<double>(i) / kSamples, &q, nullptr, nullptr);
    const double distance = (q - p).squaredNorm();
    if (distance < best) {
      best = distance;
      best_s = arc_[i];
    }
  }
  return best_s;
}

}  // namespace alula::stack::planning

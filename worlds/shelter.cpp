#include "worlds/shelter.h"

#include <algorithm>
#include <cmath>

namespace alula::worlds {
namespace {

using base::Vec2;

constexpr double kMost = 0.95;
constexpr double kFar = 30.0;  // heights

/// Pieces of one wall that stand on each other become one outline.
std::vector<Outline> Stacked(std::vector<Outline> outlines) {
  constexpr double kSame = 0.02;  // m
  std::stable_sort(outlines.begin(), outlines.end(), [](const Outline& a, const Outline& b) { return a.low < b.low; });
  std::vector<Outline> standing;
  for (const Outline& piece : outlines) {
    const auto below = std::find_if(standing.begin(), standing.end(), [&](const Outline& o) {
      return (o.centre - piece.centre).norm() < kSame && (o.half - piece.half).norm() < kSame &&
             std::abs(o.high - piece.low) < kSame;
    });
    if (below != standing.end()) {
      below->high = piece.high;
    } else if (piece.low < 0.5) {
      standing.push_back(piece);
    }
  }
  return standing;
}

}  // namespace

double FenceDeficit(double x, double z, double h) {
  constexpr double kRoughness = 0.03;  // m
  constexpr double kBubble = 5.0;      // heights
  if (!(x > 0.0) || x > kFar * h || z < 0.0) return 0.0;
  const double K = 0.32 / std::log(std::max(h / kRoughness, 2.0));
  const double at = std::max(x / h, kBubble);
  const double eta = std::max(z / h, 0.1) * std::pow(K * at, -0.47);
  const double deficit = 9.75 / at * eta * std::exp(-0.67 * std::pow(eta, 1.5));
  const double fade = z < h ? 1.0 : std::min(x / (kBubble * h), 1.0);
  return std::clamp(fade * deficit, 0.0, kMost);
}

Shelter::Shelter(const World& world, const base::Vec3& mean_W) {
  constexpr double kLowest = 0.5;  // m
  const double speed = mean_W.head<2>().norm();
  if (!(speed > 0.0)) return;
  along_ = mean_W.head<2>() / speed;
  const Vec2 side(-along_.y(), along_.x());
  for (const Outline& outline : Stacked(OutlinesOf(world))) {
    if (outline.high < kLowest) continue;
    const Vec2 second(-outline.along.y(), outline.along.x());
    const auto reach = [&](const Vec2& d) {
      return std::abs(d.dot(outline.along)) * outline.half.x() + std::abs(d.dot(second)) * outline.half.y() +
             outline.radius;
    };
    bodies_.push_back(
        {along_.dot(outline.centre) + reach(along_), side.dot(outline.centre), reach(side), outline.high});
  }
}

double Shelter::Through(const base::Vec3& p_W) const {
  constexpr double kSpread = 0.15;
  const double x = along_.dot(p_W.head<2>());
  const double y = -along_.y() * p_W.x() + along_.x() * p_W.y();
  double deficit = 0.0;
  for (const Body& body : bodies_) {
    const double behind = x - body.lee;
    if (behind <= 0.0 || behind > kFar * body.height) continue;
    const double sigma = std::max(kSpread * behind, 0.05);
    const double off = y - body.across;
    if (std::abs(off) > body.half + 4.0 * sigma) continue;
    const double scale = 1.0 / (std::sqrt(2.0) * sigma);
    const double share = 0.5 * (std::erf((off + body.half) * scale) - std::erf((off - body.half) * scale));
    deficit += share * FenceDeficit(behind, p_W.z(), body.height);
  }
  return 1.0 - std::min(deficit, kMost);
}

}  // namespace alula::worlds

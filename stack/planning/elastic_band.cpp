#include "stack/planning/elastic_band.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace alula::stack::planning {

using base::Vec3;

void AppendLine(std::vector<BandPoint>& band, const Vec3& b_O, double spacing, bool fixed) {
  const Vec3 a = band.back().p_O;
  const int count = std::max(1, static_cast<int>(std::lround((b_O - a).norm() / spacing)));
  for (int i = 1; i <= count; ++i) band.push_back({a + (b_O - a) * (static_cast<double>(i) / count), fixed});
  band.back().p_O = b_O;
}

void SmoothBand(std::vector<BandPoint>& band, const mapping::ClearanceField& field,
                const std::function<bool(const Vec3&)>& allowed, const BandOptions& options) {
  const auto n = static_cast<int>(band.size());
  constexpr std::array<int, 3> kStrides{4, 2, 1};
  for (const int m : kStrides) {
    for (int round = 0; round < options.rounds / 3; ++round) {
      for (int i = 1; i + 1 < n; ++i) {
        BandPoint& point = band[static_cast<std::size_t>(i)];
        if (point.fixed) continue;
        const auto at = [&](int k) -> const Vec3& { return band[static_cast<std::size_t>(k)].p_O; };
        Vec3 wanted;
        if (i - 2 * m >= 0 && i + 2 * m < n) {
          wanted = (4.0 * (at(i - m) + at(i + m)) - at(i - 2 * m) - at(i + 2 * m)) / 6.0;
        } else {
          wanted = 0.5 * (at(i - 1) + at(i + 1));
        }
        Vec3 moved = point.p_O + 0.6 * (wanted - point.p_O);
        const double clearance = field.Clearance(point.p_O);
        if (clearance < options.comfortable) {
          moved += field.ClearanceGradient(point.p_O) * (options.push * (options.comfortable - clearance));
        }
        if (allowed(moved)) point.p_O = moved;
      }
    }
  }
}

}  // namespace alula::stack::planning

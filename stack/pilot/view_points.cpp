#include "stack/pilot/view_points.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace alula::stack::pilot {

std::vector<base::Vec3> ViewPoints(const base::Transform& X_OG, double distance, int look, double ground_O) {
  struct Offset {
    double distance;
    double angle;  // rad off the normal
  };
  const std::array<Offset, 7> offsets{
      {{0.0, 0.0}, {-0.45, 0.0}, {0.1, 0.4}, {0.1, -0.4}, {1.0, 0.0}, {-0.2, 0.65}, {-0.2, -0.65}}};
  std::vector<base::Vec3> points;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const Offset& offset = offsets[(i + static_cast<std::size_t>(look)) % offsets.size()];
    const double d = distance + offset.distance;
    base::Vec3 p = X_OG * base::Vec3(-d * std::cos(offset.angle), d * std::sin(offset.angle), 0.0);
    p.z() = std::max(p.z(), ground_O + 0.7);
    points.push_back(p);
  }
  return points;
}

}  // namespace alula::stack::pilot

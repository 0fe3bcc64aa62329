#include "scenarios/trajectory/completeness.h"

#include <algorithm>

namespace alula::scenarios::trajectory {
namespace {

/// Half of the median time between images; an instant for fewer than two.
base::Duration HalfPeriod(const std::vector<base::Time>& images) {
  if (images.size() < 2) return {};
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < images.size(); ++i) steps.push_back((images[i] - images[i - 1]).ns);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return {*middle / 2};
}

std::vector<base::Time> Covered(const std::vector<base::Time>& images, const std::vector<base::StampedPose>& truth) {
  if (truth.empty()) return images;
  const auto first = std::lower_bound(images.begin(), images.end(), truth.front().time);
  const auto end = std::upper_bound(first, images.end(), truth.back().time);
  return {first, end};
}

}  // namespace

Completeness CompletenessOf(const std::vector<base::Time>& images, const std::vector<base::StampedPose>& estimate,
                            const std::vector<base::StampedPose>& truth) {
  const base::Duration reach = HalfPeriod(images);
  const std::vector<base::Time> counting = Covered(images, truth);
  Completeness result;
  result.images = static_cast<std::int64_t>(counting.size());
  if (counting.empty()) return result;
  auto pose = estimate.begin();
  for (const base::Time image : counting) {
    while (pose != estimate.end() && pose->time + reach < image) ++pose;
    if (pose == estimate.end() || pose->time > image + reach) continue;
    ++result.with_pose;
    ++pose;  // a pose serves one image
  }
  base::Time last = counting.front();
  bool begun = false;
  const auto see = [&](base::Time time) {
    (begun ? result.longest_gap : result.until_first) =
        begun ? std::max(result.longest_gap, time - last) : time - counting.front();
    last = time;
  };
  for (const base::StampedPose& p : estimate) {
    if (p.time + reach < counting.front() || p.time > counting.back() + reach) continue;
    see(std::max(p.time, counting.front()));
    begun = true;
  }
  see(std::max(counting.back(), last));
  return result;
}

}  // namespace alula::scenarios::trajectory

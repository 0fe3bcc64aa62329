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

std::vector<base::Time> Within(const std::vector<base::StampedPose>& poses, base::Time first, base::Time last) {
  std::vector<base::Time> times;
  for (const base::StampedPose& pose : poses) {
    if (pose.time >= first && pose.time <= last) times.push_back(pose.time);
  }
  return times;
}

/// Of the poses among the images; the latter are not empty.
void AddGaps(const std::vector<base::Time>& poses, const std::vector<base::Time>& images, Completeness& result) {
  constexpr base::Duration kNone{};
  if (poses.empty()) {
    result.until_first = images.back() - images.front();
    return;
  }
  result.until_first = std::max(kNone, poses.front() - images.front());
  result.longest_gap = std::max(kNone, images.back() - poses.back());
  for (std::size_t i = 1; i < poses.size(); ++i) {
    result.longest_gap = std::max(result.longest_gap, poses[i] - poses[i - 1]);
  }
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
  AddGaps(Within(estimate, counting.front() + -reach, counting.back() + reach), counting, result);
  return result;
}

}  // namespace alula::scenarios::trajectory

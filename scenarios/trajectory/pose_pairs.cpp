#include "scenarios/trajectory/pose_pairs.h"

#include <algorithm>

namespace alula::scenarios::trajectory {

std::optional<base::Transform> TruthAt(const std::vector<base::StampedPose>& truth, base::Time time,
                                       base::Duration largest_gap) {
  const auto after = std::lower_bound(truth.begin(), truth.end(), time,
                                      [](const base::StampedPose& pose, base::Time t) { return pose.time < t; });
  if (after == truth.end()) return std::nullopt;
  if (after->time == time) return after->X_FS;
  if (after == truth.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const base::Duration gap = after->time - before->time;
  if (gap > largest_gap) return std::nullopt;
  const double s = (time - before->time).Seconds() / gap.Seconds();
  const base::Vec3 turn = base::Log(before->X_FS.q.conjugate() * after->X_FS.q);
  return base::Transform{(before->X_FS.q * base::Exp(s * turn)).normalized(),
                         (1.0 - s) * before->X_FS.p + s * after->X_FS.p};
}

std::vector<PosePair> Associate(const std::vector<base::StampedPose>& estimate,
                                const std::vector<base::StampedPose>& truth, base::Duration largest_gap) {
  std::vector<PosePair> pairs;
  for (const base::StampedPose& pose : estimate) {
    if (const auto X = TruthAt(truth, pose.time, largest_gap)) pairs.push_back({pose.time, pose.X_FS, *X});
  }
  return pairs;
}

std::vector<double> PathOf(const std::vector<PosePair>& pairs) {
  std::vector<double> path;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    path.push_back(i == 0 ? 0.0 : path.back() + (pairs[i].truth.p - pairs[i - 1].truth.p).norm());
  }
  return path;
}

}  // namespace alula::scenarios::trajectory

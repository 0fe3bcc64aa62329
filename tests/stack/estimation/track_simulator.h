#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "stack/estimation/internal/sliding_window.h"
#include "tests/stack/estimation/flight.h"

namespace alula::stack::estimation::test {

/// Tracks of random points in a box, as a perfect front end with pixel noise would deliver them.
class TrackSimulator {
 public:
  TrackSimulator(const Calibration& truth, const Calibration& told, const Vec3& low, const Vec3& high, int points,
                 double pixel_noise, double time_offset, std::uint64_t seed)
      : truth_(truth), told_(told), noise_(pixel_noise), time_offset_(time_offset), random_(seed, "test/tracks") {
    for (int i = 0; i < points; ++i) {
      Vec3 p;
      for (int k = 0; k < 3; ++k) p[k] = random_.Uniform(low[k], high[k]);
      // Onto one of the box's faces, the ceiling excepted: what a walled yard shows.
      const std::uint64_t face = random_.Index(5);
      if (face == 0) p.x() = low.x();
      if (face == 1) p.x() = high.x();
      if (face == 2) p.y() = low.y();
      if (face == 3) p.y() = high.y();
      if (face == 4) p.z() = low.z();
      points_.push_back(p);
    }
  }

  struct Pair {
    std::vector<Sighting> sightings;
    bool keyframe = false;
  };

  /// What the pair stamped `stamp` shows: followed points that are still visible and, in a keyframe, new ones.
  Pair See(const Flight& flight, Time stamp) {
    const Motion m = flight.At(stamp + base::Seconds(time_offset_));
    std::map<std::uint64_t, Sighting> visible;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto left = Look(m, 0, points_[i]);
      if (!left) continue;
      visible.emplace(i, Sighting{i, *left, Look(m, 1, points_[i])});
    }
    Pair pair;
    std::vector<double> parallax;
    const Quat q_CR = (reference_.q.conjugate() * m.X_WB.q * truth_.cameras[0].X_BC.q).conjugate();
    for (auto it = followed_.begin(); it != followed_.end();) {
      const auto seen = visible.find(it->first);
      if (seen == visible.end()) {
        it = followed_.erase(it);
        continue;
      }
      const Vec3 turned = q_CR * Vec3(it->second.homogeneous());
      parallax.push_back((turned.head<2>() / turned.z() - seen->second.left).norm() * truth_.cameras[0].intrinsics.fx);
      pair.sightings.push_back(seen->second);
      ++it;
    }
    std::sort(parallax.begin(), parallax.end());
    pair.keyframe = static_cast<double>(parallax.size()) < 0.65 * reference_count_ || parallax.size() < 60 ||
                    parallax[parallax.size() / 2] > 12.0;
    if (!pair.keyframe) return pair;
    for (const auto& [id, sighting] : visible) {
      if (followed_.size() >= 150) break;
      if (followed_.contains(id) || !sighting.right) continue;
      followed_[id] = sighting.left;
      pair.sightings.push_back(sighting);
    }
    for (const Sighting& s : pair.sightings) followed_[s.track] = s.left;
    reference_ = m.X_WB * truth_.cameras[0].X_BC;
    reference_count_ = static_cast<double>(followed_.size());
    return pair;
  }

 private:
  /// Noisy normalised coordinates as the told calibration has them.
  std::optional<base::Vec2> Look(const Motion& m, std::size_t eye, const Vec3& p_W) {
    const CameraIntrinsics& real = truth_.cameras[eye].intrinsics;
    const CameraIntrinsics& told = told_.cameras[eye].intrinsics;
    const Vec3 p = (m.X_WB * truth_.cameras[eye].X_BC).Inverse() * p_W;
    if (p.z() < 0.4 || p.z() > 30) return std::nullopt;
    const base::Vec2 pixel(real.fx * p.x() / p.z() + real.cx, real.fy * p.y() / p.z() + real.cy);
    if (!Inside(real, pixel, 10)) return std::nullopt;
    const base::Vec2 noisy(pixel.x() + noise_ * random_.Gaussian(), pixel.y() + noise_ * random_.Gaussian());
    return Normalise(told, noisy);
  }

  Calibration truth_, told_;
  double noise_, time_offset_;
  base::RandomStream random_;
  std::vector<Vec3> points_;
  std::map<std::uint64_t, base::Vec2> followed_;
  Transform reference_;
  double reference_count_ = 0;
};

}  // namespace alula::stack::estimation::test

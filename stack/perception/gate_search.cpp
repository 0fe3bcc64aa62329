#include <algorithm>
#include <cmath>

#include "stack/perception/internal/gate_fit.h"

namespace alula::stack::perception::internal {

namespace {

constexpr double kStep = 0.06;       // m, cell of the raster
constexpr double kSoftness = 0.05;   // m, added to depth errors because poses are coarse
constexpr int kYawSteps = 3;         // to each side
constexpr double kNormalStep = 0.2;  // m

struct Candidate {
  GatePose pose;
  double score = -1e9;
};

/// Mean evidence in the plane of a pose, with box means in constant time (summed-area table).
class Raster {
 public:
  explicit Raster(double reach) : reach_(reach), n_(static_cast<int>(std::ceil(2 * reach / kStep))) {}

  void Fill(const std::vector<Crossing>& crossings) {
    sum_.assign(static_cast<std::size_t>(n_) * n_, 0.0);
    weight_.assign(sum_.size(), 0.0);
    for (const Crossing& c : crossings) {
      const int y = static_cast<int>((c.y_in + reach_) / kStep);
      const int z = static_cast<int>((c.z_in + reach_) / kStep);
      if (y < 0 || z < 0 || y >= n_ || z >= n_) continue;
      sum_[static_cast<std::size_t>(y) * n_ + z] += static_cast<double>(c.evidence * c.weight);
      weight_[static_cast<std::size_t>(y) * n_ + z] += static_cast<double>(c.weight);
    }
    table_.assign(static_cast<std::size_t>(n_ + 1) * (n_ + 1), 0.0);
    for (int y = 0; y < n_; ++y) {
      double row = 0.0;
      for (int z = 0; z < n_; ++z) {
        const std::size_t at = static_cast<std::size_t>(y) * n_ + z;
        row += sum_[at] / (weight_[at] + 1.0);  // cells that nobody looked at say nothing
        table_[Corner(y + 1, z + 1)] = table_[Corner(y, z + 1)] + row;
      }
    }
  }

  /// Mean over the cells [y0, y1) × [z0, z1).
  double Mean(int y0, int y1, int z0, int z1) const {
    const double sum =
        table_[Corner(y1, z1)] - table_[Corner(y0, z1)] - table_[Corner(y1, z0)] + table_[Corner(y0, z0)];
    return sum / ((y1 - y0) * (z1 - z0));
  }

  int size() const { return n_; }
  double Coordinate(double cell) const { return cell * kStep - reach_; }

 private:
  std::size_t Corner(int y, int z) const { return static_cast<std::size_t>(y) * (n_ + 1) + z; }

  double reach_;
  int n_;
  std::vector<double> sum_, weight_, table_;
};

/// The best place of the frame on the raster: evidence on four bars, less evidence in the opening.
Candidate BestPlace(const Raster& raster, const GatePose& pose, double opening, double bar_width) {
  const int n = raster.size();
  const int in = static_cast<int>(std::lround(opening / kStep));
  const int bar = std::max(1, static_cast<int>(std::lround(bar_width / kStep)));
  Candidate best;
  for (int y = bar; y + in + bar <= n; ++y) {
    for (int z = bar; z + in + bar <= n; ++z) {
      const double bars = raster.Mean(y - bar, y, z, z + in) + raster.Mean(y + in, y + in + bar, z, z + in) +
                          raster.Mean(y, y + in, z - bar, z) + raster.Mean(y, y + in, z + in, z + in + bar);
      const double score = 0.25 * bars - 0.5 * raster.Mean(y, y + in, z, z + in);
      if (score <= best.score) continue;
      const double left = raster.Coordinate(y + 0.5 * in);
      const double up = raster.Coordinate(z + 0.5 * in);
      best = {{pose.p_O + left * pose.Left() + up * base::Vec3::UnitZ(), pose.yaw}, score};
    }
  }
  return best;
}

}  // namespace

std::vector<GatePose> GateFit::Search(const std::vector<GateView>& views, const GatePose& hint) const {
  const double margin = config_.search_in_plane + config_.bar_width;
  const int normal_steps = std::max(1, static_cast<int>(std::ceil(config_.search_normal / kNormalStep)));
  Raster raster(0.5 * opening_ + margin);
  std::vector<Crossing> crossings;
  std::vector<Candidate> candidates;
  for (int a = -kYawSteps; a <= kYawSteps; ++a) {
    for (int b = -normal_steps; b <= normal_steps; ++b) {
      GatePose pose = hint;
      pose.yaw += config_.search_yaw * a / kYawSteps;
      pose.p_O += hint.Normal() * (config_.search_normal * b / normal_steps);
      Cross(views, pose, margin, kSoftness, 2, crossings);
      raster.Fill(crossings);
      candidates.push_back(BestPlace(raster, pose, opening_, config_.bar_width));
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& p, const Candidate& q) { return p.score > q.score; });
  std::vector<GatePose> poses;
  for (const Candidate& c : candidates) {
    const bool known = std::any_of(poses.begin(), poses.end(), [&c](const GatePose& p) {
      return (p.p_O - c.pose.p_O).norm() < 0.25 && std::abs(p.yaw - c.pose.yaw) < 0.2;
    });
    if (!known) poses.push_back(c.pose);
    if (poses.size() == 3) break;
  }
  return poses;
}

}  // namespace alula::stack::perception::internal

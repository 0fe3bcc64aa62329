#include "scenarios/check/photon_transfer_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scenarios/check/check_worlds.h"
#include "scenarios/check/statistics.h"

namespace alula::scenarios::check {
namespace {

/// Pixels of one mean, rounded to a grey level.
struct Level {
  double means = 0.0, variances = 0.0, pixels = 0.0;
  bool clipped = false;
};

std::array<Level, 256> Pool(const std::vector<Frame>& frames) {
  std::array<Level, 256> levels;
  const double n = static_cast<double>(frames.size());
  for (std::size_t i = 0; i < frames.front().bytes->size(); ++i) {
    double sum = 0.0, squares = 0.0;
    bool clipped = false;
    for (const Frame& frame : frames) {
      const double value = (*frame.bytes)[i];
      sum += value;
      squares += value * value;
      clipped = clipped || value == 0.0 || value == 255.0;
    }
    const double mean = sum / n;
    Level& level = levels[static_cast<std::size_t>(std::lround(mean))];
    level.means += mean;
    level.variances += (squares - n * mean * mean) / (n - 1.0);
    level.pixels += 1.0;
    level.clipped = level.clipped || clipped;
  }
  return levels;
}

}  // namespace

PhotonTransfer MeasurePhotonTransfer(const std::vector<Frame>& frames) {
  constexpr double kLeastVariance = 0.25, kLeastPixels = 20.0;
  std::vector<Level> used;
  for (const Level& level : Pool(frames)) {
    const bool enough = level.pixels >= kLeastPixels && level.variances >= kLeastVariance * level.pixels;
    if (enough && !level.clipped) used.push_back(level);
  }
  PhotonTransfer curve;
  curve.levels = static_cast<double>(used.size());
  if (used.size() < 3) return curve;
  const auto rows = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd A(rows, 2);
  Eigen::VectorXd b(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Level& level = used[i];
    const double variance = level.variances / level.pixels;
    const double weight = std::sqrt(level.pixels) / variance;  // the error of a variance goes as itself over √n
    A.row(i) << weight, weight * level.means / level.pixels;
    b[i] = weight * variance;
  }
  const Solution line = LeastSquares(A, b);
  curve.read_variance = line.x[0];
  curve.shot = line.x[1];
  curve.read_variance_sigma = line.sigma[0];
  curve.shot_sigma = line.sigma[1];
  return curve;
}

void CheckPhotonTransfer(const Rig& isolated, const sim::CameraConfig& claimed,
                         const std::vector<CameraGeometry>& cameras, Report& report) {
  constexpr int kFrames = 16;
  constexpr double kDistance = 2.0;  // m
  const stack::CameraIntrinsics& k = cameras.front().intrinsics;
  const auto renderer = render::MakeRenderer(isolated.render, GreyWall(0.6 * kDistance * k.width / k.fx), {});
  const base::Transform X_WC = ChartPose() * base::Transform{base::Quat::Identity(), {0.0, 0.0, -kDistance}};
  const base::Duration duration = claimed.rate.SampleTime(kFrames) - base::Time{} + claimed.read_out;
  const std::vector<Frame> frames =
      FramesOf(Record(isolated, renderer.get(), Rest(BodyPose(X_WC, cameras.front().X_BC)), duration));
  constexpr double kShare = 0.05;
  for (const CameraGeometry& camera : cameras) {
    std::vector<Frame> own;
    std::copy_if(frames.begin(), frames.end(), std::back_inserter(own),
                 [&camera](const Frame& frame) { return frame.sensor == camera.sensor; });
    const PhotonTransfer curve = MeasurePhotonTransfer(own);
    const double read = std::sqrt(std::max(0.0, curve.read_variance));
    const double read_sigma = 0.5 * curve.read_variance_sigma / std::max(claimed.noise.read_sigma, 0.1);
    report.Add(Compare(camera.name, "photon transfer: shot", claimed.noise.shot, curve.shot,
                       std::max(kShare * claimed.noise.shot, kSigmas * curve.shot_sigma), "1/level"));
    report.Add(Compare(camera.name, "photon transfer: read noise", claimed.noise.read_sigma, read,
                       std::max(kShare * claimed.noise.read_sigma, kSigmas * read_sigma), "level"));
  }
  report.Note(
      "photon transfer: exposure control off (nominal exposure, gain 1), and gamma, coarse bits, dirt, glare and "
      "lamps");
}

}  // namespace alula::scenarios::check

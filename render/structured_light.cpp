#include "render/structured_light.h"

#include <algorithm>
#include <cmath>

namespace alula::render {
namespace {

/// 64 bits that belong to (key, a, b).
std::uint64_t Mix(std::uint64_t key, std::uint64_t a, std::uint64_t b) {
  std::uint64_t x = key ^ (a * 0x9e3779b97f4a7c15ULL) ^ (b * 0xc2b2ae3d27d4eb4fULL);
  x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93ULL;
  x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93ULL;
  return x ^ (x >> 32);
}

/// Sum of eight bytes, made normal: mean 0, variance 1.
double Deviate(std::uint64_t bits) {
  int sum = 0;
  for (int i = 0; i < 8; ++i) sum += static_cast<int>((bits >> (8 * i)) & 0xff);
  constexpr double kSigma = 209.0183;  // √(8 (256² − 1) / 12)
  return (sum - 1020) / kSigma;
}

/// Noise that runs smoothly over cells of kCell pixels, of variance 1 at each pixel.
class WindowNoise {
 public:
  WindowNoise(std::uint64_t key, int width, int height) : columns_(width / kCell + 2) {
    const int rows = height / kCell + 2;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns_; ++x) {
        nodes_.push_back(Deviate(Mix(key, static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y))));
      }
    }
  }
  double At(int u, int v) const {
    const double x = static_cast<double>(u % kCell) / kCell, y = static_cast<double>(v % kCell) / kCell;
    const double weights[4] = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    const std::size_t node =
        static_cast<std::size_t>(v / kCell) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(u / kCell);
    const std::size_t below = node + static_cast<std::size_t>(columns_);
    const double sum = weights[0] * nodes_[node] + weights[1] * nodes_[node + 1] + weights[2] * nodes_[below] +
                       weights[3] * nodes_[below + 1];
    double squares = 0;
    for (const double w : weights) squares += w * w;
    return sum / std::sqrt(squares);
  }

 private:
  static constexpr int kCell = 5;  // px: half of a matcher's window of 9 px or so
  int columns_;
  std::vector<double> nodes_;
};

/// Marks what a row's projector rays do not reach: seen from the left, a pixel lies in the shadow of one to its left
/// that appears farther right (columns of the projector: u + f b / z).
void FindShadows(const float* row, int width, double focal_baseline, std::vector<std::uint8_t>& lit) {
  double farthest_right = -1e30;
  for (int u = 0; u < width; ++u) {
    const auto z = static_cast<double>(row[u]);
    if (!(z > 0.0)) {
      lit[static_cast<std::size_t>(u)] = 0;
      continue;
    }
    const double column = u + focal_baseline / z;
    lit[static_cast<std::size_t>(u)] = column >= farthest_right;
    farthest_right = std::max(farthest_right, column);
  }
}

/// Tangent of the angle between ray and normal about a pixel, from its neighbours' depths; infinite at edges of sight.
double Slope(const DepthPicture& depth, int u, int v, double focal) {
  const auto at = [&](int x, int y) {
    return static_cast<double>(depth.metres[static_cast<std::size_t>(y) * static_cast<std::size_t>(depth.width) +
                                            static_cast<std::size_t>(x)]);
  };
  const double z = at(u, v);
  const int left = std::max(u - 1, 0), right = std::min(u + 1, depth.width - 1);
  const int up = std::max(v - 1, 0), down = std::min(v + 1, depth.height - 1);
  const double neighbours[4] = {at(left, v), at(right, v), at(u, up), at(u, down)};
  double steepest = 0.0;
  for (const double other : neighbours) steepest = std::max(steepest, other > 0.0 ? std::abs(other - z) : 1e30);
  return steepest * focal / z;
}

}  // namespace

void Describe(base::Description& d, StructuredLight& c) {
  d.Field("baseline", c.baseline, {.unit = "m", .meaning = "from projector to infrared camera", .min = 1e-3, .max = 1});
  d.Field("disparity_noise", c.disparity_noise, {.unit = "px", .meaning = "standard deviation", .min = 0, .max = 10});
  d.Field("disparity_step", c.disparity_step,
          {.unit = "px", .meaning = "what disparity is rounded to", .min = 1e-4, .max = 4});
  d.Field("nearest", c.nearest, {.unit = "m", .meaning = "that is measured", .min = 0.05, .max = 100});
  d.Field("farthest", c.farthest, {.unit = "m", .meaning = "that is measured", .min = 0.1, .max = 65});
  d.Field("grazing", c.grazing,
          {.unit = "rad", .meaning = "angle of ray and normal above which it is lost", .min = 0.1, .max = 1.57});
  d.Field("holes", c.holes, {.unit = "1", .meaning = "share of spots that are lost anywhere", .min = 0, .max = 1});
  d.Field("blinding", c.blinding,
          {.unit = "1",
           .meaning = "grey value, share of full scale, at which light drowns the pattern",
           .min = 0,
           .max = 2});
  d.Check("farthest", [&c] { return c.farthest <= c.nearest ? std::string("must be above nearest") : std::string(); });
}

std::vector<std::uint16_t> MeasureDepth(const DepthPicture& depth, double focal, const Picture* ambient,
                                        const std::vector<std::uint8_t>* glass, const StructuredLight& sensor,
                                        std::uint64_t key) {
  const double focal_baseline = focal * sensor.baseline;
  const double steepest = std::tan(sensor.grazing);
  const auto hole = static_cast<std::uint64_t>(sensor.holes * 4294967296.0);
  const WindowNoise noise(Mix(key, 1, 0), depth.width, depth.height);
  const std::uint64_t hole_key = Mix(key, 2, 0);
  std::vector<std::uint16_t> millimetres(depth.metres.size(), 0);
  std::vector<std::uint8_t> lit(static_cast<std::size_t>(depth.width));
  for (int v = 0; v < depth.height; ++v) {
    const std::size_t row = static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width);
    FindShadows(depth.metres.data() + row, depth.width, focal_baseline, lit);
    for (int u = 0; u < depth.width; ++u) {
      const std::size_t i = row + static_cast<std::size_t>(u);
      const auto z = static_cast<double>(depth.metres[i]);
      if (lit[static_cast<std::size_t>(u)] == 0 || z < sensor.nearest || z > sensor.farthest) continue;
      if (glass != nullptr && (*glass)[i] != 0) continue;
      if (ambient != nullptr && ambient->bytes[i] >= sensor.blinding * 255.0) continue;
      const std::uint64_t spot = Mix(hole_key, static_cast<std::uint64_t>(u / 2), static_cast<std::uint64_t>(v / 2));
      if ((spot >> 32) < hole || Slope(depth, u, v, focal) > steepest) continue;
      const double disparity = focal_baseline / z + sensor.disparity_noise * noise.At(u, v);
      const double rounded = sensor.disparity_step * std::round(disparity / sensor.disparity_step);
      const double measured = rounded > 0.0 ? 1000.0 * focal_baseline / rounded : 0.0;
      if (measured >= 0.5 && measured < 65535.0) millimetres[i] = static_cast<std::uint16_t>(measured + 0.5);
    }
  }
  return millimetres;
}

std::vector<std::uint16_t> RegisterDepth(const std::vector<std::uint16_t>& millimetres,
                                         const stack::CameraIntrinsics& depth, const stack::CameraIntrinsics& other,
                                         const base::Transform& X_CD) {
  std::vector<std::uint16_t> out(static_cast<std::size_t>(other.width) * static_cast<std::size_t>(other.height), 0);
  const base::Mat3 R_CD = X_CD.R();
  const auto project = [&](double u, double v, double z) {
    const base::Vec3 p = R_CD * base::Vec3(z * (u - depth.cx) / depth.fx, z * (v - depth.cy) / depth.fy, z) + X_CD.p;
    return base::Vec3(other.fx * p.x() / p.z() + other.cx, other.fy * p.y() / p.z() + other.cy, p.z());
  };
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      const std::uint16_t there = millimetres[static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width) +
                                              static_cast<std::size_t>(u)];
      if (there == 0) continue;
      const double z = 1e-3 * there;
      const base::Vec3 low = project(u - 0.5, v - 0.5, z), high = project(u + 0.5, v + 0.5, z);
      if (!(low.z() > 0.0) || !(low.z() < 65.0)) continue;
      const auto here = static_cast<std::uint16_t>(500.0 * (low.z() + high.z()) + 0.5);
      // Pixels whose centres the patch covers.
      const int x0 = std::max(static_cast<int>(std::ceil(low.x())), 0);
      const int y0 = std::max(static_cast<int>(std::ceil(low.y())), 0);
      const int x1 = std::min(static_cast<int>(std::ceil(high.x())), other.width);
      const int y1 = std::min(static_cast<int>(std::ceil(high.y())), other.height);
      for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
          std::uint16_t& pixel =
              out[static_cast<std::size_t>(y) * static_cast<std::size_t>(other.width) + static_cast<std::size_t>(x)];
          if (pixel == 0 || here < pixel) pixel = here;
        }
      }
    }
  }
  return out;
}

}  // namespace alula::render

#include "render/structured_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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
  void Row(int v, std::vector<double>& row) const {
    const double y = static_cast<double>(v % kCell) / kCell;
    std::array<std::array<double, 4>, kCell> weights{};  // of the nodes about a pixel, by its column in the cell
    for (int i = 0; i < kCell; ++i) {
      const double x = static_cast<double>(i) / kCell;
      const double squares = ((1 - x) * (1 - x) + x * x) * ((1 - y) * (1 - y) + y * y);
      const double unit = 1.0 / std::sqrt(squares);
      weights[static_cast<std::size_t>(i)] = {(1 - x) * (1 - y) * unit, x * (1 - y) * unit, (1 - x) * y * unit,
                                              x * y * unit};
    }
    const double* upper = nodes_.data() + static_cast<std::ptrdiff_t>(v / kCell) * columns_;
    const double* lower = upper + columns_;
    for (std::size_t u = 0; u < row.size(); u += kCell, ++upper, ++lower) {
      for (std::size_t i = 0; i < kCell && u + i < row.size(); ++i) {
        const std::array<double, 4>& w = weights[i];
        row[u + i] = w[0] * upper[0] + w[1] * upper[1] + w[2] * lower[0] + w[3] * lower[1];
      }
    }
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

/// The largest step of depth from a pixel to its neighbours, m; infinite at edges of sight.
double SteepestStep(const DepthPicture& depth, int u, int v) {
  const float* here = depth.metres.data() + static_cast<std::ptrdiff_t>(v) * depth.width + u;
  const std::array<float, 4> neighbours = {here[u > 0 ? -1 : 0], here[u + 1 < depth.width ? 1 : 0],
                                           here[v > 0 ? -depth.width : 0],
                                           here[v + 1 < depth.height ? depth.width : 0]};
  float steepest = 0.0F;
  for (const float other : neighbours) {
    steepest = std::max(steepest, other > 0.0F ? std::abs(other - *here) : std::numeric_limits<float>::infinity());
  }
  return static_cast<double>(steepest);
}

/// The first whole number from `edge` on, held within [0, size].
int FirstCentre(double edge, int size) {
  const double held = std::clamp(edge, 0.0, static_cast<double>(size));
  const int below = static_cast<int>(held);
  return below + (below < held ? 1 : 0);
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
  const double steepest = std::tan(sensor.grazing) / focal;  // step over depth: tangent of the angle of ray and normal
  const double drowned = sensor.blinding * 255.0;
  const auto hole = static_cast<std::uint64_t>(sensor.holes * 4294967296.0);
  const WindowNoise window_noise(Mix(key, 1, 0), depth.width, depth.height);
  const std::uint64_t hole_key = Mix(key, 2, 0);
  const auto width = static_cast<std::size_t>(depth.width);
  std::vector<std::uint16_t> millimetres(depth.metres.size(), 0);
  std::vector<std::uint8_t> lit(width);
  std::vector<double> noise(width);
  for (int v = 0; v < depth.height; ++v) {
    const std::size_t row = static_cast<std::size_t>(v) * width;
    FindShadows(depth.metres.data() + row, depth.width, focal_baseline, lit);
    window_noise.Row(v, noise);
    bool lost = false;
    for (int u = 0; u < depth.width; ++u) {
      const std::size_t i = row + static_cast<std::size_t>(u);
      if (u % 2 == 0) {  // a spot is 2×2 px
        lost = (Mix(hole_key, static_cast<std::uint64_t>(u / 2), static_cast<std::uint64_t>(v / 2)) >> 32) < hole;
      }
      const auto z = static_cast<double>(depth.metres[i]);
      if (lost || lit[static_cast<std::size_t>(u)] == 0 || z < sensor.nearest || z > sensor.farthest) continue;
      if (glass != nullptr && (*glass)[i] != 0) continue;
      if (ambient != nullptr && ambient->bytes[i] >= drowned) continue;
      if (SteepestStep(depth, u, v) > steepest * z) continue;
      const double disparity = focal_baseline / z + sensor.disparity_noise * noise[static_cast<std::size_t>(u)];
      const double rounded = sensor.disparity_step * std::floor(disparity / sensor.disparity_step + 0.5);
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
  // A ray with unit depth through the edges of pixels is one part by column plus one by row.
  std::vector<base::Vec3> columns;
  for (int u = 0; u <= depth.width; ++u) columns.push_back(R_CD.col(0) * ((u - 0.5 - depth.cx) / depth.fx));
  const auto of_row = [&](double v) -> base::Vec3 { return R_CD.col(1) * ((v - depth.cy) / depth.fy) + R_CD.col(2); };
  const auto project = [&](const base::Vec3& ray, double z) {
    const base::Vec3 p = z * ray + X_CD.p;
    return base::Vec3(other.fx * p.x() / p.z() + other.cx, other.fy * p.y() / p.z() + other.cy, p.z());
  };
  for (int v = 0; v < depth.height; ++v) {
    const base::Vec3 upper = of_row(v - 0.5), lower = of_row(v + 0.5);
    const std::uint16_t* row = millimetres.data() + static_cast<std::ptrdiff_t>(v) * depth.width;
    for (std::size_t u = 0; u < static_cast<std::size_t>(depth.width); ++u) {
      if (row[u] == 0) continue;
      const double z = 1e-3 * row[u];
      const base::Vec3 low = project(columns[u] + upper, z), high = project(columns[u + 1] + lower, z);
      if (!(low.z() > 0.0) || !(high.z() > 0.0) || !(low.z() + high.z() < 130.0)) continue;
      const auto here = static_cast<std::uint16_t>(500.0 * (low.z() + high.z()) + 0.5);
      // Pixels whose centres the patch covers.
      const int x0 = FirstCentre(low.x(), other.width), x1 = FirstCentre(high.x(), other.width);
      const int y0 = FirstCentre(low.y(), other.height), y1 = FirstCentre(high.y(), other.height);
      for (int y = y0; y < y1; ++y) {
        std::uint16_t* pixels = out.data() + static_cast<std::ptrdiff_t>(y) * other.width;
        for (int x = x0; x < x1; ++x) {
          if (pixels[x] == 0 || here < pixels[x]) pixels[x] = here;
        }
      }
    }
  }
  return out;
}

}  // namespace alula::render

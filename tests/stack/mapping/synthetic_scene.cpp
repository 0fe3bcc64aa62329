#include "tests/stack/mapping/synthetic_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace alula::stack::mapping::test {

namespace {

double Lattice(int a, int b, int seed) {
  std::uint32_t h = static_cast<std::uint32_t>(a) * 0x9E3779B1U ^ static_cast<std::uint32_t>(b) * 0x85EBCA77U ^
                    static_cast<std::uint32_t>(seed) * 0xC2B2AE3DU;
  h = (h ^ (h >> 15)) * 0x2C1B3C6DU;
  h = (h ^ (h >> 12)) * 0x297A2D39U;
  return static_cast<double>(h ^ (h >> 15)) / 4294967295.0;
}

double ValueNoise(double x, double y, int seed) {
  const int a = static_cast<int>(std::floor(x));
  const int b = static_cast<int>(std::floor(y));
  const double tx = x - a;
  const double ty = y - b;
  const double low = Lattice(a, b, seed) * (1 - tx) + Lattice(a + 1, b, seed) * tx;
  const double high = Lattice(a, b + 1, seed) * (1 - tx) + Lattice(a + 1, b + 1, seed) * tx;
  return low * (1 - ty) + high * ty;
}

double Texture(double x, double y, int seed) {  // grey levels
  return 30 + 80 * ValueNoise(x / 0.25, y / 0.25, seed) + 70 * ValueNoise(x / 0.07, y / 0.07, seed + 1) +
         50 * ValueNoise(x / 0.03, y / 0.03, seed + 2);
}

}  // namespace

void Scene::AddGate(const base::Transform& X_OG, double opening, double bar_width, double bar_depth) {
  const double reach = 0.5 * opening + 0.5 * bar_width;
  const double length = 0.5 * opening + bar_width;
  for (const double side : {-1.0, 1.0}) {
    const base::Transform upright{base::Quat::Identity(), {0, side * reach, 0}};
    const base::Transform level{base::Quat::Identity(), {0, 0, side * reach}};
    boxes.push_back({X_OG * upright, {0.5 * bar_depth, 0.5 * bar_width, length}});
    boxes.push_back({X_OG * level, {0.5 * bar_depth, 0.5 * opening, 0.5 * bar_width}});
  }
}

Scene::Hit Scene::Cast(const base::Vec3& origin_O, const base::Vec3& ray_O, bool shade) const {
  Hit best{std::numeric_limits<double>::infinity(), 180.0};
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    const SceneBox& box = boxes[b];
    const base::Quat q_SO = box.X_OS.q.conjugate();
    const base::Vec3 o = q_SO * (origin_O - box.X_OS.p);
    const base::Vec3 d = q_SO * ray_O;
    double enter = 0.0;
    double leave = best.t;
    int face = -1;
    for (int axis = 0; axis < 3; ++axis) {
      const double inverse = 1.0 / (std::abs(d[axis]) > 1e-12 ? d[axis] : 1e-12);
      const double a = (-box.half[axis] - o[axis]) * inverse;
      const double c = (box.half[axis] - o[axis]) * inverse;
      if (std::min(a, c) > enter) {
        enter = std::min(a, c);
        face = axis;
      }
      leave = std::min(leave, std::max(a, c));
    }
    if (face < 0 || enter >= leave) continue;
    best.t = enter;
    if (!shade) continue;
    const base::Vec3 at = o + enter * d;
    const int seed = static_cast<int>(b) * 17 + face * 5;
    best.grey = box.plain ? 120.0 : Texture(at[(face + 1) % 3], at[(face + 2) % 3], seed);
  }
  return best;
}

DepthMap Scene::Depth(const DepthMap& shape, const base::Transform& X_OC) const {
  DepthMap depth = shape;
  depth.z.assign(static_cast<std::size_t>(shape.width) * shape.height, 0.0F);
  for (int v = 0; v < shape.height; ++v) {
    for (int u = 0; u < shape.width; ++u) {
      depth.z[static_cast<std::size_t>(v) * shape.width + u] =
          static_cast<float>(Cast(X_OC.p, X_OC.q * shape.Ray(u, v), false).t);
    }
  }
  return depth;
}

Image Scene::Picture(const CameraIntrinsics& k, const base::Transform& X_OC, double noise,
                     base::RandomStream& random) const {
  auto bytes = std::make_shared<std::vector<std::uint8_t>>(static_cast<std::size_t>(k.width) * k.height);
  const base::Mat3 R_OC = X_OC.R();
  for (int v = 0; v < k.height; ++v) {
    for (int u = 0; u < k.width; ++u) {
      double sum = 0.0;
      for (int s = 0; s < 9; ++s) {
        const base::Vec3 ray((u - k.cx + (s % 3 - 1) / 3.0) / k.fx, (v - k.cy + (s / 3 - 1) / 3.0) / k.fy, 1.0);
        sum += Cast(X_OC.p, R_OC * ray, true).grey;
      }
      const double grey = sum / 9 + noise * random.Gaussian();
      (*bytes)[static_cast<std::size_t>(v) * k.width + u] =
          static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
    }
  }
  Image image;
  image.width = image.stride = k.width;
  image.height = k.height;
  image.bytes = std::move(bytes);
  return image;
}

Calibration StereoCalibration(double misalignment) {
  Calibration calibration;
  CameraCalibration eye;
  eye.intrinsics.width = 640;
  eye.intrinsics.height = 480;
  eye.intrinsics.fx = eye.intrinsics.fy = 320.0 / std::tan(0.5 * 80.0 * M_PI / 180.0);
  eye.intrinsics.cx = 319.5;
  eye.intrinsics.cy = 239.5;
  eye.X_BC = {base::ForwardCameraRotation(), {0.05, 0.055, 0.0}};
  calibration.cameras.push_back(eye);
  eye.X_BC.p.y() = -0.055;
  eye.X_BC.q = eye.X_BC.q * base::Exp(misalignment * base::Vec3(1, 2, -1).normalized());
  calibration.cameras.push_back(eye);
  calibration.stereo = {0, 1};
  return calibration;
}

DepthMap HalfSizeShape() {
  DepthMap shape;
  shape.width = 320;
  shape.height = 240;
  shape.fx = shape.fy = 160.0 / std::tan(0.5 * 80.0 * M_PI / 180.0);
  shape.cx = 159.5;
  shape.cy = 119.5;
  shape.X_BC = {base::ForwardCameraRotation(), {0.05, 0.055, 0.0}};
  shape.baseline = 0.11;
  return shape;
}

DepthMap Corrupt(const DepthMap& truth, double disparity_sigma, double disparity_bias, double unknown_share,
                 base::RandomStream& random) {
  constexpr int kBlock = 5;
  const int columns = truth.width / kBlock + 2;
  std::vector<double> noise(static_cast<std::size_t>(columns) * (truth.height / kBlock + 2));
  for (double& n : noise) n = random.Gaussian();
  const double bias = disparity_bias * random.Gaussian();
  const double fb = truth.fx * truth.baseline;
  DepthMap depth = truth;
  for (int v = 0; v < truth.height; ++v) {
    for (int u = 0; u < truth.width; ++u) {
      float& z = depth.z[static_cast<std::size_t>(v) * truth.width + u];
      double low = 1e9;
      double high = 0.0;
      for (int dv = -2; dv <= 2; ++dv) {
        for (int du = -2; du <= 2; ++du) {
          const int vv = std::clamp(v + dv, 0, truth.height - 1);
          const int uu = std::clamp(u + du, 0, truth.width - 1);
          low = std::min(low, fb / truth.At(uu, vv));
          high = std::max(high, fb / truth.At(uu, vv));
        }
      }
      const bool edge = high - low > 1.5;
      if (std::isinf(z) || edge || random.Uniform() < unknown_share) {
        z = 0.0F;  // a plain sky has no depth
        continue;
      }
      const double n = noise[static_cast<std::size_t>(v / kBlock) * columns + u / kBlock];
      const double disparity = fb / z + disparity_sigma * n + bias;
      z = disparity > 0.3 ? static_cast<float>(fb / disparity) : 0.0F;
    }
  }
  return depth;
}

}  // namespace alula::stack::mapping::test

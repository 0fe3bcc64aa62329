#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "base/frames.h"
#include "base/random.h"
#include "stack/interface/camera_model.h"
#include "tests/stack/estimation/flight.h"

namespace alula::stack::estimation::test {

/// Random blobs on a wall, drawn where a camera sees them, exactly: their centres are projected, and a blob is taken
/// for round and flat towards the camera. The wall is the plane z = 0 of its own frame.
class Wall {
 public:
  static constexpr double kDistance = 3.5;  // m: where blobs have the sizes below

  Wall() {
    base::RandomStream random(5, "test/wall");
    for (int i = 0; i < 3500; ++i) {
      const Vec3 centre(random.Uniform(-6.0, 6.0), random.Uniform(-2.6, 2.6), 0.0);
      blobs_.push_back({centre, random.Uniform(2, 6), random.Uniform(-70, 70)});
    }
  }

  /// Grey picture of a camera at X_WC, W being the wall's frame: the camera looks along z, from negative z.
  Image Seen(const CameraIntrinsics& camera, const Transform& X_WC) const {
    std::vector<float> grey(static_cast<std::size_t>(camera.width * camera.height), 90.0F);
    const Transform X_CW = X_WC.Inverse();
    for (const Blob& blob : blobs_) {
      const Vec3 p = X_CW * blob.centre;
      if (p.z() < 0.2) continue;
      const base::Vec2 at = Project(camera, p);
      const double r = blob.radius * kDistance / p.z();
      const int u0 = std::max(0, int(at.x() - 3 * r)), u1 = std::min(camera.width - 1, int(at.x() + 3 * r));
      const int v0 = std::max(0, int(at.y() - 3 * r)), v1 = std::min(camera.height - 1, int(at.y() + 3 * r));
      for (int v = v0; v <= v1; ++v) {
        for (int u = u0; u <= u1; ++u) {
          const double d2 = (base::Vec2(u, v) - at).squaredNorm() / (r * r);
          grey[static_cast<std::size_t>(v * camera.width + u)] += static_cast<float>(blob.height * std::exp(-d2));
        }
      }
    }
    auto bytes = std::make_shared<std::vector<std::uint8_t>>(grey.size());
    std::transform(grey.begin(), grey.end(), bytes->begin(),
                   [](float g) { return static_cast<std::uint8_t>(std::lround(std::clamp(g, 0.0F, 255.0F))); });
    return ImageOf(camera, bytes);
  }

  static Image ImageOf(const CameraIntrinsics& camera, std::shared_ptr<const std::vector<std::uint8_t>> bytes) {
    Image image;
    image.width = image.stride = camera.width;
    image.height = camera.height;
    image.bytes = std::move(bytes);
    return image;
  }
  static Image Black(const CameraIntrinsics& camera) {
    const auto size = static_cast<std::size_t>(camera.width * camera.height);
    return ImageOf(camera, std::make_shared<const std::vector<std::uint8_t>>(size, std::uint8_t{0}));
  }
  /// Depth as the camera measures it, to the millimetre; 0 beyond 60 m.
  static DepthImage Depth(const CameraIntrinsics& camera, const Transform& X_WC) {
    std::vector<std::uint16_t> mm;
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Vec3 ray = X_WC.q * Vec3(Normalise(camera, base::Vec2(u, v)).homogeneous());
        const double z = -X_WC.p.z() / ray.z();
        mm.push_back(z > 0 && z < 60 ? static_cast<std::uint16_t>(std::lround(1e3 * z)) : std::uint16_t{0});
      }
    }
    DepthImage depth;
    depth.width = camera.width;
    depth.height = camera.height;
    depth.millimetres = std::make_shared<const std::vector<std::uint16_t>>(std::move(mm));
    return depth;
  }

 private:
  struct Blob {
    Vec3 centre;
    double radius, height;  // px from kDistance; grey levels
  };
  std::vector<Blob> blobs_;
};

}  // namespace alula::stack::estimation::test

// Bent lenses: corners where the model puts them, no seams between sources, the kernels alike.
#include "render/lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "render/internal/remap_kernel.h"
#include "stack/interface/camera_model.h"
#include "tests/render/test_scene.h"

namespace alula::render {
namespace {

using base::Vec2;
using base::Vec3;

stack::CameraIntrinsics RadialTangential() {
  return {752, 480, 458.654, 457.296, 367.215, 248.375, {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0}};
}

stack::CameraIntrinsics Fisheye(double degrees) {
  const double focal = 240.0 / (degrees * M_PI / 360.0);
  return {480, 360, focal, focal, 239.5, 179.5, {0.01, -0.004, 0.0, 0.0, 0.0}, stack::DistortionModel::kEquidistant};
}

/// An image as a lens sees it from X_WC.
Picture Bent(const Lens& lens, const stack::CameraIntrinsics& k, CameraRenderer& renderer,
             const base::Transform& X_WC) {
  std::vector<std::uint8_t> canvas(lens.canvas_pixels());
  Picture drawn;
  for (const Lens::Source& source : lens.sources()) {
    renderer.Grey({.X_WC = X_WC * base::Transform{source.q_CS, Vec3::Zero()}, .intrinsics = source.intrinsics}, drawn);
    std::copy(drawn.bytes.begin(), drawn.bytes.end(), canvas.begin() + static_cast<std::ptrdiff_t>(source.first_pixel));
  }
  Picture image{k.width, k.height, 1, {}};
  image.bytes.resize(static_cast<std::size_t>(k.width * k.height));
  lens.Sample(canvas.data(), 1, {0, k.height}, image.bytes.data());
  return image;
}

/// A wall of fields of 0.2 m, across the x axis.
worlds::World ChequeredWall() {
  worlds::World world;
  world.light = test::Shadowless();
  world.materials = {test::Checker(256, 40, 210)};
  test::AddBox(world, {base::Quat::Identity(), {0.5, 0, 0}}, {0.01, 2, 2}, 0, 1.6);
  return world;
}

TEST(Lens, PutsCornersWhereTheModelSays) {
  const worlds::World world = ChequeredWall();
  const auto renderer = MakeRenderer("raster", world, {});
  for (const stack::CameraIntrinsics& k : {RadialTangential(), Fisheye(130)}) {
    const Lens lens(k);
    const base::Transform X_WC{base::FromYawPitchRoll(0.1, -0.05, 0.2) * base::ForwardCameraRotation(), {-0.2, 0, 0}};
    const Picture image = Bent(lens, k, *renderer, X_WC);
    const cv::Mat mat(k.height, k.width, CV_8UC1, const_cast<std::uint8_t*>(image.bytes.data()));
    double squares = 0;
    int count = 0;
    for (int row = -8; row <= 8; ++row) {
      for (int column = -8; column <= 8; ++column) {
        const Vec3 p_C = X_WC.Inverse() * Vec3(0.49, 0.2 * column, 0.2 * row);
        if (p_C.z() < 0.55 * p_C.norm()) continue;  // too slanted a look for a corner's finder
        const Vec2 expected = stack::Project(k, p_C);
        if (!stack::Inside(k, expected, 15)) continue;
        std::vector<cv::Point2f> corner{{static_cast<float>(expected.x()), static_cast<float>(expected.y())}};
        cv::cornerSubPix(mat, corner, {7, 7}, {-1, -1}, {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-4});
        squares += (Vec2(corner[0].x, corner[0].y) - expected).squaredNorm();
        ++count;
      }
    }
    const double rms = std::sqrt(squares / count);
    std::printf("%zu source(s), %d corners: rms %.3f px\n", lens.sources().size(), count, rms);
    EXPECT_GT(count, 25);
    EXPECT_LT(rms, 0.1);
  }
}

/// What a wide lens samples from faces of a cube is what a pinhole camera sees that looks along the pixel's own ray.
TEST(Lens, HasNoSeams) {
  const worlds::World world = test::Clutter(3);
  const auto renderer = MakeRenderer("raster", world, {});
  const stack::CameraIntrinsics k = Fisheye(190);
  const Lens lens(k);
  EXPECT_EQ(lens.sources().size(), 5U);
  const base::Transform X_WC{base::FromYawPitchRoll(0.4, 0.1, 0) * base::ForwardCameraRotation(), {0, 1, 1.7}};
  const Picture image = Bent(lens, k, *renderer, X_WC);
  base::RandomStream random(4, "pixels");
  std::vector<int> differences;
  Picture small;
  for (int i = 0; i < 400; ++i) {
    const int u = static_cast<int>(random.Index(480)), v = static_cast<int>(random.Index(360));
    const base::Quat q = base::Quat::FromTwoVectors(Vec3::UnitZ(), stack::Ray(k, {u, v}));
    const double focal = lens.sources().front().intrinsics.fx;
    renderer->Grey({.X_WC = X_WC * base::Transform{q, Vec3::Zero()}, .intrinsics = {9, 9, focal, focal, 4, 4, {}}},
                   small);
    differences.push_back(std::abs(small.bytes[40] - image.bytes[static_cast<std::size_t>(v * 480 + u)]));
  }
  std::sort(differences.begin(), differences.end());
  EXPECT_LE(differences[200], 1);
  EXPECT_LE(differences[340], 8);  // one pixel in seven or so lies on an edge of this scene
}

TEST(Lens, NeedsOnlyTheRowsItSays) {
  const worlds::World world = test::Clutter(3);
  const auto renderer = MakeRenderer("raster", world, {});
  const stack::CameraIntrinsics k = RadialTangential();
  const Lens lens(k);
  const View eye = test::LookAt({-4, -6, 2}, {3, 1, 1});
  const Picture whole = Bent(lens, k, *renderer, eye.X_WC);
  const Lens::Rows rows = lens.RowsOf(0, {100, 30});
  EXPECT_LT(rows.count, lens.sources()[0].intrinsics.height / 4);  // this lens bends rows over a good hundred
  std::vector<std::uint8_t> canvas(lens.canvas_pixels(), 0);
  View band{.X_WC = eye.X_WC, .intrinsics = lens.sources()[0].intrinsics};
  band.intrinsics.height = rows.count;
  band.intrinsics.cy -= rows.first;
  Picture drawn;
  renderer->Grey(band, drawn);
  std::copy(drawn.bytes.begin(), drawn.bytes.end(),
            canvas.begin() + static_cast<std::ptrdiff_t>(rows.first) * band.intrinsics.width);
  std::vector<std::uint8_t> out(30 * 752);
  lens.Sample(canvas.data(), 1, {100, 30}, out.data());
  int different = 0;  // the band's own rounding of depth may move an edge
  for (std::size_t i = 0; i < out.size(); ++i) different += std::abs(out[i] - whole.bytes[100 * 752 + i]) > 1;
  EXPECT_LT(different, 20);
}

TEST(Lens, KernelsGiveOneAnswer) {
  base::RandomStream random(1, "remap");
  std::vector<std::uint8_t> canvas(200 * 100);
  for (std::uint8_t& byte : canvas) byte = static_cast<std::uint8_t>(random.Index(256));
  constexpr std::size_t kCount = 1003;
  std::vector<std::uint32_t> pixel;
  std::vector<std::uint8_t> right, down, a(kCount), b(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    pixel.push_back(static_cast<std::uint32_t>(random.Index(200 * 98)));
    right.push_back(static_cast<std::uint8_t>(random.Index(256)));
    down.push_back(static_cast<std::uint8_t>(random.Index(256)));
  }
  internal::RemapBaseline(canvas.data(), 200, pixel.data(), right.data(), down.data(), kCount, a.data());
  internal::ChooseRemap()(canvas.data(), 200, pixel.data(), right.data(), down.data(), kCount, b.data());
  EXPECT_EQ(a, b);
  EXPECT_EQ(a[5],
            static_cast<int>(std::floor(  // the formula once more, in real numbers
                0.5 + ((canvas[pixel[5]] * (256.0 - right[5]) + canvas[pixel[5] + 1] * right[5]) * (256.0 - down[5]) +
                       (canvas[pixel[5] + 200] * (256.0 - right[5]) + canvas[pixel[5] + 201] * right[5]) * down[5]) /
                          65536)));
}

TEST(Lens, DepthIsThatOfTheCamerasOwnAxis) {
  const worlds::World world = ChequeredWall();
  const auto renderer = MakeRenderer("raster", world, {});
  const stack::CameraIntrinsics k = Fisheye(150);
  const Lens lens(k);
  const base::Transform X_WC{base::FromYawPitchRoll(0.2, 0.1, 0) * base::ForwardCameraRotation(), {-0.3, 0, 0}};
  std::vector<float> canvas(lens.canvas_pixels());
  DepthPicture drawn, depth;
  for (const Lens::Source& source : lens.sources()) {
    renderer->Depth({.X_WC = X_WC * base::Transform{source.q_CS, Vec3::Zero()}, .intrinsics = source.intrinsics},
                    drawn);
    std::copy(drawn.metres.begin(), drawn.metres.end(),
              canvas.begin() + static_cast<std::ptrdiff_t>(source.first_pixel));
  }
  lens.SampleDepth(canvas.data(), depth);
  /// Depth of the wall along the camera's axis through an image point; 0 where it ends.
  const auto wall = [&](double u, double v) {
    const Vec3 ray = stack::Ray(k, {u, v});
    const Vec3 ray_W = X_WC.q * ray;
    const double range = (0.49 - X_WC.p.x()) / ray_W.x();
    const Vec3 hit = X_WC.p + range * ray_W;
    return range < 0 || std::abs(hit.y()) > 1.95 || std::abs(hit.z()) > 1.95 ? 0.0 : range * ray.z();
  };
  int seen = 0;
  for (int v = 4; v < 360; v += 7) {
    for (int u = 4; u < 480; u += 7) {
      // The nearest pixel of the source lies up to half a pixel away, and its pixels are no larger than the image's.
      const std::array<double, 4> about = {wall(u - 0.6, v - 0.6), wall(u + 0.6, v - 0.6), wall(u - 0.6, v + 0.6),
                                           wall(u + 0.6, v + 0.6)};
      if (*std::min_element(about.begin(), about.end()) == 0.0) continue;
      const auto depth_here = static_cast<double>(depth.metres[static_cast<std::size_t>(v * 480 + u)]);
      EXPECT_GE(depth_here, *std::min_element(about.begin(), about.end()) - 1e-4);
      EXPECT_LE(depth_here, *std::max_element(about.begin(), about.end()) + 1e-4);
      ++seen;
    }
  }
  EXPECT_GT(seen, 1000);
}

TEST(Lens, RefusesAnImageBeyondTheFold) {
  stack::CameraIntrinsics k = RadialTangential();
  k.distortion = {-0.6, 0, 0, 0, 0};
  EXPECT_THROW(Lens lens(k), base::InputError);
}

}  // namespace
}  // namespace alula::render

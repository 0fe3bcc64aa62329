#include "render/lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "render/internal/remap_kernel.h"
#include "stack/interface/camera_model.h"

namespace alula::render {
namespace {

using base::Vec3;

constexpr double kOneSource = M_PI / 3;  // rad off the axis; beyond it a pinhole picture grows out of hand
constexpr int kMargin = 4;               // px about what is sampled: the kernel reads whole words

/// Axes of the cube's faces in the camera: front, right, left, bottom, top, back.
std::array<base::Quat, 6> Faces() {
  const auto turn = [](double angle, const Vec3& axis) { return base::Quat(Eigen::AngleAxisd(angle, axis)); };
  return {base::Quat::Identity(),         turn(M_PI / 2, Vec3::UnitY()), turn(-M_PI / 2, Vec3::UnitY()),
          turn(-M_PI / 2, Vec3::UnitX()), turn(M_PI / 2, Vec3::UnitX()), turn(M_PI, Vec3::UnitY())};
}

/// The face through which a ray passes.
int FaceOf(const Vec3& ray) {
  const Vec3 size = ray.cwiseAbs();
  if (size.z() >= size.x() && size.z() >= size.y()) return ray.z() > 0 ? 0 : 5;
  if (size.x() >= size.y()) return ray.x() > 0 ? 1 : 2;
  return ray.y() > 0 ? 3 : 4;
}

/// Pixels a rad at which the lens draws at most, somewhere in the image.
double FinestFocal(const stack::CameraIntrinsics& camera, std::span<const Vec3> rays) {
  double finest = 0.0;
  const auto at = [&](int u, int v) { return rays[static_cast<std::size_t>(v * camera.width + u)]; };
  for (int v = 0; v + 1 < camera.height; v += 8) {
    for (int u = 0; u + 1 < camera.width; u += 8) {
      const double across = at(u, v).cross(at(u + 1, v)).norm();
      const double down = at(u, v).cross(at(u, v + 1)).norm();
      finest = std::max({finest, 1.0 / across, 1.0 / down});
    }
  }
  return finest;
}

}  // namespace

Lens::Lens(const stack::CameraIntrinsics& camera) : camera_(camera), pinhole_(stack::IsPinhole(camera)) {
  if (pinhole_) {
    sources_.push_back({base::Quat::Identity(), camera, 0});
    canvas_pixels_ = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
    return;
  }
  const double largest = stack::LargestAngle(camera);
  std::vector<Vec3> rays;
  rays.reserve(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Vec3 ray = stack::Ray(camera, {u, v});
      if (!ray.allFinite() || std::acos(std::clamp(ray.z(), -1.0, 1.0)) > largest) {
        throw base::InputError("camera: pixel (" + std::to_string(u) + ", " + std::to_string(v) +
                               ") lies beyond the angle at which the lens coefficients fold the picture back");
      }
      rays.push_back(ray);
    }
  }
  PlanSources(rays);
  FillTable(rays);
}

void Lens::PlanSources(std::span<const Vec3> rays) {
  const double cosine = std::cos(kOneSource);
  const bool one = std::all_of(rays.begin(), rays.end(), [&](const Vec3& ray) { return ray.z() > cosine; });
  const double focal = FinestFocal(camera_, rays);
  struct Bounds {
    double left = std::numeric_limits<double>::infinity(), right = -left, top = left, bottom = -left;
  };
  const std::array<base::Quat, 6> faces = Faces();
  std::array<Bounds, 6> bounds;
  source_.clear();
  for (const Vec3& ray : rays) {
    const int face = one ? 0 : FaceOf(ray);
    const Vec3 in_face = faces[static_cast<std::size_t>(face)].conjugate() * ray;
    const double x = focal * in_face.x() / in_face.z(), y = focal * in_face.y() / in_face.z();
    Bounds& b = bounds[static_cast<std::size_t>(face)];
    b = {std::min(b.left, x), std::max(b.right, x), std::min(b.top, y), std::max(b.bottom, y)};
    source_.push_back(static_cast<std::uint8_t>(face));
  }
  int width = 0;
  for (const Bounds& b : bounds) {
    if (b.left <= b.right) width = std::max(width, static_cast<int>(std::ceil(b.right - b.left)) + 2 * kMargin);
  }
  std::array<std::uint8_t, 6> number{};
  for (std::size_t face = 0; face < faces.size(); ++face) {
    const Bounds& b = bounds[face];
    if (!(b.left <= b.right)) continue;
    number[face] = static_cast<std::uint8_t>(sources_.size());
    const int height = static_cast<int>(std::ceil(b.bottom - b.top)) + 2 * kMargin;
    sources_.push_back({faces[face],
                        {.width = width,
                         .height = height,
                         .fx = focal,
                         .fy = focal,
                         .cx = kMargin - 1 - b.left,
                         .cy = kMargin - 1 - b.top,
                         .distortion = {}},
                        canvas_pixels_});
    canvas_pixels_ += static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  for (std::uint8_t& source : source_) source = number[source];
}

void Lens::FillTable(std::span<const Vec3> rays) {
  rows_.assign(sources_.size() * static_cast<std::size_t>(camera_.height), {});
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Source& source = sources_[source_[i]];
    const stack::CameraIntrinsics& k = source.intrinsics;
    const Vec3 p = source.q_CS.conjugate() * rays[i];
    const auto steps = [](double pixels) { return static_cast<std::int64_t>(std::floor(256.0 * pixels + 0.5)); };
    const std::int64_t x = steps(k.fx * p.x() / p.z() + k.cx), y = steps(k.fy * p.y() / p.z() + k.cy);
    pixel_.push_back(static_cast<std::uint32_t>(source.first_pixel +
                                                static_cast<std::size_t>(y / 256) * static_cast<std::size_t>(k.width) +
                                                static_cast<std::size_t>(x / 256)));
    right_.push_back(static_cast<std::uint8_t>(x % 256));
    down_.push_back(static_cast<std::uint8_t>(y % 256));
    Rows& rows =
        rows_[source_[i] * static_cast<std::size_t>(camera_.height) + i / static_cast<std::size_t>(camera_.width)];
    const int row = static_cast<int>(y / 256);
    const int first = rows.count == 0 ? row : std::min(rows.first, row);
    const int last = rows.count == 0 ? row + 1 : std::max(rows.first + rows.count - 1, row + 1);
    rows = {first, last - first + 1};
  }
}

Lens::Rows Lens::RowsOf(std::size_t source, const Rows& image) const {
  if (pinhole_) return image;
  int first = std::numeric_limits<int>::max(), last = -1;
  for (int v = image.first; v < image.first + image.count; ++v) {
    const Rows& rows = rows_[source * static_cast<std::size_t>(camera_.height) + static_cast<std::size_t>(v)];
    if (rows.count == 0) continue;
    first = std::min(first, rows.first);
    last = std::max(last, rows.first + rows.count - 1);
  }
  if (last < 0) return {};
  return {first, last - first + 1};
}

void Lens::Sample(const std::uint8_t* canvas, int channels, const Rows& image, std::uint8_t* out) const {
  const std::size_t begin = static_cast<std::size_t>(image.first) * static_cast<std::size_t>(camera_.width);
  const std::size_t count = static_cast<std::size_t>(image.count) * static_cast<std::size_t>(camera_.width);
  if (pinhole_) {
    const auto step = static_cast<std::size_t>(channels);
    std::copy_n(canvas + begin * step, count * step, out);
    return;
  }
  const std::ptrdiff_t stride = sources_.front().intrinsics.width;
  if (channels == 1) {
    static const internal::RemapKernel kernel = internal::ChooseRemap();
    kernel(canvas, stride, pixel_.data() + begin, right_.data() + begin, down_.data() + begin, count, out);
    return;
  }
  for (std::size_t i = begin; i < begin + count; ++i) {
    const std::uint8_t* p = canvas + static_cast<std::size_t>(channels) * pixel_[i];
    const std::uint32_t x = right_[i], y = down_[i];
    for (int c = 0; c < channels; ++c, ++p) {
      const std::uint8_t* q = p + stride * channels;
      const std::uint32_t upper = p[0] * (256 - x) + p[channels] * x;
      const std::uint32_t lower = q[0] * (256 - x) + q[channels] * x;
      *out++ = static_cast<std::uint8_t>((upper * (256 - y) + lower * y + 32768) >> 16);
    }
  }
}

void Lens::SampleDepth(const float* canvas, DepthPicture& out) const {
  out.width = camera_.width;
  out.height = camera_.height;
  if (pinhole_) {
    out.metres.assign(canvas, canvas + canvas_pixels_);
    return;
  }
  out.metres.resize(pixel_.size());
  for (std::size_t i = 0; i < pixel_.size(); ++i) {
    const Source& source = sources_[source_[i]];
    const auto stride = static_cast<std::size_t>(source.intrinsics.width);
    const std::size_t nearest = pixel_[i] + (right_[i] >= 128 ? 1 : 0) + (down_[i] >= 128 ? stride : 0);
    const std::size_t place = nearest - source.first_pixel;
    const stack::CameraIntrinsics& k = source.intrinsics;
    const Vec3 ray((static_cast<double>(place % stride) - k.cx) / k.fx,
                   (static_cast<double>(place / stride) - k.cy) / k.fy, 1.0);
    const double along = (source.q_CS * ray).z();  // planar depth here a metre of planar depth there
    out.metres[i] = along > 0.0 ? canvas[nearest] * static_cast<float>(along) : 0.0F;
  }
}

}  // namespace alula::render

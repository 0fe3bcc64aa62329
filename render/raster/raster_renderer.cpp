#include "render/raster/raster_renderer.h"

#include <algorithm>

#include "base/error.h"
#include "render/internal/projection.h"
#include "render/internal/sky.h"
#include "render/internal/surface_classes.h"
#include "render/internal/visible_order.h"
#include "render/raster/holes.h"
#include "render/raster/occlusion.h"

namespace alula::render::raster {
namespace {

/// Rows of (column, row, depth) = m · (p_W, 1): column/depth and row/depth are pixels, depth m.
std::array<float, 12> PixelFromWorld(const View& view) {
  const stack::CameraIntrinsics& k = view.intrinsics;
  const base::Transform X_CW = view.X_WC.Inverse();
  Eigen::Matrix<double, 3, 4> camera_from_world;
  camera_from_world << X_CW.R(), X_CW.p;
  base::Mat3 pixel_from_camera;
  pixel_from_camera << k.fx, 0.0, k.cx, 0.0, k.fy, k.cy, 0.0, 0.0, 1.0;
  const Eigen::Matrix<double, 3, 4> product = pixel_from_camera * camera_from_world;
  std::array<float, 12> m{};
  for (int i = 0; i < 12; ++i) m[static_cast<std::size_t>(i)] = static_cast<float>(product(i / 4, i % 4));
  return m;
}

void SetSky(const View& view, const internal::SkyColours& sky, ShadeJob& job) {
  const stack::CameraIntrinsics& k = view.intrinsics;
  const double ray[4] = {-k.cx / k.fx, -k.cy / k.fy, 1.0 / k.fx, 1.0 / k.fy};
  const base::Vec3 up_C = view.X_WC.R().row(2).transpose();
  std::copy_n(ray, 4, job.sky_ray);
  job.sky_up[0] = static_cast<float>(up_C.x() * ray[0] + up_C.y() * ray[1] + up_C.z());
  job.sky_up[1] = static_cast<float>(up_C.x() * ray[2]);
  job.sky_up[2] = static_cast<float>(up_C.y() * ray[3]);
  for (int c = 0; c < job.channels; ++c) {
    job.sky_colours[c] = 255.0F * sky.zenith[c];
    job.sky_colours[3 + c] = 255.0F * sky.horizon[c];
    job.sky_colours[6 + c] = 255.0F * sky.ground[c];
  }
}

}  // namespace

RasterRenderer::RasterRenderer(const Kernels& kernels, const worlds::World& world, std::span<const Mover> movers)
    : RasterRenderer(kernels, internal::BuildScene(world, movers), world, movers) {}

RasterRenderer::RasterRenderer(const Kernels& kernels, internal::SceneGeometry geometry, const worlds::World& world,
                               std::span<const Mover> movers)
    : kernels_(&kernels),
      light_(world.light),
      shadow_frame_(internal::FrameShadow(world, geometry.low, geometry.high)),
      scene_(std::move(geometry), LightingOf(world.light, shadow_frame_)),
      alpha_(PackAlpha(scene_.materials())),
      shadow_map_(scene_, shadow_frame_, alpha_, kernels),
      X_WM_(movers.size()),
      classes_(internal::ClassesOf(world, movers)),
      drawn_numbers_(scene_.triangles()) {
  internal::CheckLight(light_);
}

void RasterRenderer::PlaceMovers(std::span<const base::Transform> X_WM) {
  const std::size_t movers = scene_.parts().size() - scene_.statics();
  if (X_WM.size() != movers) {
    throw base::FaultError("render", std::to_string(X_WM.size()) + " poses for " + std::to_string(movers) + " movers");
  }
  for (std::size_t i = 0; i < X_WM.size(); ++i) {
    if (internal::IsSame(X_WM[i], X_WM_[i])) continue;
    X_WM_[i] = X_WM[i];
    scene_.PlaceMover(i, X_WM[i]);
    shadow_map_.MoversMoved();
  }
}

const PackedTextures& RasterRenderer::Textures(int channels, bool infrared) {
  using internal::TextureKind;
  const TextureKind kind = channels == 3 ? TextureKind::kColour
                           : infrared    ? TextureKind::kInfrared
                                         : TextureKind::kLuma;
  std::optional<PackedTextures>& textures = channels == 3 ? colour_ : infrared ? infrared_ : grey_;
  if (!textures) textures = PackTextures(scene_.materials(), kind);
  return *textures;
}

Target RasterRenderer::DrawView(const View& view, bool with_ids) {
  const Target target =
      buffer_.Clear(view.intrinsics.width, view.intrinsics.height, static_cast<float>(1.0 / internal::kFar), with_ids);
  drawn_ = {drawn_numbers_.data(), 0};
  const std::array<float, 12> m = PixelFromWorld(view);
  const internal::Frustum frustum = internal::FrustumOf(internal::ClipFromWorld(view));
  const std::span<const internal::Batch> boxes(scene_.boxes());
  const std::size_t drawn = view.draw_movers ? boxes.size() : scene_.statics();
  for (const std::uint32_t number : internal::VisibleOrder(boxes.first(drawn), &frustum, view.X_WC.p)) {
    if (IsHidden(boxes[number], m, target)) continue;
    const RasterScene::Part& part = scene_.parts()[number];
    kernels_->transform(scene_.vertices(), part.first_vertex, part.vertices, m.data(),
                        static_cast<float>(internal::kNear));
    if (part.holes) {
      for (std::uint32_t i = 0; i < part.triangles; ++i) DrawSingly(target, part.first_triangle + i, true);
      continue;
    }
    to_clip_.resize(std::max<std::size_t>(to_clip_.size(), part.triangles));
    const DrawJob job{{scene_.corners(0), scene_.corners(1), scene_.corners(2)},
                      part.first_triangle,
                      part.triangles,
                      scene_.vertices(),
                      target,
                      &drawn_,
                      to_clip_.data()};
    const std::uint32_t count = kernels_->draw(job);
    for (std::uint32_t i = 0; i < count; ++i) DrawSingly(target, to_clip_[i], false);
  }
  return target;
}

void RasterRenderer::DrawSingly(const Target& target, std::uint32_t number, bool has_holes) {
  const Vertices& v = scene_.vertices();
  std::array<Corner, 3> corners;
  std::array<base::Vec3, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t c = scene_.corners(static_cast<int>(i))[number];
    p[i] = {v.column[c], v.row[c], v.depth[c]};
    corners[i] = {p[i].x(), p[i].y(), p[i].z(), v.flags[c] == 0, v.pixel_x[c], v.pixel_y[c]};
  }
  const base::Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
  const double volume = normal.dot(p[0]);
  if (!(volume < 0.0)) return;  // seen from behind
  if (corners[0].snapped && corners[1].snapped && corners[2].snapped) {
    polygon_.assign(corners.begin(), corners.end());
  } else {
    ClipTriangle(corners, internal::kNear, polygon_);
  }
  if (polygon_.size() < 3) return;
  const auto by_depth = [](const Corner& a, const Corner& b) { return a.depth < b.depth; };
  const auto [nearest, farthest] = std::minmax_element(polygon_.begin(), polygon_.end(), by_depth);
  ScreenTriangle triangle{};
  triangle.plane[0] = normal.z() / volume;
  triangle.plane[1] = normal.x() / volume;
  triangle.plane[2] = normal.y() / volume;
  triangle.low = static_cast<float>(1.0 / farthest->depth);
  triangle.high = static_cast<float>(1.0 / nearest->depth);
  drawn_.numbers[drawn_.count++] = number;
  triangle.id = drawn_.count;
  const base::Vec2 about(std::clamp(polygon_[0].x >> kSubPixelBits, 0, target.width),
                         std::clamp(polygon_[0].y >> kSubPixelBits, 0, target.height));
  const HolePlanes holes = has_holes ? HolesOf(scene_, alpha_, number, p, about) : HolePlanes{};
  for (std::size_t i = 2; i < polygon_.size(); ++i) {
    const Corner* fan[3] = {&polygon_[0], &polygon_[i], &polygon_[i - 1]};  // front faces turn the other way
    for (int k = 0; k < 3; ++k) {
      triangle.x[k] = fan[k]->x;
      triangle.y[k] = fan[k]->y;
    }
    has_holes ? kernels_->draw_with_holes(target, triangle, holes) : kernels_->draw_one(target, triangle);
  }
}

void RasterRenderer::Paint(const View& view, int channels, Picture& out) {
  internal::CheckView(view);
  const PackedTextures& textures = Textures(channels, view.infrared);
  out.width = view.intrinsics.width;
  out.height = view.intrinsics.height;
  out.channels = channels;
  out.bytes.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height) *
                   static_cast<std::size_t>(channels));
  ShadeJob job{};
  job.target = DrawView(view, true);
  job.vertices = scene_.vertices();
  for (int i = 0; i < 3; ++i) job.corners[i] = scene_.corners(i);
  job.texture_of_triangle = scene_.texture_of_triangle().data();
  if (planes_.size() < drawn_.count) planes_.resize(drawn_.count);
  job.drawn = drawn_.numbers;
  job.planes = planes_.data();
  job.frame = ++frame_;
  job.textures = textures.views.data();
  for (std::size_t c = 0; c < 3; ++c) job.words[c] = textures.words[c].data();
  job.shadow_map = shadow_map_.Words(scene_, shadow_frame_, alpha_, *kernels_);
  job.shadow_side = internal::kShadowSide;
  job.channels = channels;
  job.brightness = view.brightness;
  job.out = out.bytes.data();
  SetSky(view, internal::SkyOf(light_, channels, view.brightness), job);
  const internal::AirAndLamps air = internal::AirAndLampsOf(light_, view, channels);
  air.IsNeeded() ? ShadeLit(view, air, job) : kernels_->shade(job);
}

void RasterRenderer::ShadeLit(const View& view, const internal::AirAndLamps& air, const ShadeJob& shade) {
  const stack::CameraIntrinsics& k = view.intrinsics;
  LitJob job{};
  job.shade = shade;
  job.normals = NormalsFor(shade.target);
  const base::Vec3 first = internal::RayDirection(view, 0.0, 0.0);
  const base::Mat3 R_WC = view.X_WC.R();
  for (int i = 0; i < 3; ++i) {
    job.eye[i] = static_cast<float>(view.X_WC.p[i]);
    job.rays[i] = static_cast<float>(first[i]);
    job.rays[3 + i] = static_cast<float>(R_WC(i, 0) / k.fx);
    job.rays[6 + i] = static_cast<float>(R_WC(i, 1) / k.fy);
    job.fog[i] = 255.0F * air.fog[i];
  }
  lamps_.clear();
  for (const internal::LampView& lamp : air.lamps) {
    Lamp& out = lamps_.emplace_back();
    std::copy_n(lamp.position.data(), 3, out.position);
    std::copy_n(lamp.direction.data(), 3, out.direction);
    std::copy_n(lamp.light.data(), 3, out.light);
    out.inverse_range_squared = lamp.inverse_range_squared;
    out.cone_cosine = lamp.cone_cosine;
    out.cone_scale = lamp.cone_scale;
  }
  job.lamps = lamps_.data();
  job.lamp_count = static_cast<std::int32_t>(lamps_.size());
  job.extinction = air.extinction;
  job.sky_depth = air.sky_depth;
  kernels_->shade_lit(job);
}

void RasterRenderer::Depth(const View& view, DepthPicture& out) {
  internal::CheckView(view);
  out.width = view.intrinsics.width;
  out.height = view.intrinsics.height;
  out.metres.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  kernels_->metres(DrawView(view, false), static_cast<float>(internal::kFar), out.metres.data());
}

NormalJob RasterRenderer::NormalsFor(const Target& target) {
  if (normal_planes_.size() < drawn_.count) normal_planes_.resize(drawn_.count);
  return {target,
          scene_.vertices(),
          scene_.normals(),
          {scene_.corners(0), scene_.corners(1), scene_.corners(2)},
          drawn_.numbers,
          normal_planes_.data(),
          frame_};
}

void RasterRenderer::Surface(const View& view, SurfacePicture& out) {
  internal::CheckView(view);
  internal::Resize(view, out);
  out.first_mover = static_cast<std::uint32_t>(scene_.statics()) + 1;
  const Target target = DrawView(view, true);
  ++frame_;
  NormalPictureJob job{NormalsFor(target), {}, out.normals.front().data()};
  const Eigen::Matrix<float, 3, 3, Eigen::RowMajor> R_CW = view.X_WC.Inverse().R().cast<float>();
  std::copy_n(R_CW.data(), 9, job.rotation);
  kernels_->normals(job);
  std::size_t pixel = 0;
  for (int y = 0; y < out.height; ++y) {
    const std::uint32_t* tiles = target.ids + (y / kTile * target.tiles_x * kTile + y % kTile) * kTile;
    for (int x = 0; x < out.width; ++x, ++pixel) {
      const std::uint32_t id = tiles[x / kTile * kTile * kTile + x % kTile];
      out.instances[pixel] = id == 0 ? 0 : scene_.part_of(drawn_.numbers[id - 1]) + 1;
      out.classes[pixel] = classes_[out.instances[pixel]];
    }
  }
}

}  // namespace alula::render::raster

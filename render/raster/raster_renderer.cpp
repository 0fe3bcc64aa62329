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

/// Rows of (column, row, depth) = m · (p_A, 1), of a point in frame A: column/depth and row/depth are pixels, depth m.
std::array<float, 12> PixelFrom(const View& view, const base::Transform& X_WA) {
  const stack::CameraIntrinsics& k = view.intrinsics;
  const base::Transform X_CA = view.X_WC.Inverse() * X_WA;
  Eigen::Matrix<double, 3, 4> camera_from_a;
  camera_from_a << X_CA.R(), X_CA.p;
  base::Mat3 pixel_from_camera;
  pixel_from_camera << k.fx, 0.0, k.cx, 0.0, k.fy, k.cy, 0.0, 0.0, 1.0;
  const Eigen::Matrix<double, 3, 4> product = pixel_from_camera * camera_from_a;
  std::array<float, 12> m{};
  for (int i = 0; i < 12; ++i) m[static_cast<std::size_t>(i)] = static_cast<float>(product(i / 4, i % 4));
  return m;
}

/// The box in the world of a mover's box in its own frame.
void PlaceBox(const internal::Batch& mover, const base::Transform& X_WM, internal::Batch& box) {
  const base::Vec3 low = mover.low.cast<double>();
  const base::Vec3 high = mover.high.cast<double>();
  const base::Vec3 middle = X_WM * (0.5 * (low + high)).eval();
  const base::Vec3 reach = X_WM.R().cwiseAbs() * (0.5 * (high - low)) + base::Vec3::Constant(1e-4);  // m, for rounding
  box.low = (middle - reach).cast<float>();
  box.high = (middle + reach).cast<float>();
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
    : RasterRenderer(kernels, std::make_shared<const RasterScene>(internal::BuildScene(world, movers), kernels)) {}

RasterRenderer::RasterRenderer(const Kernels& kernels, std::shared_ptr<const RasterScene> scene)
    : kernels_(&kernels),
      scene_(std::move(scene)),
      boxes_(scene_->geometry().statics),
      movers_(scene_->geometry().movers.size()),
      X_WM_(movers_.size()),
      mover_attributes_(scene_->mover_vertices() * kAttributes),
      mover_normals_(scene_->mover_vertices() * 3),
      vertices_(scene_->vertices()),
      drawn_numbers_(scene_->triangles()) {
  const internal::SceneGeometry& geometry = scene_->geometry();
  boxes_.insert(boxes_.end(), geometry.movers.begin(), geometry.movers.end());
}

std::unique_ptr<CameraRenderer> RasterRenderer::Twin() const {
  return std::make_unique<RasterRenderer>(*kernels_, scene_);
}

void RasterRenderer::PlaceMovers(std::span<const base::Transform> X_WM) {
  if (X_WM.size() != movers_.size()) {
    throw base::FaultError("render",
                           std::to_string(X_WM.size()) + " poses for " + std::to_string(movers_.size()) + " movers");
  }
  const internal::SceneGeometry& geometry = scene_->geometry();
  for (std::size_t i = 0; i < X_WM.size(); ++i) {
    shadows_are_current_ = shadows_are_current_ && internal::IsSame(X_WM[i], X_WM_[i]);
    X_WM_[i] = X_WM[i];
    movers_[i] = {X_WM[i], nullptr};
    PlaceBox(geometry.movers[i], X_WM[i], boxes_[geometry.statics.size() + i]);
  }
}

Target RasterRenderer::DrawView(const View& view, bool with_ids) {
  const Target target =
      buffer_.Clear(view.intrinsics.width, view.intrinsics.height, static_cast<float>(1.0 / internal::kFar), with_ids);
  drawn_ = {drawn_numbers_.data(), 0};
  const std::array<float, 12> m = PixelFrom(view, base::Transform{});
  const internal::Frustum frustum = internal::FrustumOf(internal::ClipFromWorld(view));
  const Eigen::Vector3f eye_W = view.X_WC.p.cast<float>();
  const double focal = std::max(view.intrinsics.fx, view.intrinsics.fy);
  const std::span<const internal::Batch> boxes(boxes_);
  const std::size_t statics = scene_->geometry().statics.size();
  for (const std::uint32_t number : internal::VisibleOrder(boxes, &frustum, view.X_WC.p)) {
    if (!view.draw_movers && boxes[number].of_vehicle) continue;
    if (IsHidden(boxes[number], m, target)) continue;
    if (number < statics) {
      DrawLevel(boxes[number], internal::LevelFor(boxes[number], eye_W, focal), m, target);
    } else {
      DrawMover(view, number - statics, target);
    }
  }
  return target;
}

void RasterRenderer::DrawMover(const View& view, std::size_t number, const Target& target) {
  Placed& mover = movers_[number];
  const Eigen::Vector3f eye_M = (mover.X_WM.Inverse() * view.X_WC.p).cast<float>();
  const double focal = std::max(view.intrinsics.fx, view.intrinsics.fy);
  const internal::Level& level = internal::LevelFor(scene_->geometry().movers[number], eye_M, focal);
  if (target.ids != nullptr && mover.lit != &level) {
    scene_->LightMover(level, mover.X_WM, mover_attributes_.data(), mover_normals_.data());
    mover.lit = &level;
  }
  DrawLevel(scene_->geometry().movers[number], level, PixelFrom(view, mover.X_WM), target);
}

void RasterRenderer::DrawLevel(const internal::Batch& batch, const internal::Level& level,
                               const std::array<float, 12>& m, const Target& target) {
  kernels_->transform(scene_->positions(), vertices_.arrays(), level.first_vertex, level.vertex_count, m.data(),
                      static_cast<float>(internal::kNear));
  const std::uint32_t triangles = level.index_count / 3;
  to_clip_.resize(std::max<std::size_t>(to_clip_.size(), triangles));
  const DrawJob job{{scene_->corners(0), scene_->corners(1), scene_->corners(2)},
                    level.first_index / 3,
                    triangles,
                    vertices_.arrays(),
                    target,
                    &drawn_,
                    to_clip_.data()};
  const std::span<std::uint32_t> left(to_clip_.data(), batch.holes ? kernels_->choose(job) : kernels_->draw(job));
  if (batch.holes) SortByDepth(left);
  for (const std::uint32_t number : left) DrawSingly(target, number, batch.holes);
}

void RasterRenderer::SortByDepth(std::span<std::uint32_t> triangles) {
  const float* depth = vertices_.arrays().depth;
  by_depth_.clear();
  for (const std::uint32_t number : triangles) {
    float sum = 0.0F;
    for (std::size_t i = 0; i < 3; ++i) sum += depth[scene_->corners(i)[number]];
    by_depth_.emplace_back(sum, number);
  }
  std::sort(by_depth_.begin(), by_depth_.end());
  for (std::size_t i = 0; i < triangles.size(); ++i) triangles[i] = by_depth_[i].second;
}

void RasterRenderer::DrawSingly(const Target& target, std::uint32_t number, bool has_holes) {
  const Vertices& v = vertices_.arrays();
  std::array<Corner, 3> corners;
  std::array<base::Vec3, 3> p;
  std::array<std::uint32_t, 3> vertices{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t c = vertices[i] = scene_->corners(i)[number];
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
  HolePlanes holes;
  if (has_holes) {
    const base::Vec2 about(std::clamp(polygon_[0].x >> kSubPixelBits, 0, target.width),
                           std::clamp(polygon_[0].y >> kSubPixelBits, 0, target.height));
    holes = HolesOf(scene_->geometry(), scene_->alpha(), scene_->texture_of_triangle()[number], vertices, p, about);
  }
  for (std::size_t i = 2; i < polygon_.size(); ++i) {
    const Corner* fan[3] = {&polygon_[0], &polygon_[i], &polygon_[i - 1]};  // front faces turn the other way
    for (int k = 0; k < 3; ++k) {
      triangle.x[k] = fan[k]->x;
      triangle.y[k] = fan[k]->y;
    }
    has_holes ? kernels_->draw_with_holes(target, triangle, holes) : kernels_->draw_one(target, triangle);
  }
}

const ShadowMap& RasterRenderer::Shadows() {
  if (X_WM_.empty()) return scene_->shadow_map();
  if (!shadows_are_current_) {
    shadows_ = &mover_shadows_.Place(scene_->geometry(), scene_->shadow_map(), scene_->alpha(), *kernels_, X_WM_);
    shadows_are_current_ = true;
  }
  return *shadows_;
}

ShadeJob RasterRenderer::JobFor(const View& view, int channels, const Target& target) {
  const PackedTextures& textures = scene_->Textures(internal::TextureKindOf(view.infrared, channels));
  const ShadowMap& shadows = Shadows();
  ShadeJob job{};
  job.target = target;
  job.vertices = vertices_.arrays();
  for (std::size_t i = 0; i < 3; ++i) job.corners[i] = scene_->corners(i);
  job.texture_of_triangle = scene_->texture_of_triangle();
  job.shadowing_of_triangle = scene_->shadowing().of_triangle.data();
  job.shadowing_grids = scene_->shadowing().grids.data();
  job.shadowing_blocks = scene_->shadowing().blocks.data();
  mover_regions_.clear();
  for (const internal::ShadowRegion& region : mover_shadows_.regions()) {
    mover_regions_.push_back({region.x0, region.y0, region.x1, region.y1});
  }
  job.mover_shadows = mover_regions_.data();
  job.mover_shadow_count = static_cast<std::int32_t>(mover_regions_.size());
  job.attributes = scene_->attributes();
  job.mover_attributes = mover_attributes_.data();
  job.first_mover_vertex = scene_->first_mover_vertex();
  if (planes_.size() <= drawn_.count) planes_.resize(std::size_t{drawn_.count} + 1);
  job.drawn = drawn_.numbers;
  job.planes = planes_.data();
  job.frame = ++frame_;
  planes_[0].frame = job.frame;  // of pixels that show nothing: never made
  job.textures = textures.views.data();
  for (std::size_t c = 0; c < 3; ++c) job.words[c] = textures.words[c].data();
  job.shadow_map = shadows.words.data();
  job.shadow_side = internal::kShadowSide;
  job.shadow_pitch = shadows.pitch;
  job.channels = channels;
  job.brightness = view.brightness;
  SetSky(view, internal::SkyOf(scene_->geometry().light, channels, view.brightness), job);
  return job;
}

void RasterRenderer::Paint(const View& view, int channels, Picture& out) {
  internal::CheckView(view);
  out.width = view.intrinsics.width;
  out.height = view.intrinsics.height;
  out.channels = channels;
  out.bytes.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height) *
                   static_cast<std::size_t>(channels));
  const Target target = DrawView(view, true);
  ShadeJob job = JobFor(view, channels, target);
  job.out = out.bytes.data();
  const internal::AirAndLamps air = internal::AirAndLampsOf(scene_->geometry().light, view, channels);
  air.IsNeeded() ? ShadeLit(view, air, job) : kernels_->shade(job);
}

void RasterRenderer::Depth(const View& view, DepthPicture& out) {
  internal::CheckView(view);
  out.width = view.intrinsics.width;
  out.height = view.intrinsics.height;
  out.metres.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  kernels_->metres(DrawView(view, false), static_cast<float>(internal::kFar), out.metres.data());
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

NormalJob RasterRenderer::NormalsFor(const Target& target) {
  if (normal_planes_.size() < drawn_.count) normal_planes_.resize(drawn_.count);
  return {target,
          vertices_.arrays(),
          scene_->normals(),
          mover_normals_.data(),
          scene_->first_mover_vertex(),
          {scene_->corners(0), scene_->corners(1), scene_->corners(2)},
          drawn_.numbers,
          normal_planes_.data(),
          frame_};
}

void RasterRenderer::Surface(const View& view, SurfacePicture& out) {
  internal::CheckView(view);
  internal::Resize(view, out);
  out.first_mover = static_cast<std::uint32_t>(scene_->geometry().statics.size()) + 1;
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
      out.instances[pixel] = id == 0 ? 0 : scene_->instance_of(drawn_.numbers[id - 1]);
      out.classes[pixel] = scene_->geometry().classes[out.instances[pixel]];
    }
  }
}

}  // namespace alula::render::raster

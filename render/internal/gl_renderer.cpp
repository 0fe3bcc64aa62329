#include "render/internal/gl_renderer.h"

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "render/internal/shaders.h"
#include "render/internal/sky.h"

namespace alula::render::internal {
namespace {

std::string Describe(const GlContext& context) {
  const auto text = [&context](GLenum name) {
    const auto* words = reinterpret_cast<const char*>(context.gl().GetString(name));
    return std::string(words != nullptr ? words : "?");
  };
  return context.Maker() + ", " + text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

}  // namespace

GlRenderer::GlRenderer(std::unique_ptr<GlContext> context, const worlds::World& world, std::span<const Mover> movers,
                       Options options)
    : GlRenderer(std::move(context), std::make_shared<const SceneGeometry>(BuildScene(world, movers)), options) {}

GlRenderer::GlRenderer(std::unique_ptr<GlContext> context, std::shared_ptr<const SceneGeometry> scene, Options options)
    : context_(std::move(context)), options_(options), geometry_(std::move(scene)), X_WM_(geometry_->movers.size()) {
  const CurrentContext current(*context_);
  const GlFunctions& gl = current.gl();
  description_ = Describe(*context_);
  scene_ = std::make_unique<GpuScene>(gl, *geometry_);
  targets_ = std::make_unique<RenderTargets>(gl);
  grey_ = std::make_unique<GlProgram>(gl, kSurfaceVertex, options_.shadows ? kGreyFragment : kShadowlessGreyFragment);
  colour_ = std::make_unique<GlProgram>(gl, kSurfaceVertex, kColourFragment);
  depth_ = std::make_unique<GlProgram>(gl, kPositionVertex, kDepthFragment);
  sky_ = std::make_unique<GlProgram>(gl, kSkyVertex, kSkyFragment);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LEQUAL);
  gl.Enable(GL_CULL_FACE);
  gl.CullFace(GL_BACK);
  gl.FrontFace(GL_CW);  // rows come from the top: the picture is mirrored in GL's eyes
  CheckErrors();
}

std::unique_ptr<CameraRenderer> GlRenderer::Twin() const {
  return std::make_unique<GlRenderer>(context_->Another(), geometry_, options_);
}

void GlRenderer::PlaceMovers(std::span<const base::Transform> X_WM) {
  if (X_WM.size() != X_WM_.size()) {
    throw base::FaultError("render",
                           std::to_string(X_WM.size()) + " poses for " + std::to_string(X_WM_.size()) + " movers");
  }
  X_WM_.assign(X_WM.begin(), X_WM.end());
}

void GlRenderer::Grey(const View& view, Picture& out) {
  CheckView(view);
  const CurrentContext current(*context_);
  Begin(view, PixelKind::kGrey);
  DrawSurfaces(view, *grey_, 1);
  DrawSky(view, 1);
  out.width = view.intrinsics.width;
  out.height = view.intrinsics.height;
  out.channels = 1;
  out.bytes.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  current.gl().ReadPixels(0, 0, out.width, out.height, GL_RED, GL_UNSIGNED_BYTE, out.bytes.data());
  CheckErrors();
}

void GlRenderer::Colour(const View& view, Picture& out) {
  CheckView(view);
  const CurrentContext current(*context_);
  Begin(view, PixelKind::kColour);
  DrawSurfaces(view, *colour_, 3);
  DrawSky(view, 3);
  out.width = view.intrinsics.width;
  out.height = view.intrinsics.height;
  out.channels = 3;
  const std::size_t count = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
  rgba_.resize(4 * count);
  out.bytes.resize(3 * count);
  // Four bytes a pixel are a copy for GL; three would be converted value by value.
  current.gl().ReadPixels(0, 0, out.width, out.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 3; ++c) out.bytes[3 * i + c] = rgba_[4 * i + c];
  }
  CheckErrors();
}

void GlRenderer::Depth(const View& view, DepthPicture& out) {
  CheckView(view);
  const CurrentContext current(*context_);
  Begin(view, PixelKind::kMetres);
  DrawSurfaces(view, *depth_, 0);
  out.width = view.intrinsics.width;
  out.height = view.intrinsics.height;
  out.metres.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  current.gl().ReadPixels(0, 0, out.width, out.height, GL_RED, GL_FLOAT, out.metres.data());
  CheckErrors();
}

void GlRenderer::Begin(const View& view, PixelKind kind) {
  targets_->Bind(view.intrinsics.width, view.intrinsics.height, kind);
  context_->gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void GlRenderer::DrawSurfaces(const View& view, const GlProgram& program, int channels) {
  const Eigen::Matrix4d clip_from_world = ClipFromWorld(view);
  program.Use();
  scene_->Bind(program);
  program.Set("clip_from_world", clip_from_world);
  program.Set("brightness", view.brightness);
  if (view.draw_movers) DrawMovers(view, program, channels);
  program.SetAffine("world_from_model", base::Transform{});
  const std::vector<Batch>& statics = geometry_->statics;
  const Frustum frustum = FrustumOf(clip_from_world);
  const Frustum* seen = options_.cull ? &frustum : nullptr;
  scene_->Draw(NearestFirst(statics, seen, view.X_WC.p, FocalFor(view), channels == 0), channels);
}

double GlRenderer::FocalFor(const View& view) const {
  return options_.levels ? std::max(view.intrinsics.fx, view.intrinsics.fy) : std::numeric_limits<double>::infinity();
}

void GlRenderer::DrawMovers(const View& view, const GlProgram& program, int channels) {
  const std::vector<Batch>& movers = geometry_->movers;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    // Planes in the mover's own frame, where its box is: columns of the clip matrix times X_WM.
    Eigen::Matrix4d world_from_mover = Eigen::Matrix4d::Identity();
    world_from_mover.topLeftCorner<3, 3>() = X_WM_[i].R();
    world_from_mover.topRightCorner<3, 1>() = X_WM_[i].p;
    const Frustum frustum = FrustumOf(ClipFromWorld(view) * world_from_mover);
    const Frustum* seen = options_.cull ? &frustum : nullptr;
    const base::Vec3 eye_M = X_WM_[i].Inverse() * view.X_WC.p;
    const std::vector<DrawRun> runs =
        NearestFirst(std::span(&movers[i], 1), seen, eye_M, FocalFor(view), channels == 0);
    if (runs.empty()) continue;
    program.SetAffine("world_from_model", world_from_mover);
    scene_->Draw(runs, channels);
  }
}

void GlRenderer::DrawSky(const View& view, int channels) {
  const stack::CameraIntrinsics& k = view.intrinsics;
  const double right = k.width - 0.5;
  const double bottom = k.height - 0.5;
  const base::Vec3 middle = RayDirection(view, 0.5 * (right - 0.5), 0.5 * (bottom - 0.5));
  base::Mat3 rays;
  rays.col(0) = middle;
  rays.col(1) = RayDirection(view, right, 0.5 * (bottom - 0.5)) - middle;
  rays.col(2) = RayDirection(view, 0.5 * (right - 0.5), bottom) - middle;
  const SkyColours colours = SkyOf(geometry_->light, channels, view.brightness);
  sky_->Use();
  sky_->Set("rays", rays);
  sky_->Set("zenith", colours.zenith);
  sky_->Set("horizon", colours.horizon);
  sky_->Set("ground", colours.ground);
  const GlFunctions& gl = context_->gl();
  gl.Disable(GL_CULL_FACE);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.Enable(GL_CULL_FACE);
}

void GlRenderer::CheckErrors() const {
  if (const GLenum error = context_->gl().GetError(); error != GL_NO_ERROR) {
    throw base::FaultError("render", "OpenGL error " + std::to_string(error) + " of " + description_);
  }
}

}  // namespace alula::render::internal

#include "render/internal/gl_renderer.h"

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "render/internal/shaders.h"
#include "render/internal/sky.h"
#include "render/internal/visible_order.h"

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
    : context_(std::move(context)),
      options_(options),
      geometry_(std::move(scene)),
      X_WM_(geometry_->movers.size()),
      shadows_are_current_(X_WM_.empty()) {
  const CurrentContext current(*context_);
  const GlFunctions& gl = current.gl();
  description_ = Describe(*context_);
  scene_ = std::make_unique<GpuScene>(gl, *geometry_);
  targets_ = std::make_unique<RenderTargets>(gl);
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
  for (std::size_t i = 0; i < X_WM.size(); ++i) {
    shadows_are_current_ = shadows_are_current_ && IsSame(X_WM[i], X_WM_[i]);
    X_WM_[i] = X_WM[i];
  }
}

void GlRenderer::Grey(const View& view, Picture& out) {
  CheckView(view);
  const CurrentContext current(*context_);
  Begin(view, PixelKind::kGrey);
  Paint(view, 1);
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
  Paint(view, 3);
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
  DrawSurfaces(view, ProgramsOf(Pass::kDepth), TextureKind::kNone);
  out.width = view.intrinsics.width;
  out.height = view.intrinsics.height;
  out.metres.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  current.gl().ReadPixels(0, 0, out.width, out.height, GL_RED, GL_FLOAT, out.metres.data());
  CheckErrors();
}

void GlRenderer::Surface(const View& view, SurfacePicture& out) {
  CheckView(view);
  const CurrentContext current(*context_);
  Begin(view, PixelKind::kSurface);
  DrawInstances(view);
  Resize(view, out);
  out.first_mover = static_cast<std::uint32_t>(geometry_->statics.size()) + 1;
  surface_.resize(4 * out.instances.size());
  current.gl().ReadPixels(0, 0, out.width, out.height, GL_RGBA, GL_FLOAT, surface_.data());
  for (std::size_t i = 0; i < out.instances.size(); ++i) {
    const float* pixel = surface_.data() + 4 * i;
    out.normals[i] = {pixel[0], pixel[1], pixel[2]};
    out.instances[i] = static_cast<std::uint32_t>(pixel[3]);  // whole numbers below 2²⁴ are exact
    out.classes[i] = geometry_->classes[out.instances[i]];
  }
  CheckErrors();
}

void GlRenderer::Begin(const View& view, PixelKind kind) {
  const bool paints = kind == PixelKind::kGrey || kind == PixelKind::kColour;
  if (paints && !shadows_are_current_) {
    scene_->PlaceShadows(X_WM_);
    shadows_are_current_ = true;
  }
  targets_->Bind(view.intrinsics.width, view.intrinsics.height, kind);
  context_->gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

const GlProgram& GlRenderer::Program(Pass pass, bool lit, bool holes) {
  std::unique_ptr<GlProgram>& program =
      programs_[4 * static_cast<std::size_t>(pass) + (lit ? 2U : 0U) + (holes ? 1U : 0U)];
  if (program) return *program;
  std::string defines = "#define MOST_LAMPS " + std::to_string(kMostLamps) + "\n";
  if (pass == Pass::kColour) defines += "#define COLOUR\n";
  if (!options_.shadows) defines += "#define SHADOWLESS\n";
  if (lit) defines += "#define LIT\n";
  if (holes) defines += kHoles;
  const bool paints = pass == Pass::kGrey || pass == Pass::kColour;
  const char* vertex = paints ? kSurfaceVertex : pass == Pass::kDepth ? kPositionVertex : kNormalVertex;
  const char* fragment = paints ? kSurfaceFragment : pass == Pass::kDepth ? kDepthFragment : kNormalFragment;
  program = std::make_unique<GlProgram>(context_->gl(), vertex, fragment, defines);
  return *program;
}

GlRenderer::Programs GlRenderer::ProgramsOf(Pass pass, bool lit) {
  return {&Program(pass, lit, false), scene_->HasHoles() ? &Program(pass, lit, true) : nullptr};
}

void GlRenderer::Paint(const View& view, int channels) {
  const AirAndLamps air = AirAndLampsOf(geometry_->light, view, channels);
  const Programs programs = ProgramsOf(channels == 1 ? Pass::kGrey : Pass::kColour, air.IsNeeded());
  for (const GlProgram* program : programs) {
    if (program == nullptr || !air.IsNeeded()) continue;
    program->Use();
    program->Set("eye", view.X_WC.p.cast<float>().eval());
    program->Set("lamp_count", static_cast<int>(air.lamps.size()));
    static_assert(sizeof(LampView) == 12 * sizeof(float));
    const std::span lamps(reinterpret_cast<const float*>(air.lamps.data()), 12 * air.lamps.size());
    if (!lamps.empty()) program->Set("lamps", lamps);
    program->Set("fog", air.fog);
    program->Set("extinction", air.extinction);
  }
  DrawSurfaces(view, programs, TextureKindOf(view.infrared, channels));
  DrawSky(view, channels, air);
}

void GlRenderer::DrawSurfaces(const View& view, const Programs& programs, TextureKind kind) {
  const Eigen::Matrix4d clip_from_world = ClipFromWorld(view);
  const Frustum frustum = FrustumOf(clip_from_world);
  const std::vector<DrawRun> runs = NearestFirst(geometry_->statics, options_.cull ? &frustum : nullptr, view.X_WC.p,
                                                 FocalFor(view), kind == TextureKind::kNone);
  for (const bool holes : {false, true}) {
    const GlProgram* program = programs[holes ? 1 : 0];
    if (program == nullptr) continue;
    program->Use();
    scene_->Bind(*program);
    program->Set("clip_from_world", clip_from_world);
    program->Set("brightness", view.brightness);
    DrawMovers(view, *program, kind, holes);
    program->SetAffine("world_from_model", base::Transform{});
    scene_->Draw(Those(runs, holes), kind);
  }
}

double GlRenderer::FocalFor(const View& view) const {
  return options_.levels ? std::max(view.intrinsics.fx, view.intrinsics.fy) : std::numeric_limits<double>::infinity();
}

void GlRenderer::DrawMovers(const View& view, const GlProgram& program, TextureKind kind, bool holes) {
  const std::vector<Batch>& movers = geometry_->movers;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    if (movers[i].holes != holes || (movers[i].of_vehicle && !view.draw_movers)) continue;
    // Planes in the mover's own frame, where its box is: columns of the clip matrix times X_WM.
    Eigen::Matrix4d world_from_mover = Eigen::Matrix4d::Identity();
    world_from_mover.topLeftCorner<3, 3>() = X_WM_[i].R();
    world_from_mover.topRightCorner<3, 1>() = X_WM_[i].p;
    const Frustum frustum = FrustumOf(ClipFromWorld(view) * world_from_mover);
    const base::Vec3 eye_M = X_WM_[i].Inverse() * view.X_WC.p;
    const std::vector<DrawRun> runs = NearestFirst(std::span(&movers[i], 1), options_.cull ? &frustum : nullptr, eye_M,
                                                   FocalFor(view), kind == TextureKind::kNone);
    if (runs.empty()) continue;
    program.SetAffine("world_from_model", world_from_mover);
    scene_->Draw(runs, kind);
  }
}

/// One call a batch: each has its own number.
void GlRenderer::DrawInstances(const View& view) {
  const Eigen::Matrix4d clip_from_world = ClipFromWorld(view);
  const Programs programs = ProgramsOf(Pass::kNormal);
  const std::vector<Batch>& statics = geometry_->statics;
  const std::vector<Batch>& movers = geometry_->movers;
  const auto draw = [&](const GlProgram& program, const Batch& batch, std::size_t instance, const base::Transform& X) {
    program.SetAffine("world_from_model", X);
    program.Set("instance", static_cast<float>(instance));
    const base::Vec3 eye = X.Inverse() * view.X_WC.p;
    scene_->Draw(NearestFirst(std::span(&batch, 1), nullptr, eye, FocalFor(view), true), TextureKind::kNone);
  };
  const Frustum frustum = FrustumOf(clip_from_world);
  const std::vector<std::uint32_t> order = VisibleOrder(statics, options_.cull ? &frustum : nullptr, view.X_WC.p);
  for (const bool holes : {false, true}) {
    const GlProgram* program = programs[holes ? 1 : 0];
    if (program == nullptr) continue;
    program->Use();
    scene_->Bind(*program);
    program->Set("clip_from_world", clip_from_world);
    program->Set("camera_from_world", view.X_WC.Inverse().R());
    for (std::size_t i = 0; i < movers.size(); ++i) {
      const bool drawn = view.draw_movers || !movers[i].of_vehicle;
      if (drawn && movers[i].holes == holes) draw(*program, movers[i], statics.size() + i + 1, X_WM_[i]);
    }
    for (const std::uint32_t i : order) {
      if (statics[i].holes == holes) draw(*program, statics[i], i + 1, {});
    }
  }
}

void GlRenderer::DrawSky(const View& view, int channels, const AirAndLamps& air) {
  const stack::CameraIntrinsics& k = view.intrinsics;
  const double right = k.width - 0.5;
  const double bottom = k.height - 0.5;
  const base::Vec3 middle = RayDirection(view, 0.5 * (right - 0.5), 0.5 * (bottom - 0.5));
  base::Mat3 rays;
  rays.col(0) = middle;
  rays.col(1) = RayDirection(view, right, 0.5 * (bottom - 0.5)) - middle;
  rays.col(2) = RayDirection(view, 0.5 * (right - 0.5), bottom) - middle;
  const SkyColours colours = SkyOf(geometry_->light, channels, view.brightness);
  const bool foggy = air.extinction > 0.0F;
  if (foggy && !foggy_sky_) {
    foggy_sky_ = std::make_unique<GlProgram>(context_->gl(), kSkyVertex, kSkyFragment, "#define LIT\n");
  }
  const GlProgram& sky = foggy ? *foggy_sky_ : *sky_;
  sky.Use();
  sky.Set("rays", rays);
  sky.Set("zenith", colours.zenith);
  sky.Set("horizon", colours.horizon);
  sky.Set("ground", colours.ground);
  sky.Set("fog", air.fog);
  sky.Set("sky_depth", air.sky_depth);
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

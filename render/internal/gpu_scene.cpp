#include "render/internal/gpu_scene.h"

#include <cstddef>

#include "base/error.h"
#include "render/internal/shaders.h"
#include "render/internal/texture_levels.h"

namespace alula::render::internal {
namespace {

using Vertex = geometry::Mesh::Vertex;

/// `between_levels`: how the look-ups mix levels where the texture is seen smaller than it is.
GLuint UploadLevels(const GlFunctions& gl, const std::vector<TextureLevel>& levels, int channels,
                    GLint between_levels = GL_LINEAR_MIPMAP_LINEAR) {
  GLuint texture = 0;
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  GLint number = 0;
  for (const TextureLevel& level : levels) {
    gl.TexImage2D(GL_TEXTURE_2D, number++, channels == 1 ? GL_R8 : GL_RGBA8, level.width, level.height, 0,
                  channels == 1 ? GL_RED : GL_RGB, GL_UNSIGNED_BYTE, level.bytes.data());
  }
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, number - 1);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, between_levels);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
  return texture;
}

}  // namespace

GpuScene::GpuScene(const GlFunctions& gl, const SceneGeometry& geometry) : gl_(&gl), geometry_(&geometry) {
  for (const std::vector<Batch>* batches : {&geometry_->statics, &geometry_->movers}) {
    for (const Batch& batch : *batches) has_holes_ = has_holes_ || batch.holes;
  }
  Upload();
  DrawStaticShadows();
}

void GpuScene::Upload() {
  const GlFunctions& gl = *gl_;
  gl.GenVertexArrays(1, &vertex_array_);
  gl.BindVertexArray(vertex_array_);
  GLuint buffers[2] = {0, 0};
  gl.GenBuffers(2, buffers);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(geometry_->vertices.size() * sizeof(Vertex)),
                geometry_->vertices.data(), GL_STATIC_DRAW);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(geometry_->indices.size() * sizeof(std::uint32_t)),
                geometry_->indices.data(), GL_STATIC_DRAW);
  const auto attribute = [&gl](GLuint location, GLint size, std::size_t offset) {
    gl.EnableVertexAttribArray(location);
    gl.VertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, sizeof(Vertex), reinterpret_cast<const void*>(offset));
  };
  attribute(0, 3, offsetof(Vertex, position));
  attribute(1, 3, offsetof(Vertex, normal));
  attribute(2, 2, offsetof(Vertex, uv));
}

GpuScene::ShadowTarget GpuScene::MakeShadowTarget() const {
  const GlFunctions& gl = *gl_;
  ShadowTarget target;
  gl.GenTextures(1, &target.texture);
  gl.BindTexture(GL_TEXTURE_2D, target.texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, kShadowSide, kShadowSide, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);

  gl.GenFramebuffers(1, &target.framebuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, target.texture, 0);
  gl.DrawBuffer(GL_NONE);
  gl.ReadBuffer(GL_NONE);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw base::FaultError("render", "the shadow map cannot be drawn to");
  }
  return target;
}

void GpuScene::DrawCasters(const ShadowRegion& region, const Batch* mover, const base::Transform& X_WM) {
  const GlFunctions& gl = *gl_;
  gl.Viewport(0, 0, kShadowSide, kShadowSide);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LESS);
  gl.Enable(GL_SCISSOR_TEST);
  gl.Scissor(region.x0, region.y0, region.x1 - region.x0 + 1, region.y1 - region.y0 + 1);
  // Both faces, so that open meshes cast shadows too; pushed away from the sun by their slope against self-shadowing.
  gl.Disable(GL_CULL_FACE);
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(1.5F, 4.0F);
  if (mover != nullptr) gl.Enable(GL_DEPTH_CLAMP);  // movers may fly above all that stands
  for (const bool holes : {false, true}) {
    if (holes && !has_holes_) break;
    const std::vector<DrawRun> runs = Those(
        CasterRuns(mover != nullptr ? std::span(mover, 1) : std::span<const Batch>(geometry_->statics), true), holes);
    const GlProgram& program = holes ? *caster_with_holes_ : *caster_;
    program.Use();
    program.Set("clip_from_world", geometry_->shadow.clip_from_world);
    program.SetAffine("world_from_model", X_WM);
    program.Set("alpha", 2);
    Draw(runs, TextureKind::kNone);
  }
  gl.Disable(GL_DEPTH_CLAMP);
  gl.Disable(GL_POLYGON_OFFSET_FILL);
  gl.Disable(GL_SCISSOR_TEST);
  gl.Enable(GL_CULL_FACE);
  gl.DepthFunc(GL_LEQUAL);
}

void GpuScene::DrawStaticShadows() {
  const GlFunctions& gl = *gl_;
  // The rim stays empty: what lies beyond the map looks up its edge and finds light.
  constexpr ShadowRegion kInside{1, 1, kShadowSide - 2, kShadowSide - 2};
  caster_ = std::make_unique<GlProgram>(gl, kPositionVertex, kShadowFragment);
  if (has_holes_) caster_with_holes_ = std::make_unique<GlProgram>(gl, kPositionVertex, kShadowFragment, kHoles);
  shadow_map_ = MakeShadowTarget();
  gl.DepthMask(GL_TRUE);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  DrawCasters(kInside, nullptr, {});
  if (geometry_->movers.empty()) return;
  static_shadows_ = MakeShadowTarget();
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, shadow_map_.framebuffer);
  gl.BlitFramebuffer(0, 0, kShadowSide, kShadowSide, 0, 0, kShadowSide, kShadowSide, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

void GpuScene::PlaceShadows(std::span<const base::Transform> X_WM) {
  const GlFunctions& gl = *gl_;
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, static_shadows_.framebuffer);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, shadow_map_.framebuffer);
  for (const ShadowRegion& r : shadow_regions_) {
    gl.BlitFramebuffer(r.x0, r.y0, r.x1 + 1, r.y1 + 1, r.x0, r.y0, r.x1 + 1, r.y1 + 1, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  }
  shadow_regions_.clear();
  gl.BindVertexArray(vertex_array_);
  for (std::size_t i = 0; i < X_WM.size(); ++i) {
    if (!geometry_->movers[i].casts_shadow) continue;
    Eigen::Matrix4d world_from_mover = Eigen::Matrix4d::Identity();
    world_from_mover.topLeftCorner<3, 3>() = X_WM[i].R();
    world_from_mover.topRightCorner<3, 1>() = X_WM[i].p;
    const Batch& mover = geometry_->movers[i];
    const ShadowRegion region =
        RegionOf(geometry_->shadow.texture_from_world * world_from_mover, mover.low, mover.high);
    if (region.IsEmpty()) continue;
    DrawCasters(region, &mover, X_WM[i]);
    shadow_regions_.push_back(region);
  }
}

void GpuScene::Bind(const GlProgram& program) const {
  gl_->BindVertexArray(vertex_array_);
  gl_->ActiveTexture(GL_TEXTURE1);
  gl_->BindTexture(GL_TEXTURE_2D, shadow_map_.texture);
  gl_->ActiveTexture(GL_TEXTURE0);
  program.Set("albedo", 0);
  program.Set("shadow_map", 1);
  program.Set("alpha", 2);
  program.SetAffine("shadow_from_world", geometry_->shadow.texture_from_world);
  program.Set("to_sun", geometry_->light.to_sun_W.normalized().cast<float>().eval());
  program.Set("light", Eigen::Vector3f(geometry_->light.sun, geometry_->light.ambient,
                                       kShadowNormalOffset * static_cast<float>(geometry_->shadow.texel)));
}

GLuint GpuScene::TextureOf(int material, TextureKind kind) {
  GLuint& texture = textures_[{kind, material}];
  if (texture == 0) {
    const geometry::Material& m = geometry_->materials[static_cast<std::size_t>(material)];
    texture = UploadLevels(*gl_, TextureLevels(m, kind), ChannelsOf(kind));
  }
  return texture;
}

GLuint GpuScene::AlphaOf(int material) {
  GLuint& texture = alphas_[material];
  if (texture == 0) {
    // What is compared with one half needs no mixing, and looking up one texel is what the rasteriser's pace hangs on.
    texture = UploadLevels(*gl_, AlphaLevels(geometry_->materials[static_cast<std::size_t>(material)]), 1,
                           GL_NEAREST_MIPMAP_NEAREST);
  }
  return texture;
}

void GpuScene::Draw(std::span<const DrawRun> runs, TextureKind kind) {
  for (const DrawRun& run : runs) {
    if (run.holes) {
      gl_->ActiveTexture(GL_TEXTURE2);
      gl_->BindTexture(GL_TEXTURE_2D, AlphaOf(run.material));
      gl_->ActiveTexture(GL_TEXTURE0);
    }
    if (kind != TextureKind::kNone) gl_->BindTexture(GL_TEXTURE_2D, TextureOf(run.material, kind));
    gl_->MultiDrawElements(GL_TRIANGLES, run.counts.data(), GL_UNSIGNED_INT, run.offsets.data(),
                           static_cast<GLsizei>(run.counts.size()));
  }
}

}  // namespace alula::render::internal

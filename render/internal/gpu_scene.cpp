#include "render/internal/gpu_scene.h"

#include <cstddef>

#include "base/error.h"
#include "render/internal/shaders.h"
#include "render/internal/texture_levels.h"

namespace alula::render::internal {
namespace {

using Vertex = geometry::Mesh::Vertex;

GLuint UploadTexture(const GlFunctions& gl, const geometry::Material& material, int channels) {
  GLuint texture = 0;
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const std::vector<TextureLevel> levels = TextureLevels(material, channels);
  GLint number = 0;
  for (const TextureLevel& level : levels) {
    gl.TexImage2D(GL_TEXTURE_2D, number++, channels == 1 ? GL_R8 : GL_RGBA8, level.width, level.height, 0,
                  channels == 1 ? GL_RED : GL_RGB, GL_UNSIGNED_BYTE, level.bytes.data());
  }
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, number - 1);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
  return texture;
}

}  // namespace

GpuScene::GpuScene(const GlFunctions& gl, const SceneGeometry& geometry)
    : gl_(&gl),
      geometry_(&geometry),
      grey_textures_(geometry.materials.size(), 0),
      colour_textures_(geometry.materials.size(), 0) {
  Upload();
  DrawShadowMap();
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

void GpuScene::DrawShadowMap() {
  const GlFunctions& gl = *gl_;
  gl.GenTextures(1, &shadow_map_);
  gl.BindTexture(GL_TEXTURE_2D, shadow_map_);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, kShadowSide, kShadowSide, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);

  GLuint framebuffer = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow_map_, 0);
  gl.DrawBuffer(GL_NONE);
  gl.ReadBuffer(GL_NONE);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw base::FaultError("render", "the shadow map cannot be drawn to");
  }
  gl.Viewport(0, 0, kShadowSide, kShadowSide);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LESS);
  gl.DepthMask(GL_TRUE);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  // The rim stays empty: what lies beyond the map looks up its edge and finds light.
  gl.Enable(GL_SCISSOR_TEST);
  gl.Scissor(1, 1, kShadowSide - 2, kShadowSide - 2);
  // Both faces, so that open meshes cast shadows too; pushed away from the sun by their slope against self-shadowing.
  gl.Disable(GL_CULL_FACE);
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(1.5F, 4.0F);
  const GlProgram program(gl, kPositionVertex, kShadowFragment);
  program.Use();
  program.Set("clip_from_world", geometry_->shadow.clip_from_world);
  program.SetAffine("world_from_model", base::Transform{});
  Draw(AllRuns(geometry_->statics, true), 0);
  gl.Disable(GL_POLYGON_OFFSET_FILL);
  gl.Disable(GL_SCISSOR_TEST);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.DeleteFramebuffers(1, &framebuffer);
}

void GpuScene::Bind(const GlProgram& program) const {
  gl_->BindVertexArray(vertex_array_);
  gl_->ActiveTexture(GL_TEXTURE1);
  gl_->BindTexture(GL_TEXTURE_2D, shadow_map_);
  gl_->ActiveTexture(GL_TEXTURE0);
  program.Set("albedo", 0);
  program.Set("shadow_map", 1);
  program.SetAffine("shadow_from_world", geometry_->shadow.texture_from_world);
  program.Set("to_sun", geometry_->light.to_sun_W.normalized().cast<float>().eval());
  program.Set("light", Eigen::Vector3f(geometry_->light.sun, geometry_->light.ambient,
                                       kShadowNormalOffset * static_cast<float>(geometry_->shadow.texel)));
}

GLuint GpuScene::TextureOf(int material, int channels) {
  GLuint& texture = (channels == 1 ? grey_textures_ : colour_textures_)[static_cast<std::size_t>(material)];
  if (texture == 0) {
    texture = UploadTexture(*gl_, geometry_->materials[static_cast<std::size_t>(material)], channels);
  }
  return texture;
}

void GpuScene::Draw(std::span<const DrawRun> runs, int channels) {
  for (const DrawRun& run : runs) {
    if (channels > 0) gl_->BindTexture(GL_TEXTURE_2D, TextureOf(run.material, channels));
    gl_->MultiDrawElements(GL_TRIANGLES, run.counts.data(), GL_UNSIGNED_INT, run.offsets.data(),
                           static_cast<GLsizei>(run.counts.size()));
  }
}

}  // namespace alula::render::internal

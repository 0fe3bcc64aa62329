#include "render/internal/gl_program.h"

#include <array>
#include <string>

#include "base/error.h"

namespace alula::render::internal {
namespace {

GLuint Compile(const GlFunctions& gl, GLenum stage, const std::string& text) {
  const char* source = text.c_str();
  const GLuint shader = gl.CreateShader(stage);
  gl.ShaderSource(shader, 1, &source, nullptr);
  gl.CompileShader(shader);
  GLint good = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good != GL_TRUE) {
    std::array<char, 2048> log{};
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw base::FaultError("render", std::string("shader does not compile: ") + log.data());
  }
  return shader;
}

/// The version must come first.
std::string WithDefines(const std::string& source, const std::string& defines) {
  const std::size_t second_line = source.find('\n') + 1;
  return source.substr(0, second_line) + defines + source.substr(second_line);
}

}  // namespace

GlProgram::GlProgram(const GlFunctions& gl, const char* vertex_source, const char* fragment_source,
                     const std::string& defines)
    : gl_(&gl), id_(gl.CreateProgram()) {
  for (const GLuint shader : {Compile(gl, GL_VERTEX_SHADER, WithDefines(vertex_source, defines)),
                              Compile(gl, GL_FRAGMENT_SHADER, WithDefines(fragment_source, defines))}) {
    gl.AttachShader(id_, shader);
    gl.DeleteShader(shader);  // stays alive while attached
  }
  gl.LinkProgram(id_);
  GLint good = GL_FALSE;
  gl.GetProgramiv(id_, GL_LINK_STATUS, &good);
  if (good != GL_TRUE) {
    std::array<char, 2048> log{};
    gl.GetProgramInfoLog(id_, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw base::FaultError("render", std::string("shaders do not link: ") + log.data());
  }
}

void GlProgram::Set(const char* name, int value) const { gl_->Uniform1i(gl_->GetUniformLocation(id_, name), value); }

void GlProgram::Set(const char* name, float value) const { gl_->Uniform1f(gl_->GetUniformLocation(id_, name), value); }

void GlProgram::Set(const char* name, const Eigen::Vector3f& value) const {
  gl_->Uniform3fv(gl_->GetUniformLocation(id_, name), 1, value.data());
}

void GlProgram::Set(const char* name, std::span<const float> values) const {
  gl_->Uniform4fv(gl_->GetUniformLocation(id_, name), static_cast<GLsizei>(values.size() / 4), values.data());
}

void GlProgram::Set(const char* name, const Eigen::Matrix3d& value) const {
  const Eigen::Matrix3f m = value.cast<float>();
  gl_->UniformMatrix3fv(gl_->GetUniformLocation(id_, name), 1, GL_FALSE, m.data());
}

void GlProgram::Set(const char* name, const Eigen::Matrix4d& value) const {
  const Eigen::Matrix4f m = value.cast<float>();
  gl_->UniformMatrix4fv(gl_->GetUniformLocation(id_, name), 1, GL_FALSE, m.data());
}

void GlProgram::SetAffine(const char* name, const Eigen::Matrix4d& value) const {
  const Eigen::Matrix<float, 3, 4> m = value.topRows<3>().cast<float>();
  gl_->UniformMatrix4x3fv(gl_->GetUniformLocation(id_, name), 1, GL_FALSE, m.data());
}

void GlProgram::SetAffine(const char* name, const base::Transform& X) const {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = X.R();
  m.topRightCorner<3, 1>() = X.p;
  SetAffine(name, m);
}

}  // namespace alula::render::internal

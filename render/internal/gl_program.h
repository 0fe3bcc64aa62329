#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "base/frames.h"
#include "render/internal/gl_functions.h"

namespace alula::render::internal {

/// A linked pair of shaders of the current context.
class GlProgram {
 public:
  /// `defines`: lines put after the sources' first ones. Throws base::FaultError with the compiler's log.
  GlProgram(const GlFunctions& gl, const char* vertex_source, const char* fragment_source,
            const std::string& defines = {});

  void Use() const { gl_->UseProgram(id_); }
  // Set uniforms of the program in use; names that the compiler dropped are ignored, as GL does.
  void Set(const char* name, int value) const;
  void Set(const char* name, float value) const;
  void Set(const char* name, const Eigen::Vector3f& value) const;
  /// An array of vec4.
  void Set(const char* name, std::span<const float> values) const;
  void Set(const char* name, const Eigen::Matrix3d& value) const;
  void Set(const char* name, const Eigen::Matrix4d& value) const;
  /// As mat4x3: the upper three rows.
  void SetAffine(const char* name, const Eigen::Matrix4d& value) const;
  void SetAffine(const char* name, const base::Transform& X) const;

 private:
  const GlFunctions* gl_;
  GLuint id_ = 0;
};

}  // namespace alula::render::internal

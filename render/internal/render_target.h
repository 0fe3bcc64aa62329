#pragma once

#include <vector>

#include "render/internal/gl_functions.h"

namespace alula::render::internal {

/// What a pass writes: luma, colour, metres, or normal and instance.
enum class PixelKind { kGrey, kColour, kMetres, kSurface };

/// Framebuffers by size and kind, made when first asked for. The context must be current in every call.
class RenderTargets {
 public:
  explicit RenderTargets(const GlFunctions& gl) : gl_(&gl) {}

  /// Binds the framebuffer of this size and kind and sets the viewport. Throws base::FaultError where GL refuses it.
  void Bind(int width, int height, PixelKind kind);

 private:
  struct Target {
    int width = 0;
    int height = 0;
    PixelKind kind = PixelKind::kGrey;
    GLuint framebuffer = 0;
  };
  Target Make(int width, int height, PixelKind kind) const;

  const GlFunctions* gl_;
  std::vector<Target> targets_;
};

}  // namespace alula::render::internal

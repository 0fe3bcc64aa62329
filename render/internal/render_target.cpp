#include "render/internal/render_target.h"

#include <algorithm>
#include <string>

#include "base/error.h"

namespace alula::render::internal {
namespace {

GLenum FormatOf(PixelKind kind) {
  switch (kind) {
    case PixelKind::kGrey:
      return GL_R8;
    case PixelKind::kColour:
      return GL_RGBA8;
    case PixelKind::kMetres:
      return GL_R32F;
    case PixelKind::kSurface:
      return GL_RGBA32F;
  }
  throw base::FaultError("render", "unknown kind of pixel");
}

}  // namespace

void RenderTargets::Bind(int width, int height, PixelKind kind) {
  auto found = std::find_if(targets_.begin(), targets_.end(),
                            [&](const Target& t) { return t.width == width && t.height == height && t.kind == kind; });
  if (found == targets_.end()) found = targets_.insert(targets_.end(), Make(width, height, kind));
  gl_->BindFramebuffer(GL_FRAMEBUFFER, found->framebuffer);
  gl_->Viewport(0, 0, width, height);
}

RenderTargets::Target RenderTargets::Make(int width, int height, PixelKind kind) const {
  Target target{width, height, kind, 0};
  GLuint buffers[2] = {0, 0};
  gl_->GenFramebuffers(1, &target.framebuffer);
  gl_->GenRenderbuffers(2, buffers);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  gl_->BindRenderbuffer(GL_RENDERBUFFER, buffers[0]);
  gl_->RenderbufferStorage(GL_RENDERBUFFER, FormatOf(kind), width, height);
  gl_->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
  gl_->BindRenderbuffer(GL_RENDERBUFFER, buffers[1]);
  gl_->RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
  gl_->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
  if (gl_->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw base::FaultError("render", "no framebuffer of " + std::to_string(width) + " x " + std::to_string(height));
  }
  return target;
}

}  // namespace alula::render::internal

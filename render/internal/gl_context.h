#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/internal/gl_functions.h"

namespace alula::render::internal {

/// An OpenGL 3.3 core context without a window. Everything is drawn into framebuffer objects of our own. What was
/// created in the context goes with it.
class GlContext {
 public:
  virtual ~GlContext() = default;
  /// Binds the context to the calling thread; the function table is valid from then on.
  virtual void MakeCurrent() = 0;
  /// Unbinds it, so that another thread (or another context on this one) may follow.
  virtual void Release() = 0;
  virtual const GlFunctions& gl() const = 0;
  virtual std::string Maker() const = 0;
  /// A new context of the same kind, which shares nothing with this one.
  virtual std::unique_ptr<GlContext> Another() const = 0;
};

/// Holds a context current on this thread for the length of a scope.
class CurrentContext {
 public:
  explicit CurrentContext(GlContext& context) : context_(context) { context_.MakeCurrent(); }
  ~CurrentContext() { context_.Release(); }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;
  const GlFunctions& gl() const { return context_.gl(); }

 private:
  GlContext& context_;
};

/// Mesa's off-screen library, the first of `libraries` that loads. Throws base::InputError where there is none.
std::unique_ptr<GlContext> MakeOsMesaContext(const std::vector<std::string>& libraries = {"libOSMesa.so.8",
                                                                                          "libOSMesa.so.6"});
/// Whether libOSMesa can be loaded.
bool HasOsMesa();
/// EGL without a surface: Mesa's surfaceless platform first, then the devices of EGL_EXT_device_base, then the default
/// display. Throws base::InputError saying what was missing at each of them.
std::unique_ptr<GlContext> MakeEglContext(const std::string& library = "libEGL.so.1");

}  // namespace alula::render::internal

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <array>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "render/internal/gl_context.h"

namespace alula::render::internal {
namespace {

/// The entry points of libEGL.so.1, resolved at run time.
struct EglApi {
  void* library = nullptr;
  decltype(&eglGetProcAddress) get_address = nullptr;
  decltype(&eglGetDisplay) get_display = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglQueryString) query_string = nullptr;
  decltype(&eglBindAPI) bind_api = nullptr;
  decltype(&eglChooseConfig) choose_config = nullptr;
  decltype(&eglCreateContext) create_context = nullptr;
  decltype(&eglDestroyContext) destroy_context = nullptr;
  decltype(&eglMakeCurrent) make_current = nullptr;
};

template <typename Function>
void Resolve(const EglApi& egl, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(egl.library, name));
  if (function == nullptr) throw base::InputError(std::string("renderer \"egl\": libEGL has no ") + name);
}

EglApi LoadEgl(const std::string& library) {
  EglApi egl;
  egl.library = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);  // never closed, as Mesa's own state outlives contexts
  if (egl.library == nullptr) {
    throw base::InputError("renderer \"egl\" is not available: " + library +
                           " cannot be loaded; install libegl1 or choose \"osmesa\"");
  }
  Resolve(egl, "eglGetProcAddress", egl.get_address);
  Resolve(egl, "eglGetDisplay", egl.get_display);
  Resolve(egl, "eglInitialize", egl.initialize);
  Resolve(egl, "eglQueryString", egl.query_string);
  Resolve(egl, "eglBindAPI", egl.bind_api);
  Resolve(egl, "eglChooseConfig", egl.choose_config);
  Resolve(egl, "eglCreateContext", egl.create_context);
  Resolve(egl, "eglDestroyContext", egl.destroy_context);
  Resolve(egl, "eglMakeCurrent", egl.make_current);
  return egl;
}

bool HasExtension(const char* list, std::string_view name) {
  if (list == nullptr) return false;
  const std::string spaced = " " + std::string(list) + " ";
  return spaced.find(" " + std::string(name) + " ") != std::string::npos;
}

struct Candidate {
  std::string name;
  EGLDisplay display = EGL_NO_DISPLAY;
};

/// The displays worth trying, best first.
std::vector<Candidate> Displays(const EglApi& egl) {
  std::vector<Candidate> displays;
  const char* client = egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto get_platform_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl.get_address("eglGetPlatformDisplayEXT"));
  const bool platforms = HasExtension(client, "EGL_EXT_platform_base") && get_platform_display != nullptr;
  if (platforms && HasExtension(client, "EGL_MESA_platform_surfaceless")) {
    displays.push_back(
        {"surfaceless", get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)});
  }
  const auto query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.get_address("eglQueryDevicesEXT"));
  if (platforms && HasExtension(client, "EGL_EXT_platform_device") && query_devices != nullptr) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE) {
      for (EGLint i = 0; i < count; ++i) {
        displays.push_back(
            {"device " + std::to_string(i),
             get_platform_display(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr)});
      }
    }
  }
  displays.push_back({"default", egl.get_display(EGL_DEFAULT_DISPLAY)});
  return displays;
}

/// A context on this display; EGL_NO_CONTEXT with the reason in `why` where it cannot give one.
EGLContext CreateContext(const EglApi& egl, EGLDisplay display, std::string& why) {
  if (display == EGL_NO_DISPLAY || egl.initialize(display, nullptr, nullptr) != EGL_TRUE) {
    why = "does not initialise";
    return EGL_NO_CONTEXT;
  }
  const char* extensions = egl.query_string(display, EGL_EXTENSIONS);
  if (!HasExtension(extensions, "EGL_KHR_surfaceless_context")) {
    why = "lacks EGL_KHR_surfaceless_context";
    return EGL_NO_CONTEXT;
  }
  egl.bind_api(EGL_OPENGL_API);
  EGLConfig config = nullptr;
  EGLint count = 0;
  constexpr std::array config_attributes = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  if (!HasExtension(extensions, "EGL_KHR_no_config_context") &&
      (egl.choose_config(display, config_attributes.data(), &config, 1, &count) != EGL_TRUE || count == 0)) {
    why = "has no configuration for OpenGL";
    return EGL_NO_CONTEXT;
  }
  constexpr std::array attributes = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  EGLContext context = egl.create_context(display, config, EGL_NO_CONTEXT, attributes.data());
  if (context == EGL_NO_CONTEXT) why = "gives no OpenGL 3.3 core context";
  return context;
}

class EglContext final : public GlContext {
 public:
  explicit EglContext(const std::string& library) : library_(library), egl_(LoadEgl(library)) {
    std::string tried;
    for (const Candidate& candidate : Displays(egl_)) {
      std::string why;
      context_ = CreateContext(egl_, candidate.display, why);
      if (context_ != EGL_NO_CONTEXT) {
        display_ = candidate.display;
        break;
      }
      tried += (tried.empty() ? "" : ", ") + candidate.name + " " + why;
    }
    if (context_ == EGL_NO_CONTEXT) {
      throw base::InputError("renderer \"egl\" is not available: " + tried +
                             "; install libegl-mesa0 or choose \"osmesa\"");
    }
    const auto load = [this](const char* name) { return reinterpret_cast<void*>(egl_.get_address(name)); };
    try {
      gl_ = LoadGlFunctions(load, "egl");
    } catch (...) {
      egl_.destroy_context(display_, context_);
      throw;
    }
  }
  // The display is one for the whole process and stays initialised: another renderer may be using it.
  ~EglContext() override { egl_.destroy_context(display_, context_); }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void MakeCurrent() override {
    egl_.bind_api(EGL_OPENGL_API);  // a setting of the thread, and the thread may be new
    if (egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
      throw base::FaultError("render", "eglMakeCurrent failed; is the renderer in use by another thread?");
    }
  }
  void Release() override { egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
  const GlFunctions& gl() const override { return gl_; }
  std::string Maker() const override { return "egl"; }
  std::unique_ptr<GlContext> Another() const override { return std::make_unique<EglContext>(library_); }

 private:
  std::string library_;
  EglApi egl_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  GlFunctions gl_;
};

}  // namespace

std::unique_ptr<GlContext> MakeEglContext(const std::string& library) { return std::make_unique<EglContext>(library); }

}  // namespace alula::render::internal

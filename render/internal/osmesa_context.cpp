#include <dlfcn.h>

#include <array>

#include "base/error.h"
#include "render/internal/gl_context.h"

namespace alula::render::internal {
namespace {

// What GL/osmesa.h says, written out: that header pulls in GL/gl.h, whose types clash with the core profile's.
struct OsMesaHandle;
using CreateFunction = OsMesaHandle*(APIENTRYP)(const int* attributes, OsMesaHandle* share);
using DestroyFunction = void(APIENTRYP)(OsMesaHandle*);
using MakeCurrentFunction = GLboolean(APIENTRYP)(OsMesaHandle*, void* buffer, GLenum type, GLsizei width,
                                                 GLsizei height);
using GetProcAddressFunction = void (*(APIENTRYP)(const char* name))();
constexpr int kFormat = 0x22;
constexpr int kDepthBits = 0x30;
constexpr int kStencilBits = 0x31;
constexpr int kAccumBits = 0x32;
constexpr int kProfile = 0x33;
constexpr int kCoreProfile = 0x34;
constexpr int kMajorVersion = 0x36;
constexpr int kMinorVersion = 0x37;

// Never closed: Mesa's atexit handlers and thread-local tables must outlive every context.
void* OpenLibrary(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (void* library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) return library;
  }
  return nullptr;
}

template <typename Function>
Function Symbol(void* library, const char* name) {
  auto* function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr) {
    throw base::InputError(std::string("renderer \"osmesa\": libOSMesa has no ") + name +
                           "; Mesa 11.2 or later is needed");
  }
  return function;
}

class OsMesaContext final : public GlContext {
 public:
  explicit OsMesaContext(void* library)
      : library_(library),
        make_current_(Symbol<MakeCurrentFunction>(library, "OSMesaMakeCurrent")),
        destroy_(Symbol<DestroyFunction>(library, "OSMesaDestroyContext")) {
    const auto create = Symbol<CreateFunction>(library, "OSMesaCreateContextAttribs");
    const auto get_address = Symbol<GetProcAddressFunction>(library, "OSMesaGetProcAddress");
    constexpr std::array attributes = {kFormat,  GL_RGBA,      kDepthBits,    0, kStencilBits,  0, kAccumBits, 0,
                                       kProfile, kCoreProfile, kMajorVersion, 3, kMinorVersion, 3, 0};
    context_ = create(attributes.data(), nullptr);
    if (context_ == nullptr) throw base::InputError("renderer \"osmesa\" gives no OpenGL 3.3 core context");
    // OSMesaGetProcAddress answers any name: what the library exports comes first.
    const auto load = [library, get_address](const char* name) -> void* {
      if (void* exported = dlsym(library, name)) return exported;
      return reinterpret_cast<void*>(get_address(name));
    };
    gl_ = LoadGlFunctions(load, "osmesa");
  }
  ~OsMesaContext() override { destroy_(context_); }
  OsMesaContext(const OsMesaContext&) = delete;
  OsMesaContext& operator=(const OsMesaContext&) = delete;

  void MakeCurrent() override {
    if (make_current_(context_, buffer_.data(), GL_UNSIGNED_BYTE, kSide, kSide) == GL_FALSE) {
      throw base::FaultError("render", "OSMesaMakeCurrent failed");
    }
  }
  void Release() override { make_current_(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
  const GlFunctions& gl() const override { return gl_; }
  std::string Maker() const override { return "osmesa"; }
  std::unique_ptr<GlContext> Another() const override { return std::make_unique<OsMesaContext>(library_); }

 private:
  static constexpr int kSide = 4;                           // of the default framebuffer, which is never drawn to
  std::array<std::uint8_t, 4UL * kSide * kSide> buffer_{};  // OSMesa wants one all the same
  void* library_;                                           // stays loaded
  MakeCurrentFunction make_current_;
  DestroyFunction destroy_;
  OsMesaHandle* context_ = nullptr;
  GlFunctions gl_;
};

}  // namespace

bool HasOsMesa() { return OpenLibrary({"libOSMesa.so.8", "libOSMesa.so.6"}) != nullptr; }

std::unique_ptr<GlContext> MakeOsMesaContext(const std::vector<std::string>& libraries) {
  void* library = OpenLibrary(libraries);
  if (library == nullptr) {
    throw base::InputError("renderer \"osmesa\" is not available: " + libraries.front() +
                           " cannot be loaded; install libosmesa6 or choose \"egl\"");
  }
  return std::make_unique<OsMesaContext>(library);
}

}  // namespace alula::render::internal

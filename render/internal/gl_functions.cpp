#include "render/internal/gl_functions.h"

#include <string>

#include "base/error.h"

namespace alula::render::internal {
namespace {

template <typename Function>
void Load(const GlLoader& load, std::string_view maker, const char* name, Function& function) {
  function = reinterpret_cast<Function>(load(name));
  if (function == nullptr) {
    throw base::InputError("renderer \"" + std::string(maker) + "\" has no " + name + "; OpenGL 3.3 is needed");
  }
}

}  // namespace

GlFunctions LoadGlFunctions(const GlLoader& load, std::string_view maker) {
  GlFunctions gl;
#define ALULA_GL_LOAD(name, capitals) Load(load, maker, "gl" #name, gl.name);
  ALULA_GL_FUNCTIONS(ALULA_GL_LOAD)
#undef ALULA_GL_LOAD
  return gl;
}

}  // namespace alula::render::internal

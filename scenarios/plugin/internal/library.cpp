#include "scenarios/plugin/internal/library.h"

#include <dlfcn.h>

#include <cstring>
#include <string>
#include <system_error>

#include "base/error.h"
#include "scenarios/plugin/internal/float_state.h"

namespace alula::scenarios::plugin {
namespace {

constexpr const char* kSymbol = "alula_stack_plugin";
constexpr const char* kFactorSymbol = "alula_stack_compute_factor";
constexpr AlulaLayout kLayout = ALULA_LAYOUT;

/// The loader's words for what went wrong last.
std::string LoaderError() {
  const char* text = ::dlerror();
  return text != nullptr ? text : "the loader does not say why";
}

}  // namespace

std::string Mismatch(const AlulaStackPlugin& table) {
  if (table.abi_version != ALULA_STACK_ABI_VERSION) {
    return "was built for version " + std::to_string(table.abi_version) + " of plugin.h; this Alula speaks version " +
           std::to_string(ALULA_STACK_ABI_VERSION) + ": build it again with stack/interface/plugin.h of this one";
  }
  if (std::memcmp(&table.layout, &kLayout, sizeof kLayout) != 0) {
    return "lays out the structs of plugin.h differently; build it with stack/interface/plugin.h as it is, "
           "ALULA_LAYOUT "
           "in its table and no packing options";
  }
  if (table.create == nullptr) return "has no `create` in its table";
  if (table.step == nullptr) return "has no `step` in its table";
  if (table.destroy == nullptr) return "has no `destroy` in its table";
  return {};
}

Library LoadLibrary(const std::filesystem::path& library, const base::Origin& origin) {
  const auto fail = [&](const std::string& what) -> base::InputError {
    return {origin.where, origin.path.empty() ? "stack.library" : origin.path, "`" + library.string() + "` " + what};
  };
  std::error_code error;
  if (!std::filesystem::exists(library, error)) throw fail("does not exist; is the name right?");
  if (!std::filesystem::is_regular_file(library, error)) throw fail("is no file; a shared library is wanted");

  const KeepFloatState keep;
  // The absolute path: a name without a slash would be looked for among the system's libraries.
  void* handle = ::dlopen(std::filesystem::absolute(library).c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (handle == nullptr) throw fail("cannot be loaded as a shared library: " + LoaderError());
  void* symbol = ::dlsym(handle, kSymbol);
  if (symbol == nullptr) throw fail(std::string("exports no `") + kSymbol + "`; stack/interface/plugin.h says how");
  const AlulaStackPlugin* table = reinterpret_cast<decltype(&alula_stack_plugin)>(symbol)();
  if (table == nullptr) throw fail(std::string("returns nothing from `") + kSymbol + "`");
  if (const std::string wrong = Mismatch(*table); !wrong.empty()) throw fail(wrong);
  void* factor = ::dlsym(handle, kFactorSymbol);  // may be missing
  return {*table, reinterpret_cast<decltype(&alula_stack_compute_factor)>(factor)};
}

}  // namespace alula::scenarios::plugin

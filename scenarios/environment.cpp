#include "scenarios/environment.h"

#include <unistd.h>

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace alula::scenarios {
namespace {

constexpr const char* kMark = "ALULA_ENVIRONMENT_FIXED";

struct Wanted {
  const char* name;
  const char* value;
};
// llvmpipe in the calling thread and eight lanes wide; one thread in every BLAS.
constexpr Wanted kSet[] = {{"LP_NUM_THREADS", "0"},
                           {"LP_NATIVE_VECTOR_WIDTH", "256"},
                           {"OMP_NUM_THREADS", "1"},
                           {"OPENBLAS_NUM_THREADS", "1"},
                           {"MKL_NUM_THREADS", "1"}};
constexpr const char* kUnset[] = {"LP_PERF",       "GALLIVM_PERF", "GALLIUM_OVERRIDE_CPU_CAPS", "GLIBC_TUNABLES",
                                  "GALLIVM_DEBUG", "LP_DEBUG",     "OPENBLAS_CORETYPE"};

/// OPENCV_… switches code paths (OPENCV_CPU_DISABLE, OPENCV_IPP, …).
std::vector<std::string> OpenCvVariables() {
  std::vector<std::string> names;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    if (text.starts_with("OPENCV_")) names.emplace_back(text.substr(0, text.find('=')));
  }
  return names;
}

}  // namespace

void FixEnvironment(char** argv) {
  bool changed = false;
  for (const Wanted& wanted : kSet) {
    const char* const now = std::getenv(wanted.name);
    if (now != nullptr && std::string_view(now) == wanted.value) continue;
    ::setenv(wanted.name, wanted.value, 1);
    changed = true;
  }
  std::vector<std::string> unwanted = OpenCvVariables();
  unwanted.insert(unwanted.end(), std::begin(kUnset), std::end(kUnset));
  for (const std::string& name : unwanted) {
    changed = changed || std::getenv(name.c_str()) != nullptr;
    ::unsetenv(name.c_str());
  }
  if (!changed || std::getenv(kMark) != nullptr) return;
  ::setenv(kMark, "1", 1);
  ::execv("/proc/self/exe", argv);  // returns on failure only; then the environment holds for what loads later
}

}  // namespace alula::scenarios

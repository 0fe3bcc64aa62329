#include "scenarios/numeric_class.h"

#include <dlfcn.h>
#include <gnu/libc-version.h>

#include <Eigen/Core>
#include <filesystem>
#include <opencv2/core.hpp>

namespace alula::scenarios {
namespace {

/// The file that the loader took for BLAS: Debian lets one choose.
std::string BlasLibrary() {
  void* const symbol = ::dlsym(RTLD_DEFAULT, "dgemm_");
  Dl_info info{};
  if (symbol == nullptr || ::dladdr(symbol, &info) == 0) return "none";
  std::error_code error;
  const std::filesystem::path real = std::filesystem::canonical(info.dli_fname, error);
  return error ? std::string(info.dli_fname) : real.parent_path().filename().string() + "/" + real.filename().string();
}

std::string CpuLevel() {
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "avx2+fma";
  return "without avx2+fma";
}

}  // namespace

std::map<std::string, std::string> Versions(std::string_view renderer) {
  return {{"alula", ALULA_VERSION},
          {"blas", BlasLibrary()},
#ifdef __clang__
          {"compiler", "clang " __clang_version__},
#else
          {"compiler", "gcc " __VERSION__},
#endif
          {"cpu", CpuLevel()},
          {"eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                        std::to_string(EIGEN_MINOR_VERSION)},
          {"glibc", ::gnu_get_libc_version()},
          {"opencv", cv::getVersionString()},
          {"renderer", std::string(renderer)}};
}

std::string NumericClass(const std::map<std::string, std::string>& versions) {
  std::string name;
  for (const char* part : {"cpu", "compiler", "glibc", "opencv", "blas", "eigen", "renderer"}) {
    if (versions.at(part).empty()) continue;
    name += (name.empty() ? "" : "; ") + std::string(part) + " " + versions.at(part);
  }
  return name;
}

}  // namespace alula::scenarios

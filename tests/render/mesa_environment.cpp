#include <cstdlib>

namespace {

/// What the program fixes for llvmpipe before anything draws: without it the number of threads depends on the machine.
/// The renderer loads Mesa at run time, so that setting it before main is early enough here.
const int kFixed = [] {
  setenv("LP_NUM_THREADS", "0", 1);
  setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
  unsetenv("LP_PERF");
  unsetenv("GALLIVM_PERF");
  unsetenv("GALLIUM_OVERRIDE_CPU_CAPS");
  return 0;
}();

}  // namespace

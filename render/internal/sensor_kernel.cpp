#include "render/internal/sensor_kernel.h"

namespace alula::render::internal {
namespace {

#include "render/internal/sensor_loop.inc"

}  // namespace

void SenseBaseline(const SensorJob& job) { KernelOf(job)(job); }

SensorKernel ChooseSensorKernel() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return SenseAvx2;
#endif
  return SenseBaseline;
}

}  // namespace alula::render::internal

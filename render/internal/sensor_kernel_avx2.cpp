#include "render/internal/sensor_kernel.h"

namespace alula::render::internal {
namespace {

#include "render/internal/sensor_loop.inc"

}  // namespace

void SenseAvx2(const SensorJob& job) { KernelOf(job)(job); }

}  // namespace alula::render::internal

#pragma once

#include "render/raster/kernels.h"

namespace alula::render::raster {

/// The AVX2 build of the kernels, whatever the processor; only calling into it needs AVX2.
const Kernels* Avx2Table();

}  // namespace alula::render::raster

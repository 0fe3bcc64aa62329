#include "render/raster/kernels.h"

namespace alula::render::raster {
namespace {

// One text, compiled for two instruction sets; the lanes come first.
// clang-format off
#include "render/raster/lanes_scalar.inc"
#include "render/raster/transform.inc"
#include "render/raster/draw.inc"
#include "render/raster/fragments.inc"
#include "render/raster/sampling.inc"
#include "render/raster/holes.inc"
#include "render/raster/shade.inc"
#include "render/raster/normals.inc"
#include "render/raster/lit.inc"
// clang-format on

constexpr Kernels kKernels{"scalar", Transform, Choose, Draw, DrawOne, DrawWithHoles, Shade, Metres, Normals, ShadeLit};

}  // namespace

const Kernels& ScalarKernels() { return kKernels; }

}  // namespace alula::render::raster

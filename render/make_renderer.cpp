#include "base/error.h"
#include "render/camera_renderer.h"
#include "render/internal/gl_renderer.h"
#include "render/plain_reference.h"
#include "render/raster/raster_renderer.h"

namespace alula::render {
namespace {

std::unique_ptr<internal::GlContext> MakeContext(std::string_view maker) {
  if (maker == "osmesa") return internal::MakeOsMesaContext();
  if (maker == "egl") return internal::MakeEglContext();
  throw base::InputError("renderer \"" + std::string(maker) + "\" is not known; it can be osmesa, egl, raster or auto");
}

}  // namespace

std::unique_ptr<CameraRenderer> MakeRenderer(std::string_view maker, const worlds::World& world,
                                             std::span<const Mover> movers) {
  const raster::Kernels* avx2 = raster::Avx2KernelsOrNull();
  if (maker == "auto") maker = avx2 != nullptr ? "raster" : internal::HasOsMesa() ? "osmesa" : "egl";
  if (maker == "raster") {
    return std::make_unique<raster::RasterRenderer>(avx2 != nullptr ? *avx2 : raster::ScalarKernels(), world, movers);
  }
  return std::make_unique<internal::GlRenderer>(MakeContext(maker), world, movers, internal::GlRenderer::Options{});
}

std::unique_ptr<CameraRenderer> MakePlainReference(const worlds::World& world) {
  constexpr internal::GlRenderer::Options kPlain{.cull = false, .levels = false, .shadows = false};
  return std::make_unique<internal::GlRenderer>(internal::MakeOsMesaContext(), world, std::span<const Mover>{}, kPlain);
}

}  // namespace alula::render

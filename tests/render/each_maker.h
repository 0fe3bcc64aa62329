#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <span>

#include "render/camera_renderer.h"

namespace alula::render::test {

/// A test of what every maker must draw, run for GL and for our own rasteriser.
class EachMaker : public testing::TestWithParam<const char*> {
 protected:
  static std::unique_ptr<CameraRenderer> Make(const worlds::World& world, std::span<const Mover> movers = {}) {
    return MakeRenderer(GetParam(), world, movers);
  }
};
inline const auto kEachMaker = testing::Values("osmesa", "raster");

}  // namespace alula::render::test

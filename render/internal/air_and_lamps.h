#pragma once

#include <array>
#include <vector>

#include "render/internal/projection.h"

namespace alula::render::internal {

inline constexpr std::size_t kMostLamps = kMostWorldLamps + kMostViewLamps;  // that a picture can have

/// A lamp as the pixels need it, in world axes: twelve floats, three vec4 of GLSL.
struct LampView {
  std::array<float, 3> position{};  // m
  float inverse_range_squared = 0.0F;
  std::array<float, 3> direction{};  // unit
  float cone_cosine = 0.0F;
  std::array<float, 3> light{};  // at 1 m, by channel (luma in all three places for grey)
  float cone_scale = 0.0F;       // over what lies within the cone, held within [0, 1]
};

/// What a picture has per pixel on top of the light of sun and sky.
struct AirAndLamps {
  std::vector<LampView> lamps;
  float extinction = 0.0F;                        // of the fog, 1/m; 0: none
  float sky_depth = 0.0F;                         // extinction times the layer's height: optical depth of the zenith
  Eigen::Vector3f fog = Eigen::Vector3f::Zero();  // displayed, [0, 1] and brighter (luma in all places for grey)
  bool IsNeeded() const { return extinction > 0.0F || !lamps.empty(); }
};

/// The lamps that reach into the view and the fog. `channels` 1 or 3.
AirAndLamps AirAndLampsOf(const worlds::Light& light, const View& view, int channels);

/// Throws base::InputError for fog and lamps that cannot be, or too many of them.
void CheckLight(const worlds::Light& light);

}  // namespace alula::render::internal

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/camera_renderer.h"
#include "sim/sensors/exposure.h"
#include "stack/interface/measurement.h"

namespace alula::sim {

/// What makes pictures out of exposures: constant for a run, shared by all threads.
struct Optics {
  CameraConfig config;
  stack::CameraIntrinsics intrinsics;
  std::string name;                   // of the sensor; keys the noise
  std::uint64_t seed = 1;             // of the run
  std::vector<base::Transform> X_BP;  // the vehicle's parts, in the order of the renderer's movers
};

/// Draws an exposure and spoils it as the sensor does. Pure: the same arguments give the same bytes, on any thread,
/// because the noise is keyed by (seed, name, seq).
stack::Image TakeImage(const Optics& optics, const Exposure& exposure, render::CameraRenderer& renderer);

/// Puts the vehicle's parts where they are; nothing where the renderer has none.
void PlaceVehicle(const Optics& optics, const base::Transform& X_WB, render::CameraRenderer& renderer);

}  // namespace alula::sim

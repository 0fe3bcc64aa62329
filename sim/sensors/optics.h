#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/camera_renderer.h"
#include "render/image_sensor.h"
#include "render/lens.h"
#include "sim/sensors/exposure.h"
#include "stack/interface/measurement.h"
#include "worlds/world.h"

namespace alula::sim {

/// What makes pictures out of exposures: constant for a run, shared by all threads.
struct Optics {
  CameraConfig config;
  stack::CameraIntrinsics intrinsics;
  std::shared_ptr<const render::Lens> lens;  // of these intrinsics
  std::string name;                          // of the sensor; keys the noise
  std::uint64_t seed = 1;                    // of the run
  std::vector<base::Transform> X_BP;         // the vehicle's parts, in the order of the renderer's movers
  std::shared_ptr<const render::ImageSensor> sensor;
  worlds::Light light;  // of the world: the sun may blind the lens
};
/// `lens`: of these intrinsics; null: one is made. Throws base::InputError as render::Lens and ImageSensor do.
Optics MakeOptics(const CameraConfig& config, const stack::CameraIntrinsics& intrinsics,
                  std::shared_ptr<const render::Lens> lens, std::string name, std::uint64_t seed,
                  std::vector<base::Transform> X_BP, const worlds::Light& light);

/// Draws an exposure and spoils it as the sensor does. Pure: the same arguments give the same bytes, on any thread,
/// because the noise is keyed by (seed, name, seq).
stack::Image TakeImage(const Optics& optics, const Exposure& exposure, render::CameraRenderer& renderer);

/// What makes depth images: the depth camera and, where depth is registered, the colour camera it is carried over to.
struct DepthOptics {
  DepthCameraConfig config;
  stack::CameraIntrinsics intrinsics;                 // its own
  std::optional<stack::CameraIntrinsics> registered;  // the colour camera's
  base::Transform X_CD;                               // pose of the depth camera in the colour camera
  std::string name;
  std::uint64_t seed = 1;
  std::vector<base::Transform>
      X_BP{};  // the vehicle's parts where the renderer has them: seen by none, they cast shadows
};

/// Measures depth at the middle of the exposure. `exposure` speaks of the colour camera. Pure, as TakeImage is.
stack::DepthImage TakeDepth(const DepthOptics& optics, const Exposure& exposure, render::CameraRenderer& renderer);

/// Puts the vehicle's parts, then the links of actors, where they are at an instant; nothing where there are none.
void PlaceMovers(const std::vector<base::Transform>& X_BP, const Instant& at, render::CameraRenderer& renderer);

}  // namespace alula::sim

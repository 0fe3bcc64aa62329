#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/lens.h"
#include "sim/sensors/camera_config.h"
#include "sim/sensors/darkroom.h"
#include "sim/sensors/exposure.h"
#include "sim/sensors/frame_faults.h"
#include "sim/sensors/gimbal.h"
#include "sim/sensors/motion_history.h"
#include "stack/interface/calibration.h"
#include "worlds/actors/actor_simulation.h"
#include "worlds/world.h"

namespace alula::sim {

/// All that takes pictures on one vehicle.
struct CamerasConfig {
  std::optional<StereoCameraConfig> stereo;
  std::vector<NamedCameraConfig> cameras;
  std::vector<RgbdCameraConfig> rgbd;
  std::vector<GimbalConfig> gimbals;
};

/// True where the renderer must have the vehicle's parts as movers.
bool SeesVehicle(const CamerasConfig& config);
bool HasCameras(const CamerasConfig& config);

/// Adds what is true of the cameras and gimbals: ids, names, optics, mounts. Throws base::InputError for a gimbal that
/// is not there and for names used twice.
void AddCameras(const CamerasConfig& config, const std::string& vehicle, stack::Calibration& calibration);

/// One vehicle's cameras: opens each exposure in time, has it drawn when it is over, and hands frames over.
class CameraSuite {
 public:
  /// `X_BP`: the vehicle's parts where SeesVehicle. `renderers` as Darkroom has them. `actors`: of the world; null or
  /// empty: nothing else moves. They are asked where they were up to the last exposure's end.
  CameraSuite(const CamerasConfig& config, const stack::Calibration& calibration, std::uint64_t seed,
              std::vector<base::Transform> X_BP, const worlds::Light& light,
              std::vector<render::CameraRenderer*> renderers, bool threads,
              const worlds::ActorSimulation* actors = nullptr);

  void Settle(base::Time t, const vehicles::BodyState& state);
  void Integrate(base::Time t, const vehicles::BodyState& state, base::Duration dt);
  void Obey(const stack::GimbalSetpoint& setpoint);
  /// As SensorSuite has it.
  void Soil(const std::map<stack::SensorId, render::Dirt>& dirt);

  /// A frame on its way to the stack; its picture is fetched when it arrives.
  struct Frame {
    stack::Measurement measurement;  // without data
    std::size_t camera = 0;
    std::shared_ptr<Darkroom::Print> print;  // null: frozen, the picture before once more
    ExposureSetting setting;
  };
  /// Follows the true motion to the end of the window; gives the frames whose exposure is over.
  std::vector<Frame> Measure(const TruthWindow& truth);
  /// Fills in the picture. Frames of one camera must be delivered in the order in which they become available.
  void Deliver(Frame& frame);
  /// The encoder readings that fall due up to now.
  std::vector<stack::Measurement> ReadGimbals(base::Time now);

  double wall_ms() const { return darkroom_.wall_ms(); }

 private:
  struct Clock {
    base::Rate rate;
    std::int64_t n = 0;
  };
  struct Opened {
    std::uint32_t seq = 0;
    base::Time captured;  // as the stamp says
    ExposureSetting setting;
  };
  using Take = std::function<Developed(const Exposure&, render::CameraRenderer&)>;
  struct Unit {
    CameraConfig config;
    stack::CameraCalibration calibration;
    Take take;
    std::shared_ptr<const render::Lens> lens;  // null: of a depth camera
    render::Dirt dirt;                         // on it now
    base::Transform X_MC;
    std::optional<std::size_t> gimbal;
    std::size_t exposure = 0;  // which control it obeys
    bool meters = false;       // its pictures steer that control
    base::Duration late{};     // of the eye: the light is that of captured + late …
    int late_every = 1;        // … in every n-th frame
    FrameFaults faults;
    Clock clock;
    std::deque<Opened> opened;
    std::optional<Developed> last;
  };

  void AddUnit(const CameraConfig& config, const stack::CameraCalibration& calibration,
               std::shared_ptr<const render::Lens> lens, const base::Transform& X_MC);
  /// The depth camera of the colour camera that was added last.
  void AddDepthUnit(const RgbdCameraConfig& config, const stack::CameraCalibration& calibration);
  /// What makes an image camera's pictures.
  Take TakeOf(const CameraConfig& config, const stack::CameraCalibration& calibration,
              std::shared_ptr<const render::Lens> lens) const;
  Instant At(const Unit& unit, base::Time t) const;
  void Open(Unit& unit, base::Time now);
  bool IsOver(const Unit& unit, const Opened& opened, base::Time now) const;
  std::optional<Frame> Close(std::size_t number, const Opened& opened);
  Exposure Plan(const Unit& unit, const Opened& opened, base::Time middle) const;

  std::uint64_t seed_;
  std::vector<base::Transform> X_BP_;
  worlds::Light light_;
  const worlds::ActorSimulation* actors_;
  std::vector<Unit> units_;
  std::vector<ExposureControl> exposures_;
  std::vector<Gimbal> gimbals_;
  std::vector<GimbalConfig> gimbal_configs_;
  std::vector<stack::GimbalCalibration> gimbal_calibrations_;
  std::vector<Clock> gimbal_clocks_;
  MotionHistory motion_;
  Darkroom darkroom_;
};

}  // namespace alula::sim

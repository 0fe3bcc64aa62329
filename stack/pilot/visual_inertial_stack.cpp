#include "stack/pilot/visual_inertial_stack.h"

#include <array>
#include <chrono>
#include <optional>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "stack/estimation/imu_propagator.h"
#include "stack/mapping/map_file.h"
#include "stack/pilot/job_queue.h"
#include "stack/slam/frame_assembler.h"

namespace alula::stack::pilot {

using base::Time;
using base::Transform;
using base::Vec3;

namespace {

constexpr base::Duration kControlPeriod = base::Milliseconds(5);  // of the mission's decisions
constexpr base::Duration kNotePeriod = base::Milliseconds(1000);  // between two reports of degraded odometry
constexpr double kColumnReserve = 0.5;                            // m above the take-off height that is declared free
constexpr double kOpeningSigma = 0.1;                             // m; a gate known this well tells what its opening is
constexpr double kOpeningDepth = 0.3;                             // m to each side of the plane declared free
constexpr double kOpeningMargin = 0.15;                           // m kept from the bars

/// Wall time of the parts of a mapping job, ms; for profiling only.
struct MapTiming {
  std::array<double, 4> ms{};  // depth, insert, gates, snapshot
};
constexpr std::array<const char*, 4> kMapParts{"mapping/depth", "mapping/insert", "mapping/gates", "mapping/snapshot"};

struct MapResult {
  MapTiming timing;

  std::shared_ptr<const mapping::ClearanceField> field;
  std::vector<std::optional<perception::GateObservation>> gates;
  std::vector<Eigen::Vector3f> occupied_O;
};

struct OdometryOutput {
  estimation::FrameResult frame;
  estimation::OdometryTiming timing;
};

/// The slow parts with their state. Each is touched by the jobs of one strand only.
struct Workshop {
  Workshop(const Calibration& calibration, const Mission& mission, const VisualInertialConfig& config)
      : odometry(calibration, config.odometry, mission.X_WB_start),
        depth(calibration, config.depth),
        map(config.map, mission.bounds_low - Vec3::Constant(config.map_margin),
            mission.bounds_high + Vec3::Constant(config.map_margin)),
        gates(mission.gates, config.gate_finder),
        planner(planning::MakeInformedRrtStarPlanner(config.route.planner)) {
    const Vec3 ground = mission.X_WB_start.p - Vec3(0, 0, calibration.standing_height);
    map.DeclareFree(ground, mission.takeoff_column_radius, config.mission.takeoff_height + kColumnReserve);
  }

  MapResult Map(const Image& left, const Image& right, const Transform& X_OB, const Transform& X_MO) {
    MapResult result;
    auto last = std::chrono::steady_clock::now();
    const auto lap = [&](std::size_t part) {
      const auto time = std::chrono::steady_clock::now();
      result.timing.ms[part] = std::chrono::duration<double, std::milli>(time - last).count();
      last = time;
    };
    const mapping::DepthMap view = depth.Compute(left, right);
    lap(0);
    const Transform X_OC = X_OB * view.X_BC;
    map.Insert(view, X_OC);
    lap(1);
    gates.Add(view, X_OC, X_MO);
    for (int i = 0; i < gates.size(); ++i) {
      result.gates.push_back(gates.Best(i));
      const auto& gate = result.gates.back();
      if (!gate || gate->position_sigma > kOpeningSigma) continue;
      const double half = 0.5 * gate->opening - kOpeningMargin;
      if (half > 0.0) map.DeclareFreeBox(gate->X_OG, Vec3(kOpeningDepth, half, half));
    }
    lap(2);
    result.field = map.Snapshot();
    result.occupied_O = map.OccupiedCells();
    lap(3);
    return result;
  }

  estimation::Odometry odometry;  // strand "odometry"
  mapping::StereoDepth depth;     // strand "mapping", as the next two
  mapping::OccupancyMap map;
  perception::GateFinder gates;
  std::unique_ptr<planning::GlobalPlanner> planner;  // strand "planning"
};

class VisualInertialStack : public NavigationStack {
 public:
  VisualInertialStack(const Calibration& calibration, const Mission& mission, const VisualInertialConfig& config,
                      std::uint64_t seed, int workers)
      : calibration_(calibration),
        config_(config),
        workshop_(calibration, mission, config),
        propagator_(calibration),
        frames_(calibration),
        watch_(config.watch),
        mission_(calibration, mission, config.mission, config.route, config.alignment, config.latency.planning, seed),
        jobs_(workers) {}

  StackOutput Step(Time now, std::span<const Measurement> measurements) override {
    StackOutput output;
    out_ = &output;
    for (const Measurement& measurement : measurements) Take(measurement);
    jobs_.Join(now);
    StartOdometry(now);
    if (now >= next_control_) {
      next_control_ = now + kControlPeriod;
      Control(now);
    }
    output.state = mission_.state();
    output.next_gate = mission_.next_gate();
    output.view = view_;
    out_ = nullptr;
    return output;
  }

  bool SetComputeFactor(double factor) override {
    jobs_.Stretch(factor);
    return true;
  }

  std::vector<StageTime> Timing() const override {
    std::vector<StageTime> stages = jobs_.Timing();
    const auto part = [&](const char* name, double ms) {
      stages.push_back({.name = name, .wall_ms = ms, .calls = timing_.frames});
    };
    for (std::size_t i = 0; i < kMapParts.size(); ++i) {
      stages.push_back({.name = kMapParts[i], .wall_ms = map_timing_.ms[i], .calls = maps_});
    }
    part("odometry/track", timing_.track);
    part("odometry/detect", timing_.detect);
    part("odometry/solve", timing_.solve);
    part("odometry/covariance", timing_.covariance);
    part("odometry/marginalise", timing_.marginalise);
    return stages;
  }

  /// The map as the mission knew it last, in the odometry frame.
  std::vector<StackFile> Files() const override {
    if (!field_) return {};
    std::ostringstream map;
    mapping::WriteOctoMap(*field_, map);
    return {{"map.bt", map.str()}};
  }

 private:
  void Take(const Measurement& measurement) {
    if (const auto* imu = std::get_if<ImuSample>(&measurement.data)) {
      if (measurement.sensor != calibration_.imu->sensor) return;
      if (!watch_.Accept(measurement.captured, *imu, Flying())) return;
      propagator_.AddImu({measurement.captured, imu->angular_velocity, imu->specific_force});
      frames_.Add(measurement);
    } else if (const auto* image = std::get_if<Image>(&measurement.data)) {
      if (!frames_.IsEye(measurement.sensor)) return;
      if (watch_.Accept(measurement.sensor, *image, Flying())) frames_.Add(measurement);
    } else if (const auto* status = std::get_if<VehicleStatus>(&measurement.data)) {
      status_ = *status;
    }
  }

  bool Flying() const { return status_ && !status_->landed; }

  /// Whole pairs go to the odometry, oldest first; one that finds it busy is left out.
  void StartOdometry(Time now) {
    while (const std::optional<estimation::FrameInput> next = frames_.Next()) {
      const auto input = std::make_shared<const estimation::FrameInput>(*next);
      const bool started = jobs_.Start(
          "odometry", "odometry", now, config_.latency.odometry,
          [this, input] {
            return OdometryOutput{workshop_.odometry.Process(*input), workshop_.odometry.Timing()};
          },
          [this, due = jobs_.Due(now, config_.latency.odometry), input](OdometryOutput result) {
            OnFrame(due, *input, result);
          });
      if (started) frames_.Consume(*input);
    }
  }

  void OnFrame(Time now, const estimation::FrameInput& pair, OdometryOutput& output) {
    const estimation::FrameResult& frame = output.frame;
    timing_ = output.timing;
    propagator_.Correct(frame);
    ReportOdometry(now, frame);
    initialised_ = frame.initialised;
    if (initialised_) watch_.NoteFrame(frame.state.stamp);
    if (initialised_ && frame.seq % static_cast<std::uint32_t>(config_.depth_every) == 0) {
      jobs_.Start(
          "mapping", "mapping", now, config_.latency.mapping,
          [this, left = pair.left, right = pair.right, X_OB = frame.state.X_OB, X_MO = mission_.X_MO()] {
            return workshop_.Map(left, right, X_OB, X_MO);
          },
          [this](MapResult result) {
            field_ = result.field;
            mission_.OnMap(result.field, result.gates);
            occupied_O_ = std::move(result.occupied_O);
            for (std::size_t i = 0; i < kMapParts.size(); ++i) map_timing_.ms[i] += result.timing.ms[i];
            ++maps_;
          });
    }
    auto view = std::make_shared<StackView>();
    view->image_seq = frame.seq;
    view->features = frame.features;
    view->path_O = mission_.path_O();
    view->occupied_O = occupied_O_;
    view->cell = config_.map.cell;
    view->gates_O = mission_.gates_O();
    view->X_MO = mission_.X_MO();
    view_ = std::move(view);
  }

  void ReportOdometry(Time now, const estimation::FrameResult& frame) {
    const auto say = [&](const char* kind, const std::string& text) { out_->events.push_back({now, kind, text}); };
    if (frame.initialised && !ever_initialised_) say("odometry_initialised", "stood still long enough");
    if (ever_initialised_ && frame.reset_counter != reset_counter_) say("odometry_reset", frame.note);
    ever_initialised_ = ever_initialised_ || frame.initialised;
    reset_counter_ = frame.reset_counter;
    if (frame.note.empty() || frame.note == last_note_ || now < next_note_) return;
    last_note_ = frame.note;
    next_note_ = now + kNotePeriod;
    say("odometry_note", frame.note);
  }

  void Control(Time now) {
    const std::optional<Estimate> estimate = propagator_.At(now);
    MissionInput input;
    input.now = now;
    input.initialised = initialised_ && estimate.has_value();
    input.healthy = input.initialised && watch_.Trusted(now);
    if (estimate) {
      input.X_OB = estimate->X_OB;
      input.v_OB = estimate->v_OB;
    }
    if (status_) input.status = *status_;
    input.status_known = status_.has_value();
    MissionOutput decided = mission_.Update(input);
    for (Command& command : decided.commands) out_->commands.push_back(std::move(command));
    for (StackEvent& event : decided.events) out_->events.push_back(std::move(event));
    if (decided.request) {
      jobs_.Start(
          "planning", "planning", now, config_.latency.planning,
          [this, request = std::move(*decided.request)] {
            return planning::PlanRoute(request, config_.route, *workshop_.planner);
          },
          [this](planning::RouteResult result) { mission_.OnRoute(std::move(result)); });
    }
    if (input.healthy && now >= next_estimate_) {
      next_estimate_ = now + config_.estimate_period;
      out_->estimate = estimate;
      if (config_.publish_alignment) out_->estimate->X_MO = mission_.X_MO();
    }
  }

  Calibration calibration_;
  VisualInertialConfig config_;
  Workshop workshop_;
  estimation::ImuPropagator propagator_;
  slam::FrameAssembler frames_;
  SensorWatch watch_;
  GateMission mission_;

  StackOutput* out_ = nullptr;  // during Step
  std::optional<VehicleStatus> status_;
  Time next_control_, next_estimate_, next_note_;
  bool initialised_ = false, ever_initialised_ = false;
  std::uint32_t reset_counter_ = 0;
  std::string last_note_;
  std::shared_ptr<const mapping::ClearanceField> field_;
  std::vector<Eigen::Vector3f> occupied_O_;
  std::shared_ptr<const StackView> view_;
  estimation::OdometryTiming timing_;
  MapTiming map_timing_;
  std::uint64_t maps_ = 0;

  JobQueue jobs_;  // last: its jobs use all of the above
};

}  // namespace

void Describe(base::Description& d, DeclaredLatencies& c) {
  d.Field("odometry", c.odometry, {.unit = "s", .meaning = "a stereo pair through the odometry"});
  d.Field("mapping", c.mapping, {.unit = "s", .meaning = "depth, map and gates of a stereo pair"});
  d.Field("planning", c.planning, {.unit = "s", .meaning = "a route"});
}

void Describe(base::Description& d, VisualInertialConfig& c) {
  d.Field("odometry", c.odometry, {.meaning = "stereo-inertial odometry"});
  d.Field("depth", c.depth, {.meaning = "dense stereo"});
  d.Field("map", c.map, {.meaning = "occupancy"});
  d.Field("gate_finder", c.gate_finder, {.meaning = "measures gates in depth maps"});
  d.Field("route", c.route, {.meaning = "planning"});
  d.Field("alignment", c.alignment, {.meaning = "map frame from measured gates"});
  d.Field("mission", c.mission, {.meaning = "what is flown when"});
  d.Field("watch", c.watch, {.meaning = "sensors that fall silent or are stuck"});
  d.Field("latency", c.latency, {.meaning = "declared compute times"});
  d.Field("depth_every", c.depth_every,
          {.meaning = "every this many-th stereo pair goes into the map", .min = 1, .max = 1000});
  d.Field("estimate_period", c.estimate_period, {.unit = "s", .meaning = "between estimates sent to the autopilot"});
  d.Field("map_margin", c.map_margin,
          {.unit = "m", .meaning = "of map around the mission's bounds", .min = 0, .max = 50});
  d.Field("publish_alignment", c.publish_alignment,
          {.meaning = "send the map frame as the gates suggest it (it jumps), instead of identity"});
}

std::unique_ptr<NavigationStack> MakeVisualInertialStack(const Calibration& calibration, const Mission& mission,
                                                         const VisualInertialConfig& config, std::uint64_t seed,
                                                         int workers) {
  if (!calibration.stereo) throw base::InputError("the visual-inertial stack needs a stereo pair of cameras");
  if (!calibration.imu) throw base::InputError("the visual-inertial stack needs an IMU");
  return std::make_unique<VisualInertialStack>(calibration, mission, config, seed, workers);
}

}  // namespace alula::stack::pilot

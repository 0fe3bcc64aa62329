#include "stack/pilot/slam_stack.h"

#include <optional>
#include <utility>

#include "stack/estimation/imu_propagator.h"
#include "stack/pilot/job_queue.h"
#include "stack/slam/frame_assembler.h"
#include "stack/slam/slam.h"

namespace alula::stack::pilot {
namespace {

using base::Time;

class SlamStack final : public NavigationStack {
 public:
  SlamStack(const Calibration& calibration, const Mission& mission, const SlamStackConfig& config, int workers)
      : calibration_(calibration),
        config_(config),
        slam_(calibration, config.slam, mission.X_WB_start),
        frames_(calibration),
        propagator_(calibration),
        jobs_(workers) {}

  StackOutput Step(Time now, std::span<const Measurement> measurements) override {
    StackOutput output;
    for (const Measurement& measurement : measurements) Take(measurement);
    jobs_.Join(now);
    Start(now);
    Publish(now, output);
    output.events = std::move(events_);
    events_.clear();
    output.state = ever_initialised_ ? StackState::kReady : StackState::kInitialising;
    output.view = view_;
    return output;
  }

  bool SetComputeFactor(double factor) override {
    jobs_.Stretch(factor);
    return true;
  }
  std::vector<StageTime> Timing() const override { return jobs_.Timing(); }

 private:
  void Take(const Measurement& measurement) {
    frames_.Add(measurement);
    const auto* imu = std::get_if<ImuSample>(&measurement.data);
    if (imu != nullptr && measurement.sensor == calibration_.imu->sensor)
      propagator_.AddImu({measurement.captured, imu->angular_velocity, imu->specific_force});
  }

  void Start(Time now) {
    while (const std::optional<estimation::FrameInput> next = frames_.Next()) {
      const auto frame = std::make_shared<const estimation::FrameInput>(*next);
      const bool started = jobs_.Start(
          "slam", "slam", now, config_.latency, [this, frame] { return slam_.Process(*frame); },
          [this, due = jobs_.Due(now, config_.latency)](slam::SlamResult result) { OnFrame(due, result); });
      if (started) frames_.Consume(*frame);
    }
  }

  void OnFrame(Time now, const slam::SlamResult& result) {
    const estimation::FrameResult& frame = result.odometry;
    propagator_.Correct(frame);
    X_MO_ = result.X_MO;
    if (frame.initialised && !ever_initialised_)
      events_.push_back({now, "odometry_initialised", "it knows where it is"});
    if (ever_initialised_ && frame.reset_counter != reset_counter_)
      events_.push_back({now, "odometry_reset", frame.note});
    initialised_ = frame.initialised;
    ever_initialised_ = ever_initialised_ || frame.initialised;
    reset_counter_ = frame.reset_counter;
    auto view = std::make_shared<StackView>();
    view->image_seq = frame.seq;
    view->features = frame.features;
    view->X_MO = X_MO_;
    view_ = std::move(view);
  }

  void Publish(Time now, StackOutput& output) {
    if (!initialised_ || now < next_estimate_) return;
    next_estimate_ = now + config_.estimate_period;
    output.estimate = propagator_.At(now);
    if (output.estimate) output.estimate->X_MO = X_MO_;
  }

  Calibration calibration_;
  SlamStackConfig config_;
  slam::Slam slam_;  // strand "slam"
  slam::FrameAssembler frames_;
  estimation::ImuPropagator propagator_;
  std::vector<StackEvent> events_;
  std::shared_ptr<const StackView> view_;
  base::Transform X_MO_;
  Time next_estimate_;
  bool initialised_ = false, ever_initialised_ = false;
  std::uint32_t reset_counter_ = 0;
  JobQueue jobs_;  // last: its threads end first
};

}  // namespace

void Describe(base::Description& d, SlamStackConfig& c) {
  Describe(d, c.slam);
  d.Field("latency", c.latency, {.unit = "s", .meaning = "declared compute time of a frame"});
  d.Field("estimate_period", c.estimate_period, {.unit = "s", .meaning = "between published estimates"});
}

std::unique_ptr<NavigationStack> MakeSlamStack(const Calibration& calibration, const Mission& mission,
                                               const SlamStackConfig& config, int workers) {
  return std::make_unique<SlamStack>(calibration, mission, config, workers);
}

}  // namespace alula::stack::pilot

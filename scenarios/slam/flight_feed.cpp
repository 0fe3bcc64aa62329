#include "scenarios/slam/flight_feed.h"

#include <optional>
#include <utility>

#include "stack/slam/frame_assembler.h"

namespace alula::scenarios::slam {
namespace {

constexpr base::Rate kTruthRate{200, 1};

class Feeder final : public stack::NavigationStack {
 public:
  Feeder(std::shared_ptr<FlightFeed> feed, const stack::Calibration& calibration, const stack::Mission& mission)
      : feed_(std::move(feed)), frames_(calibration) {
    for (const Variant& variant : feed_->variants) feed_->runs.emplace_back(variant, calibration, mission.X_WB_start);
  }

  stack::StackOutput Step(base::Time, std::span<const stack::Measurement> measurements) override {
    for (const stack::Measurement& measurement : measurements) frames_.Add(measurement);
    while (const std::optional<stack::estimation::FrameInput> frame = frames_.Next()) {
      for (EstimatorRun& run : feed_->runs) run.Feed(*frame);
      frames_.Consume(*frame);
    }
    return {};
  }

 private:
  std::shared_ptr<FlightFeed> feed_;
  stack::slam::FrameAssembler frames_;
};

class TruthNotes final : public Spectator {
 public:
  explicit TruthNotes(std::shared_ptr<FlightFeed> feed) : feed_(std::move(feed)) {}

  std::optional<std::string> Observe(const sim::StepView& step) override {
    for (; kTruthRate.SampleTime(count_) <= step.time; ++count_) {
      const base::Time time = kTruthRate.SampleTime(count_);
      feed_->truth.push_back({time, step.truth.At(time).X_WB});
    }
    return std::nullopt;
  }
  void Finish() override {}

 private:
  std::shared_ptr<FlightFeed> feed_;
  std::int64_t count_ = 0;
};

}  // namespace

StackMaker FeedEstimators(std::shared_ptr<FlightFeed> feed) {
  return [feed = std::move(feed)](const stack::Calibration& calibration, const stack::Mission& mission, std::uint64_t,
                                  int) { return std::make_unique<Feeder>(feed, calibration, mission); };
}

SpectatorMaker NoteTruth(std::shared_ptr<FlightFeed> feed) {
  return [feed = std::move(feed)](const Stage&) { return std::make_unique<TruthNotes>(feed); };
}

}  // namespace alula::scenarios::slam

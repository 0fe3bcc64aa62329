#include "scenarios/replay/flight.h"

#include <memory>
#include <utility>

namespace alula::scenarios::replay {
namespace {

constexpr const char* kStopped = "seen_enough";

/// Keeps the steps of the present interval.
class Tap : public Spectator {
 public:
  Tap(const stack::Calibration& calibration, const StopRule& stop, Flight& flight) : stop_(stop), flight_(flight) {
    flight.last.sensors = NamesOf(calibration);
  }

  /// The run's own digest looks before any spectator does: where an interval ends here, its row is there already.
  std::optional<std::string> Observe(const sim::StepView& step) override {
    flight_.last.steps.push_back(Keep(step, number_++));
    if (flight_.rows.size() == rows_) return std::nullopt;
    rows_ = flight_.rows.size();
    if (stop_(flight_.rows)) return kStopped;
    flight_.last.steps.clear();
    return std::nullopt;
  }
  void Finish() override {}

 private:
  const StopRule& stop_;
  Flight& flight_;
  std::int64_t number_ = 0;
  std::size_t rows_ = 0;
};

}  // namespace

Flight FlyAgain(const RunCase& run, base::Duration interval, const StopRule& stop) {
  Flight flight;
  Scenario scenario = run.scenario;
  scenario.config.recorder.digest_interval = interval;
  RunOptions options = run.options;
  options.out.reset();
  options.interval_digest = [&flight](const sim::DigestRow& row) { flight.rows.push_back(row); };
  options.spectators = {
      [&](const Stage& stage) { return std::make_unique<Tap>(stage.calibration, stop, flight); },
  };
  const Verdict verdict = RunScenario(scenario, options);
  flight.complete = verdict.reason != kStopped;
  flight.last.end = verdict.reason;
  flight.digest = verdict.digest;
  flight.numeric_class = verdict.numeric_class;
  return flight;
}

}  // namespace alula::scenarios::replay

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "base/describe.h"
#include "sim/observer.h"
#include "sim/run_folder.h"

namespace alula::sim {

struct RecorderConfig {
  base::Rate truth_rate{100, 1};
  base::Rate estimate_rate{100, 1};  // at most; a slower stack is recorded as it publishes
  base::Rate telemetry_rate{50, 1};
  base::Rate actors_rate{10, 1};
  base::Duration digest_interval = base::Seconds(1.0);  // of digests.csv
};
void Describe(base::Description& d, RecorderConfig& c);

/// One line of events.jsonl, its end of line included; `source` as "run" or "stack".
std::string EventLine(base::Time time, std::string_view source, std::string_view kind, std::string_view text);

/// Streams a run to disk with bounded memory:
///   truth.tum      time x y z qx qy qz qw of X_WB, world frame
///   estimate.tum   the same of X_MB = X_MO X_OB as published at each time
///   events.jsonl   what the stack, the autopilot (modes), the world (contacts) and faults (their begin and end) say
///   telemetry.csv  one line a sample, units in the header
class Recorder : public Observer {
 public:
  Recorder(const RecorderConfig& config, const RunFolder& folder);

  std::optional<std::string> Observe(const StepView& step) override;
  void AddEvent(base::Time time, std::string_view source, std::string_view kind, std::string_view text);
  /// Closes the files.
  void Finish();

 private:
  struct Clock {
    base::Rate rate;
    std::int64_t n = 0;
    bool Passes(base::Time now);
  };
  void RecordEvents(const StepView& step);
  void RecordTelemetry(const StepView& step);

  StreamFile truth_, estimate_, events_, telemetry_;
  Clock truth_clock_, estimate_clock_, telemetry_clock_;
  bool telemetry_header_ = false;
  base::Time last_estimate_{-1};
  stack::VehicleStatus last_status_;
  std::map<std::pair<std::string_view, std::string_view>, base::Time> touched_;  // when last
  std::string line_;
};

}  // namespace alula::sim

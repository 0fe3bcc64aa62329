#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "stack/interface/command.h"
#include "stack/interface/measurement.h"

namespace alula::stack {

/// What the stack knows of the vehicle's motion. The odometry frame O never jumps; the map frame M (the mission's
/// world) may: X_MO moves instead.
struct Estimate {
  base::Time stamp;  // the instant that the estimate describes
  base::Transform X_OB;
  base::Vec3 v_OB = base::Vec3::Zero();
  base::Vec3 w_B = base::Vec3::Zero();              // rad/s, bias-corrected
  base::Mat6 pose_covariance = base::Mat6::Zero();  // of (δp in O, δθ in B), m², rad²
  base::Mat3 velocity_covariance = base::Mat3::Zero();
  base::Transform X_MO;
  std::uint32_t reset_counter = 0;  // grows when X_OB was re-initialised
};

/// A discrete happening, for events.jsonl: a short snake_case kind and a sentence.
struct StackEvent {
  base::Time time;
  std::string kind;
  std::string text;
};

/// A tracked feature of the left camera's last image; for pictures only.
struct FeatureView {
  float u = 0, v = 0;  // px
  float depth = 0;     // m, 0 where unknown
  int age = 0;         // frames tracked
};

/// What a stack shows of its inside, for pictures and recordings; nothing in the loop reads it.
struct StackView {
  std::uint32_t image_seq = 0;
  std::vector<FeatureView> features;
  std::vector<base::Vec3> path_O;           // what is being flown, m
  std::vector<Eigen::Vector3f> occupied_O;  // centres of occupied cells
  double cell = 0.0;                        // their size, m
  std::vector<base::Transform> gates_O;     // gates as measured so far
  base::Transform X_MO;
};

enum class StackState : std::uint8_t { kInitialising, kReady, kFlying, kDone, kFailed };

/// Time spent in one stage of a run; it is reported and never enters a digest.
struct StageTime {
  std::string name;
  double wall_ms = 0.0;  // in total
  std::uint64_t calls = 0;
  double p99_ms = 0.0;  // processor time of a call, 99th percentile; 0 where calls are not told apart
};

/// A file that a stack leaves in the run folder: a map, a graph.
struct StackFile {
  std::string name;  // a plain file name
  std::string bytes;
};

struct StackOutput {
  std::vector<Command> commands;
  std::optional<Estimate> estimate;
  std::vector<StackEvent> events;
  StackState state = StackState::kInitialising;
  int next_gate = 0;  // index into the mission's gates
  std::shared_ptr<const StackView>
      view;  // the same pointer until something changed; null where there is nothing to show
};

/// The software under test. It sees measurements, calibration and mission; never the truth. `Step` is called once per
/// physics step with all that has become available, in the order of ArrivesBefore. It is deterministic, has no global
/// state and reads no clock that could affect its result.
class NavigationStack {
 public:
  virtual ~NavigationStack() = default;
  virtual StackOutput Step(base::Time now, std::span<const Measurement> measurements) = 0;
  /// From now on the computer under the stack takes `factor` times as long as declared (1: as declared). This is the
  /// machine, not news from it: a stack stretches the latencies of work that it begins from here on and decides nothing
  /// by it. False: this stack declares no latencies, so nothing grows.
  virtual bool SetComputeFactor(double) { return false; }
  /// Wall time spent so far, by stage; for timing.json.
  virtual std::vector<StageTime> Timing() const { return {}; }
  /// What the stack has made of the run so far; asked for once, after the last Step.
  virtual std::vector<StackFile> Files() const { return {}; }
};

}  // namespace alula::stack

#pragma once

#include <string>
#include <vector>

#include "sim/observer.h"
#include "sim/run_folder.h"

namespace alula::sim {

/// Writes actors.csv: time_s, name of the link ("person0/head"), its position (m) and attitude (quaternion) in the
/// world, for every link that can be hit. world.json has the links' shapes.
class ActorRecorder : public Observer {
 public:
  /// The world must outlive it. Throws base::FaultError("disk").
  ActorRecorder(base::Rate rate, const worlds::World& world, const RunFolder& folder);

  std::optional<std::string> Observe(const StepView& step) override;
  void Finish() { file_.Close(); }

 private:
  base::Rate rate_;
  const worlds::World& world_;
  StreamFile file_;
  std::int64_t n_ = 0;
  std::string lines_;
  std::vector<base::Transform> X_WL_;
};

}  // namespace alula::sim

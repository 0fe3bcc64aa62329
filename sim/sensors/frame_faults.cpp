#include "sim/sensors/frame_faults.h"

namespace alula::sim {

FrameFate FrameFaults::Next() {
  const double drop = stream_.Uniform(), late = stream_.Uniform(), by = stream_.Uniform(), freeze = stream_.Uniform();
  if (frozen_ == 0 && freeze < config_.freeze) frozen_ = config_.freeze_frames;
  FrameFate fate;
  fate.frozen = frozen_ > 0;
  if (fate.frozen) --frozen_;
  fate.dropped = drop < config_.drop;
  if (late < config_.late) fate.late_by = base::Seconds(by * config_.late_by.Seconds());
  return fate;
}

}  // namespace alula::sim

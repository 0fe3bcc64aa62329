#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "base/describe.h"
#include "base/time.h"
#include "stack/interface/measurement.h"

namespace alula::stack::pilot {

struct SensorWatchConfig {
  base::Duration frame_timeout = base::Milliseconds(1000);  // the odometry without a new frame for so long is lost …
  base::Duration imu_timeout = base::Milliseconds(100);     // … and without inertial samples for so long
  int imu_repeats = 10;                                     // equal samples in a row: the sensor is stuck
};
void Describe(base::Description& d, SensorWatchConfig& c);

/// Judges by what arrives whether the odometry may be trusted. Odometry that is fed nothing says nothing: its last
/// state, carried on by the IMU, looks healthy for as long as one likes. Noise never repeats itself in flight, so a
/// sensor that does is stuck, and what it says counts as silence.
class SensorWatch {
 public:
  explicit SensorWatch(const SensorWatchConfig& config) : config_(config) {}

  /// False: the sensor is stuck; the sample is to be dropped. `flying`: on the ground a sample may repeat itself.
  bool Accept(base::Time captured, const ImuSample& sample, bool flying);
  bool Accept(SensorId camera, const Image& image, bool flying);
  /// The odometry has taken in the frame of this stamp.
  void NoteFrame(base::Time stamp) { last_frame_ = stamp; }
  /// Neither frames nor inertial samples have been missing for long.
  bool Trusted(base::Time now) const;

 private:
  SensorWatchConfig config_;
  std::optional<ImuSample> last_sample_;
  int repeats_ = 0;
  std::optional<base::Time> last_imu_, last_frame_;
  std::map<SensorId, std::shared_ptr<const std::vector<std::uint8_t>>> last_bytes_;
};

}  // namespace alula::stack::pilot

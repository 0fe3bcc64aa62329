#include "stack/pilot/sensor_watch.h"

namespace alula::stack::pilot {

void Describe(base::Description& d, SensorWatchConfig& c) {
  d.Field("frame_timeout", c.frame_timeout,
          {.unit = "s", .meaning = "without a new frame for so long the odometry is lost", .min = 1e-3});
  d.Field("imu_timeout", c.imu_timeout,
          {.unit = "s", .meaning = "without an inertial sample for so long the odometry is lost", .min = 1e-3});
  d.Field(
      "imu_repeats", c.imu_repeats,
      {.meaning = "equal inertial samples in a row, in flight, of a sensor that is stuck", .min = 2, .max = 1000000});
}

bool SensorWatch::Accept(base::Time captured, const ImuSample& sample, bool flying) {
  const bool equal = last_sample_ && last_sample_->angular_velocity == sample.angular_velocity &&
                     last_sample_->specific_force == sample.specific_force;
  repeats_ = equal && flying ? repeats_ + 1 : 0;
  last_sample_ = sample;
  if (repeats_ >= config_.imu_repeats) return false;
  if (!last_imu_ || captured > *last_imu_) last_imu_ = captured;
  return true;
}

bool SensorWatch::Accept(SensorId camera, const Image& image, bool flying) {
  auto& last = last_bytes_[camera];
  const bool equal = last != nullptr && (last == image.bytes || *last == *image.bytes);
  last = image.bytes;
  return !equal || !flying;
}

bool SensorWatch::Trusted(base::Time now) const {
  return last_imu_ && now - *last_imu_ <= config_.imu_timeout && last_frame_ &&
         now - *last_frame_ <= config_.frame_timeout;
}

}  // namespace alula::stack::pilot

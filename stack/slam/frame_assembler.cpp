#include "stack/slam/frame_assembler.h"

#include <utility>

#include "base/error.h"

namespace alula::stack::slam {
namespace {

constexpr std::size_t kPairsWaiting = 8;  // that may wait for their second eye

}  // namespace

FrameAssembler::FrameAssembler(const Calibration& calibration) {
  if (!calibration.stereo) throw base::InputError("calibration: no stereo pair of cameras");
  if (!calibration.imu) throw base::InputError("calibration: no IMU");
  left_ = calibration.cameras.at(static_cast<std::size_t>((*calibration.stereo)[0]));
  right_ = calibration.cameras.at(static_cast<std::size_t>((*calibration.stereo)[1]));
  imu_sensor_ = calibration.imu->sensor;
}

void FrameAssembler::Add(const Measurement& measurement) {
  if (const auto* imu = std::get_if<ImuSample>(&measurement.data)) {
    if (measurement.sensor == imu_sensor_)
      imu_.push_back({measurement.captured, imu->angular_velocity, imu->specific_force});
    return;
  }
  const auto* image = std::get_if<Image>(&measurement.data);
  if (image == nullptr || !IsEye(measurement.sensor)) return;
  Pair& pair = pairs_[measurement.seq];
  if (measurement.sensor == left_.sensor) {
    pair.left = *image;
    pair.stamp = measurement.captured + left_.time_offset;
  } else {
    pair.right = *image;
  }
  while (pairs_.size() > kPairsWaiting) pairs_.erase(pairs_.begin());
}

std::optional<estimation::FrameInput> FrameAssembler::Next() {
  while (!pairs_.empty()) {
    const auto& [seq, pair] = *pairs_.begin();
    if (!pair.left || !pair.right) {
      const Pair& newest = pairs_.rbegin()->second;
      if (pairs_.size() < 2 || !newest.left || !newest.right) return std::nullopt;
      pairs_.erase(pairs_.begin());
      continue;
    }
    if (imu_.empty() || imu_.back().time < pair.stamp) return std::nullopt;
    estimation::FrameInput frame{seq, pair.stamp, *pair.left, *pair.right, {}};
    for (const estimation::TimedImu& sample : imu_) {
      frame.imu.push_back(sample);
      if (sample.time >= pair.stamp) break;
    }
    pairs_.erase(pairs_.begin());
    return frame;
  }
  return std::nullopt;
}

void FrameAssembler::Consume(const estimation::FrameInput& frame) {
  imu_.erase(imu_.begin(), imu_.begin() + static_cast<std::ptrdiff_t>(frame.imu.size()));
}

}  // namespace alula::stack::slam

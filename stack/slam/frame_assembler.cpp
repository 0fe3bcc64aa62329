#include "stack/slam/frame_assembler.h"

#include <utility>

#include "stack/interface/grey.h"

namespace alula::stack::slam {
namespace {

constexpr std::size_t kFramesWaiting = 8;  // that may wait for their missing parts

}  // namespace

FrameAssembler::FrameAssembler(const Calibration& calibration) {
  const estimation::SensorSet set = estimation::ChooseSensors(calibration, {});
  const auto camera = [&calibration](int i) { return calibration.cameras.at(static_cast<std::size_t>(i)); };
  left_ = camera(set.picture);
  if (set.right) right_ = camera(*set.right);
  if (set.depth) depth_ = camera(*set.depth);
  if (depth_ && !features::Registered(*depth_, left_)) registration_.emplace(*depth_, left_);
  if (set.imu) imu_sensor_ = set.imu->sensor;
}

void FrameAssembler::Add(const Measurement& measurement) {
  if (const auto* imu = std::get_if<ImuSample>(&measurement.data)) {
    if (measurement.sensor == imu_sensor_)
      imu_.push_back({measurement.captured, imu->angular_velocity, imu->specific_force});
    return;
  }
  if (const auto* depth = std::get_if<DepthImage>(&measurement.data)) {
    if (depth_ && measurement.sensor == depth_->sensor)
      frames_[measurement.seq].depth = registration_ ? (*registration_)(*depth) : *depth;
  }
  const auto* image = std::get_if<Image>(&measurement.data);
  if (image != nullptr && measurement.sensor == left_.sensor) {
    Parts& parts = frames_[measurement.seq];
    parts.left = ToGrey(*image);
    parts.stamp = measurement.captured + left_.time_offset;
  } else if (image != nullptr && right_ && measurement.sensor == right_->sensor) {
    frames_[measurement.seq].right = ToGrey(*image);
  }
  while (frames_.size() > kFramesWaiting) frames_.erase(frames_.begin());
}

bool FrameAssembler::Whole(const Parts& parts) const {
  return parts.left && (!right_ || parts.right) && (!depth_ || parts.depth);
}

std::optional<estimation::FrameInput> FrameAssembler::Next() {
  while (!frames_.empty()) {
    const auto& [seq, parts] = *frames_.begin();
    if (!Whole(parts)) {
      if (frames_.size() < 2 || !Whole(frames_.rbegin()->second)) return std::nullopt;
      frames_.erase(frames_.begin());
      continue;
    }
    if (imu_sensor_ && (imu_.empty() || imu_.back().time < parts.stamp)) return std::nullopt;
    estimation::FrameInput frame{seq, parts.stamp, *parts.left, parts.right.value_or(Image{}),
                                 parts.depth.value_or(DepthImage{})};
    for (const estimation::TimedImu& sample : imu_) {
      frame.imu.push_back(sample);
      if (sample.time >= parts.stamp) break;
    }
    frames_.erase(frames_.begin());
    return frame;
  }
  return std::nullopt;
}

void FrameAssembler::Consume(const estimation::FrameInput& frame) {
  imu_.erase(imu_.begin(), imu_.begin() + static_cast<std::ptrdiff_t>(frame.imu.size()));
}

}  // namespace alula::stack::slam

#include "stack/estimation/input_guard.h"

#include <algorithm>
#include <cstring>

#include "stack/estimation/internal/sliding_window.h"

namespace alula::stack::estimation {

Saturation SaturationOf(const std::vector<TimedImu>& samples, const ImuNoise& range, double share) {
  const auto beyond = [share](const base::Vec3& v, double limit) {
    return limit > 0.0 && v.cwiseAbs().maxCoeff() >= share * limit;
  };
  Saturation saturation;
  for (const TimedImu& s : samples) {
    saturation.gyro = saturation.gyro || beyond(s.gyro, range.gyro_range);
    saturation.accel = saturation.accel || beyond(s.accel, range.accelerometer_range);
  }
  return saturation;
}

std::vector<TimedImu> Sound(const std::vector<TimedImu>& samples, base::Time after, std::string& complaint) {
  std::vector<TimedImu> sound;
  for (const TimedImu& s : samples) {
    if (!s.gyro.allFinite() || !s.accel.allFinite()) {
      complaint = "inertial samples that are no numbers were left out";
      continue;
    }
    if (s.time <= after) continue;
    sound.push_back(s);
    after = s.time;
  }
  return sound;
}

bool Repeats(const Image& a, const Image& b) {
  if (!a.bytes || !b.bytes || a.width != b.width || a.height != b.height) return false;
  if (a.bytes == b.bytes) return true;
  for (int v = 0; v < a.height; ++v) {
    if (std::memcmp(a.Row(v), b.Row(v), static_cast<std::size_t>(a.width)) != 0) return false;
  }
  return true;
}

double TurnOf(const std::vector<TimedImu>& samples, const base::Vec3& gyro_bias) {
  ImuState from;
  from.stamp = samples.front().time;
  from.gyro_bias = gyro_bias;
  return base::Log(Propagate(from, samples).X_OI.q).norm();
}

bool TurnWatch::Agree(int points, int by_turn, int by_pose) {
  constexpr int kLeastPoints = 15, kStrikes = 6;
  constexpr double kFew = 0.4, kMany = 0.7;
  const bool differ = points >= kLeastPoints && by_turn < kFew * points && by_pose > kMany * points;
  strikes_ = differ ? strikes_ + 1 : std::max(0, strikes_ - 1);
  return strikes_ < kStrikes;
}

}  // namespace alula::stack::estimation

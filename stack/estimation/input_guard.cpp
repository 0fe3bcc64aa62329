#include "stack/estimation/input_guard.h"

#include <algorithm>
#include <cstring>

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

MotionWatch::Verdict MotionWatch::Update(int points, int by_turn, int by_pose) {
  constexpr int kLeastPoints = 15, kMisfits = 20;
  constexpr double kMemory = 0.8;                              // an image: five of them count
  constexpr double kFew = 0.45, kVeryFew = 0.4, kMany = 0.85;  // shares
  if (points < kLeastPoints) return Verdict::kFits;
  by_turn_ = kMemory * by_turn_ + (1.0 - kMemory) * by_turn / points;
  by_pose_ = kMemory * by_pose_ + (1.0 - kMemory) * std::max(by_turn, by_pose) / points;
  if (by_turn_ < kFew && by_pose_ > kMany) return Verdict::kTurnsOtherwise;
  misfits_ = by_pose_ < kVeryFew ? misfits_ + 1 : 0;
  return misfits_ < kMisfits ? Verdict::kFits : Verdict::kFitsNothing;
}

}  // namespace alula::stack::estimation

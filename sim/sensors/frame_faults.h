#pragma once

#include <cstdint>
#include <string>

#include "base/random.h"
#include "sim/sensors/camera_config.h"

namespace alula::sim {

/// What becomes of one frame.
struct FrameFate {
  bool dropped = false;
  bool frozen = false;  // shows the picture before
  base::Duration late_by{};
};

/// Draws the fates of a camera's frames, one after another; always as many numbers a frame.
class FrameFaults {
 public:
  FrameFaults(const FrameFaultsConfig& config, std::uint64_t seed, const std::string& camera)
      : config_(config), stream_(seed, camera + "/frames") {}
  FrameFate Next();

 private:
  FrameFaultsConfig config_;
  base::RandomStream stream_;
  int frozen_ = 0;  // frames to come that are stuck
};

}  // namespace alula::sim

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "stack/slam/slam.h"
#include "stack/slam/slam_config.h"

namespace alula::scenarios::slam {

/// A way to estimate, by name: what is compared with others on the same images.
struct Variant {
  std::string name;
  stack::slam::SlamConfig config;
  std::filesystem::path known_map{};  // a map from before that it begins with; empty: none
  bool keeps_map = false;             // hands its map over at the end
};

/// What one estimator made of a recording or flight.
struct EstimatorResult {
  std::string name;
  std::vector<base::StampedPose> online;    // map-frame pose as known at its frame
  std::vector<base::StampedPose> finished;  // after all optimisation
  std::vector<base::Time> frames;           // stamps of all frames given
  std::vector<double> frame_ms;             // processor time of each, work at keyframes apart
  std::vector<double> keyframe_ms;          // of the map's work at each keyframe
  double finish_ms = 0.0;                   // of the work at the end
  std::vector<std::uint8_t> map;            // as stack/slam/map_file.h writes it, where the variant keeps it
  std::uint32_t resets = 0;
  int loops = 0;                   // closed by the map
  int joins = 0;                   // of its parts
  std::vector<std::string> notes;  // in the order in which they first appeared
};

/// An estimator that is being fed. Throws base::InputError for a known map that cannot be read. Reads the thread's
/// processor clock, for the report alone.
class EstimatorRun {
 public:
  EstimatorRun(const Variant& variant, const stack::Calibration& calibration, const base::Transform& X_MB_start);
  void Feed(const stack::estimation::FrameInput& frame);
  EstimatorResult Finish();

 private:
  EstimatorResult result_;
  bool keeps_map_ = false;
  std::unique_ptr<stack::slam::Slam> slam_;
};

}  // namespace alula::scenarios::slam

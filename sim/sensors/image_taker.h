#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

#include "sim/sensors/stereo_camera.h"

namespace alula::sim {

/// Takes stereo pairs in the order requested, on a thread of its own or, without one, when they are fetched. Both ways
/// give the same bytes; the camera's read-out time is what hides the drawing.
class ImageTaker {
 public:
  ImageTaker(const StereoCameraConfig& config, std::uint64_t seed, const std::string& vehicle,
             render::CameraRenderer& renderer, bool own_thread);
  ~ImageTaker();
  ImageTaker(const ImageTaker&) = delete;
  ImageTaker& operator=(const ImageTaker&) = delete;

  void Request(std::uint32_t seq, base::Time captured, const base::Transform& X_WB);
  /// The oldest pair not fetched yet; waits for it. Rethrows what the drawing threw.
  std::array<stack::Image, 2> Fetch();
  double wall_ms() const;

 private:
  struct Shot {
    std::uint32_t seq = 0;
    base::Time captured;
    base::Transform X_WB;
  };
  std::array<stack::Image, 2> Draw(const Shot& request);
  void Work();

  StereoCameraConfig config_;
  std::uint64_t seed_;
  std::array<std::string, 2> names_;
  render::CameraRenderer& renderer_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Shot> requests_;
  std::deque<std::array<stack::Image, 2>> done_;
  std::exception_ptr failure_;
  double wall_ms_ = 0.0;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace alula::sim

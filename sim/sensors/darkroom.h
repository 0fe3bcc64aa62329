#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <variant>
#include <vector>

#include "render/camera_renderer.h"
#include "stack/interface/measurement.h"

namespace alula::sim {

/// What a camera's job gives.
using Developed = std::variant<stack::Image, stack::DepthImage>;

/// Draws pictures in the order requested, on threads with a renderer each or, without threads, when they are fetched.
/// Either way gives the same bytes; the cameras' read-out time is what hides the drawing.
class Darkroom {
 public:
  using Job = std::function<Developed(render::CameraRenderer&)>;
  class Print;

  /// `renderers`: at least one; with `threads` each of them gets a thread. They outlive the darkroom.
  Darkroom(std::vector<render::CameraRenderer*> renderers, bool threads);
  ~Darkroom();
  Darkroom(const Darkroom&) = delete;
  Darkroom& operator=(const Darkroom&) = delete;

  std::shared_ptr<Print> Request(Job job);
  /// Waits for it, or draws it now. Rethrows what the drawing threw.
  Developed Fetch(const std::shared_ptr<Print>& print);
  /// Wall time spent on pictures by whichever thread drew them, ms.
  double wall_ms() const;

 private:
  void Work(render::CameraRenderer& renderer);
  void Develop(Print& print, render::CameraRenderer& renderer);

  std::vector<render::CameraRenderer*> renderers_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<Print>> queue_;
  double wall_ms_ = 0.0;
  bool stop_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace alula::sim

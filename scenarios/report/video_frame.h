#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "render/camera_renderer.h"
#include "scenarios/report/chase_camera.h"
#include "scenarios/report/map_view.h"
#include "stack/interface/navigation_stack.h"

namespace alula::scenarios {

/// What one picture of the video shows.
struct VideoMoment {
  base::Time time;
  base::Transform X_WB;
  base::Vec3 v_WB = base::Vec3::Zero();
  std::vector<base::Transform> X_WL;             // of the links of the world's actors
  std::optional<base::Transform> X_MB;           // published estimate
  std::optional<stack::Image> left;              // last image of the left camera
  std::shared_ptr<const stack::StackView> view;  // what the stack shows; may be null
  int next_gate = 0;
  int gate_count = 0;
  std::string caption;  // last event
};

/// Composes the 1280×720 picture: a chase view large, the left camera with its tracked features and the map at the
/// right, a line with clock, speed and next gate below.
class VideoComposer {
 public:
  static constexpr int kWidth = 1280;
  static constexpr int kHeight = 720;

  /// `movers`: the vehicle's parts with their poses in the body, drawn in the chase view; the world's actors follow.
  VideoComposer(std::string_view maker, const worlds::World& world, std::vector<render::Mover> movers,
                std::vector<base::Transform> X_BM, std::string title);

  /// The finished picture; valid until the next call. `dt`: since the last picture.
  const Canvas& Compose(const VideoMoment& moment, base::Duration dt);

 private:
  void DrawChase(const VideoMoment& moment, base::Duration dt);
  void DrawCamera(const VideoMoment& moment);
  void DrawText(const VideoMoment& moment);

  std::unique_ptr<render::CameraRenderer> renderer_;
  std::vector<base::Transform> X_BM_;
  std::string title_;
  ChaseCamera chase_;
  MapView map_;
  Canvas canvas_{kWidth, kHeight};
  render::Picture chase_picture_;
};

}  // namespace alula::scenarios

#pragma once

#include <memory>
#include <vector>

#include "base/frames.h"
#include "stack/interface/navigation_stack.h"
#include "worlds/world.h"

namespace alula::scenarios {

/// An RGB picture under composition, rows from the top.
struct Canvas {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  Canvas(int w, int h) : width(w), height(h), rgb(static_cast<std::size_t>(w) * h * 3, 0) {}
};

/// The world from above with what really happened and what the stack believes: walls and obstacles (grey), gates, the
/// stack's occupied cells (by height), true path (green), estimated path (orange), plan (blue).
class MapView {
 public:
  MapView(const worlds::World& world, int width, int height);

  void AddTruth(const base::Vec3& p_WB) { truth_.push_back(p_WB); }
  /// `p_MB`: the published estimate in the map frame.
  void AddEstimate(const base::Vec3& p_MB) { estimate_.push_back(p_MB); }
  /// Draws into the rectangle whose top left corner is (x, y). `view` may be null.
  void Draw(const stack::StackView* view, double yaw, int next_gate, Canvas& canvas, int x, int y) const;

 private:
  struct Scale {
    double px_per_m = 1.0;
    double x0 = 0.0;
    double y1 = 0.0;
    double margin_x = 0.0;
    double margin_y = 0.0;
  };

  int width_;
  int height_;
  Scale scale_;
  std::vector<worlds::Gate> gates_;
  base::Vec3 target_;
  std::vector<std::uint8_t> background_;  // RGB
  std::vector<base::Vec3> truth_;
  std::vector<base::Vec3> estimate_;
};

}  // namespace alula::scenarios

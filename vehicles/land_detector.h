#pragma once

#include "base/describe.h"
#include "base/frames.h"

namespace alula::vehicles {

struct LandDetectorConfig {
  double still_speed = 0.10;    // m/s, vertical, while a descent is commanded: something holds the vehicle
  double still_time = 0.35;     // s
  double ground_share = 0.40;   // of the weight that neither thrust nor acceleration explains: the ground carries it
  double ground_time = 0.20;    // s
  double landed_thrust = 0.30;  // of the weight; thrust below it on the ground is a landing
  double landed_time = 0.30;    // s
  double sinking_speed = 0.40;  // m/s: it was not the ground after all
};
void Describe(base::Description& d, LandDetectorConfig& c);

/// Judges from the autopilot's own motion, thrust and accelerometer whether the vehicle stands on something.
///
///   ground contact: a descent is wanted, and the vehicle does not sink or (m f_z − T) / m g exceeds ground_share
///   landed: ground contact while the thrust is low, for a while
class LandDetector {
 public:
  explicit LandDetector(const LandDetectorConfig& config) : config_(config) {}

  /// `descending`: a descent is wanted. `thrust_share`: commanded thrust over weight. `load_share`: specific force
  /// along body z over g. v_OB in m/s.
  void Step(bool descending, double thrust_share, double load_share, const base::Vec3& v_OB, double dt);

  bool contact() const { return contact_; }
  bool landed() const { return landed_; }
  /// Grows from 0 to 1 in half a second of contact: how far the collective may be taken back.
  double relief() const { return relief_; }
  void SetLanded(bool landed);

 private:
  LandDetectorConfig config_;
  double still_for_ = 0, carried_for_ = 0, low_for_ = 0;  // s
  double relief_ = 0;
  bool contact_ = true, landed_ = true;
};

}  // namespace alula::vehicles

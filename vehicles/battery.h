#pragma once

#include "base/describe.h"
#include "base/time.h"
#include "stack/interface/measurement.h"

namespace alula::vehicles {

/// A lithium-polymer pack. Defaults: 4 cells of 2300 mAh, a few minutes old.
struct BatteryConfig {
  int cells = 4;
  double capacity = 2.3 * 3600;        // A·s
  double initial_charge = 0.9;         // share of the capacity
  double internal_resistance = 0.030;  // ohm, cells (4 × 5 mΩ), wires and connector
  double drive_efficiency = 0.75;      // shaft power / electric power of motor and controller
  double avionics_power = 15.0;        // W, computer, cameras, autopilot
};
void Describe(base::Description& d, BatteryConfig& c);

/// Open-circuit voltage of one cell over its state of charge in [0, 1], V; piecewise linear through typical LiPo data
/// (rest voltages: 3.3 V empty, 3.7 V at 12 %, 3.85 V at half, 4.2 V full).
double CellVoltage(double state_of_charge);

/// Sag by internal resistance under constant power: V = OCV − R I, V I = P  ⇒  V = (OCV + √(OCV² − 4 R P)) / 2, the
/// larger root; beyond the power that the pack can give (OCV² / 4R) the voltage stays at OCV / 2.
class Battery {
 public:
  explicit Battery(const BatteryConfig& config);

  /// Draws the shaft power of all motors (W) for dt.
  void Step(double shaft_power, base::Duration dt);

  /// A failing pack: internal resistance times `resistance`, open-circuit voltage times `voltage` (a shorted cell of
  /// four leaves 0.75), from the next step on.
  void Impair(double resistance, double voltage);

  double voltage() const { return voltage_; }  // V at the terminals
  double current() const { return current_; }  // A
  double state_of_charge() const { return charge_; }

 private:
  void Load(double shaft_power);

  BatteryConfig config_;
  double charge_;
  double resistance_factor_ = 1.0, voltage_share_ = 1.0;
  double voltage_ = 0.0;
  double current_ = 0.0;
};

}  // namespace alula::vehicles

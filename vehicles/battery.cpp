#include "vehicles/battery.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace alula::vehicles {

void Describe(base::Description& d, BatteryConfig& c) {
  d.Field("cells", c.cells, {.meaning = "cells in series", .min = 1, .max = 24});
  d.Field("capacity", c.capacity, {.unit = "A*s", .meaning = "charge when full", .min = 1});
  d.Field("initial_charge", c.initial_charge, {.meaning = "state of charge at the start", .min = 0.05, .max = 1});
  d.Field("internal_resistance", c.internal_resistance,
          {.unit = "ohm", .meaning = "of cells, wires and connector together", .min = 0, .max = 1});
  d.Field("drive_efficiency", c.drive_efficiency,
          {.meaning = "shaft power over electric power of motors and controllers", .min = 0.1, .max = 1});
  d.Field("avionics_power", c.avionics_power,
          {.unit = "W", .meaning = "computer, cameras and autopilot", .min = 0, .max = 1000});
}

double CellVoltage(double state_of_charge) {
  struct Point {
    double charge, voltage;
  };
  static constexpr std::array<Point, 9> kCurve{{{0.0, 3.30},
                                                {0.05, 3.61},
                                                {0.12, 3.70},
                                                {0.30, 3.77},
                                                {0.50, 3.85},
                                                {0.65, 3.92},
                                                {0.80, 4.02},
                                                {0.92, 4.12},
                                                {1.0, 4.20}}};
  const double s = std::clamp(state_of_charge, 0.0, 1.0);
  std::size_t i = 1;
  while (i + 1 < kCurve.size() && s > kCurve[i].charge) ++i;
  const Point &a = kCurve[i - 1], &b = kCurve[i];
  return a.voltage + (b.voltage - a.voltage) * (s - a.charge) / (b.charge - a.charge);
}

Battery::Battery(const BatteryConfig& config) : config_(config), charge_(config.initial_charge) { Load(0.0); }

void Battery::Load(double shaft_power) {
  // Braking motors give nothing back.
  const double power = std::max(0.0, shaft_power) / config_.drive_efficiency + config_.avionics_power;
  const double open = voltage_share_ * config_.cells * CellVoltage(charge_);
  const double resistance = resistance_factor_ * config_.internal_resistance;
  const double discriminant = open * open - 4 * resistance * power;
  voltage_ = 0.5 * (open + std::sqrt(std::max(0.0, discriminant)));
  current_ = discriminant > 0 ? power / voltage_ : 0.5 * open / resistance;
}

void Battery::Impair(double resistance, double voltage) {
  resistance_factor_ = resistance;
  voltage_share_ = voltage;
}

void Battery::Step(double shaft_power, base::Duration dt) {
  Load(shaft_power);
  charge_ = std::max(0.0, charge_ - current_ * dt.Seconds() / config_.capacity);
}

}  // namespace alula::vehicles

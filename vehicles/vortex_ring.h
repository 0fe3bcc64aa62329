#pragma once

#include "base/describe.h"

namespace alula::vehicles {

/// A rotor that descends into its own wake. Over x = descent rate / v_h, v_h = √(T_0 / 2ρA) the induced velocity of the
/// same rotor speed at hover: flight tests and tunnels show loss of thrust and its strongest fluctuation near x = 1,
/// beginning near 0.4 and ending below 1.8, and none where horizontal air washes the wake away (Leishman 2006, chapter
/// 2; Johnson 2005, NASA/TP-2005-213477: unstable between 0.45 and 1.5, inflow changed between 0.2 and 2.0). The shape
/// between these ends, and the share of thrust that is lost, are ours.
struct VortexRingConfig {
  double begin = 0.4;           // x
  double worst = 1.0;           // x
  double end = 1.8;             // x: beyond lies the turbulent wake, then the windmill brake
  double swept = 0.95;          // horizontal air speed / v_h at which no ring forms (Johnson 2005, his boundary)
  double thrust_loss = 0.3;     // share of hover thrust at the worst
  double fluctuation = 0.1;     // 1 sigma, share of hover thrust at the worst
  double time_constant = 0.05;  // s, of the fluctuation; shed every few D / v_h
};
void Describe(base::Description& d, VortexRingConfig& c);

/// How far the ring has formed, in [0, 1]: half a cosine from `begin` up to `worst` and down to `end`, times
/// 1 − (horizontal / swept)². Both speeds over v_h, `descent` positive downwards.
double VortexRingStrength(const VortexRingConfig& config, double descent, double horizontal);

}  // namespace alula::vehicles

#include "scenarios/check/rotor_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenarios/check/statistics.h"

namespace alula::scenarios::check {
namespace {

constexpr const char* kName = "vehicle0/rotors";
constexpr base::Duration kStep = base::Milliseconds(1);

/// The stand: half command, given air and floor; thrust of all rotors over that of the same speed at hover, by step.
std::vector<double> ThrustRatios(const vehicles::QuadrotorConfig& built, std::uint64_t seed, double descent,
                                 double height, int steps) {
  const auto vehicle = vehicles::MakeQuadrotor(built, "vehicle0", seed);
  vehicles::BodyState state;
  state.v_WB.z() = -descent;
  const std::vector<double> heights(vehicles::kRotors, height);
  const double constant = vehicles::ThrustConstant(built.rotor, built.air_density);
  const double drag = vehicles::BodyDrag(built.aerodynamics, built.air_density, state.v_WB).z();
  std::vector<double> ratios;
  constexpr int kSpinUp = 500;  // steps: 20 time constants of the motor
  for (int i = 0; i < kSpinUp + steps; ++i) {
    vehicle->Above(heights);
    const vehicles::Wrench wrench =
        vehicle->Step(state, {std::vector<double>(vehicles::kRotors, 0.5)}, base::Vec3::Zero(), kStep);
    if (i < kSpinUp) continue;
    double at_hover = 0.0;
    for (const vehicles::RotorState& rotor : vehicle->Rotors()) at_hover += constant * rotor.speed * rotor.speed;
    ratios.push_back((wrench.force_W.z() - drag) / at_hover);
  }
  return ratios;
}

/// Induced velocity at hover of the stand's rotor speed, m/s.
double InducedVelocity(const vehicles::QuadrotorConfig& c, double speed) {
  const double area = 0.25 * M_PI * c.rotor.diameter * c.rotor.diameter;
  return speed * std::sqrt(vehicles::ThrustConstant(c.rotor, c.air_density) / (2.0 * c.air_density * area));
}

double StandSpeed(const vehicles::QuadrotorConfig& c) {
  const auto vehicle = vehicles::MakeQuadrotor(c, "vehicle0");
  for (int i = 0; i < 500; ++i) {
    vehicle->Step({}, {std::vector<double>(vehicles::kRotors, 0.5)}, base::Vec3::Zero(), kStep);
  }
  return vehicle->Rotors().front().speed;
}

void AddGroundEffect(const vehicles::QuadrotorConfig& built, const vehicles::QuadrotorConfig& claimed,
                     std::uint64_t seed, Report& report) {
  const double R = 0.5 * claimed.rotor.diameter, b = claimed.frame.wheelbase;
  const vehicles::RotorSpacing spacing{R, b / std::sqrt(2.0), b};
  for (const double radii : {1.0, 1.5, 2.0, 4.0, 8.0}) {
    report.Add(Compare(kName, fmt::format("ground effect, thrust at {:g} R", radii),
                       vehicles::GroundEffectRatio(*claimed.rotor.ground_effect, spacing, radii * R, 0.0),
                       SpreadOf(ThrustRatios(built, seed, 0.0, radii * R, 2)).mean, 1e-6, "1"));
  }
}

void AddVortexRing(const vehicles::QuadrotorConfig& built, const vehicles::QuadrotorConfig& claimed, std::uint64_t seed,
                   Report& report) {
  const vehicles::VortexRingConfig& ring = *claimed.rotor.vortex_ring;
  const double speed = StandSpeed(claimed), induced = InducedVelocity(claimed, speed);
  constexpr int kSteps = 20'000;
  for (const double x :
       {0.5 * ring.begin, 0.5 * (ring.begin + ring.worst), ring.worst, 0.5 * (ring.worst + ring.end)}) {
    const double s = vehicles::VortexRingStrength(ring, x, 0.0);
    const double inflow =
        2.0 * M_PI * x * induced / (speed * claimed.rotor.diameter * claimed.rotor.zero_thrust_advance);
    const double expected = (1.0 - s) * std::min(1.4, 1.0 + inflow) + s * (1.0 - ring.thrust_loss);
    const Spread found =
        SpreadOf(ThrustRatios(built, seed, x * induced, std::numeric_limits<double>::infinity(), kSteps));
    // Four rotors fluctuate on their own: half of one's sigma. The record holds T/2τ independent samples. The battery
    // sags meanwhile by less than a thousandth of its voltage, and x with it.
    const double fluctuation = 0.5 * s * ring.fluctuation;
    const double independent = kSteps * kStep.Seconds() / (2.0 * ring.time_constant);
    constexpr double kSag = 5e-3;
    report.Add(Compare(kName, fmt::format("vortex ring, thrust at {:.2g} v_h", x), expected, found.mean,
                       kSag + kSigmas * fluctuation / std::sqrt(independent), "1"));
    report.Add(Compare(kName, fmt::format("vortex ring, fluctuation at {:.2g} v_h", x), fluctuation, found.sigma,
                       1e-3 + kSigmas * SigmaError(fluctuation, independent), "1"));
  }
}

}  // namespace

void CheckRotors(const vehicles::QuadrotorConfig& built, const vehicles::QuadrotorConfig& claimed, std::uint64_t seed,
                 Report& report) {
  if (claimed.rotor.ground_effect) {
    vehicles::QuadrotorConfig alone = built;
    alone.rotor.vortex_ring.reset();
    AddGroundEffect(alone, claimed, seed, report);
  }
  if (claimed.rotor.vortex_ring) AddVortexRing(built, claimed, seed, report);
}

}  // namespace alula::scenarios::check

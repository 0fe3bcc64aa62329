#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "worlds/dryden.h"
#include "worlds/shelter.h"
#include "worlds/wind.h"
#include "worlds/wind_config.h"

namespace alula::worlds {
namespace {

using base::Milliseconds;
using base::Seconds;
using base::Vec3;

constexpr double kPi = std::numbers::pi;

TEST(Dryden, ScalesAreThoseOfTheSpecification) {
  // 20 ft: 0.177 + 0.01646 = 0.19346.
  const DrydenScales scales = ScalesAt(6.096, 10.0);
  EXPECT_NEAR(scales.length_w, 6.096, 1e-9);
  EXPECT_NEAR(scales.length_u, 6.096 / std::pow(0.19346, 1.2), 1e-6);
  EXPECT_NEAR(scales.sigma_w, 1.0, 1e-12);
  EXPECT_NEAR(scales.sigma_u, 1.0 / std::pow(0.19346, 0.4), 1e-6);
  EXPECT_EQ(ScalesAt(0.0, 1.0).length_w, ScalesAt(3.0, 1.0).length_w) << "held at 10 ft";
}

/// Variances known to about √(2 · 2τ / T): τ of w is 3 s at 1 m/s, of u 24 s.
TEST(Dryden, HasTheStatedVarianceForAnyStepAndAirspeed) {
  for (const double dt : {0.001, 0.05, 1.0, 20.0}) {
    SCOPED_TRACE(dt);
    constexpr double kAirspeed = 8.0;
    base::RandomStream random(1, "test");
    const DrydenScales scales = ScalesAt(6.0, 5.0);
    const int steps = 100'000;
    Vec3 squares = Vec3::Zero();
    // Many short runs from the stationary begin, or one long run: whichever has more independent samples.
    const int runs = dt < 0.01 ? 2000 : 1;
    for (int r = 0; r < runs; ++r) {
      DrydenTurbulence air(random);
      for (int i = 0; i < steps / runs; ++i) {
        squares += air.Advance({5.0, 1.0}, 6.0, kAirspeed, Seconds(dt), random).cwiseAbs2();
      }
    }
    const Vec3 sigma(scales.sigma_u, scales.sigma_u, scales.sigma_w);
    for (int axis = 0; axis < 3; ++axis) {
      const double tau = (axis < 2 ? scales.length_u : scales.length_w) / kAirspeed;
      const double independent = std::max<double>(runs, std::min<double>(steps, steps * dt / (2.0 * tau)));
      const double variance = sigma[axis] * sigma[axis];
      EXPECT_NEAR(squares[axis] / steps, variance, 4.5 * variance * std::sqrt(2.0 / independent)) << axis;
    }
  }
}

/// Periodogram averages over segments against the spectra of the specification, as two-sided densities over ω.
TEST(Dryden, HasTheSpectraOfTheSpecification) {
  constexpr double kAirspeed = 10.0, kStep = 0.02;
  constexpr int kLength = 2048, kSegments = 300;
  base::RandomStream random(5, "test");
  DrydenTurbulence air(random);
  const DrydenScales scales = ScalesAt(6.0, 5.0);
  const std::vector<int> bins{4, 8, 16, 32, 64, 128};
  std::vector<Vec3> power(bins.size(), Vec3::Zero());
  for (int s = 0; s < kSegments; ++s) {
    std::vector<Eigen::Vector3cd> sums(bins.size(), Eigen::Vector3cd::Zero());
    for (int n = 0; n < kLength; ++n) {
      const double window = 1.0 - std::cos(2.0 * kPi * (n + 0.5) / kLength);  // Hann, mean square 1.5
      const Vec3 v = window * air.Advance({5.0, 1.0}, 6.0, kAirspeed, Seconds(kStep), random);
      for (std::size_t b = 0; b < bins.size(); ++b) sums[b] += v * std::polar(1.0, -2.0 * kPi * bins[b] * n / kLength);
    }
    for (std::size_t b = 0; b < bins.size(); ++b)
      power[b] += sums[b].cwiseAbs2() * (kStep / (1.5 * kLength * kSegments));
  }
  for (std::size_t b = 0; b < bins.size(); ++b) {
    const double omega = 2.0 * kPi * bins[b] / (kLength * kStep);
    const auto phi_u = [&](double L, double sigma) {  // S(ω) = π/V · Φ(ω/V) · … : ∫ S dω/2π = σ²
      const double x = L / kAirspeed * omega;
      return sigma * sigma * 2.0 * L / kAirspeed / (1.0 + x * x);
    };
    const auto phi_v = [&](double L, double sigma) {
      const double x = L / kAirspeed * omega;
      return sigma * sigma * L / kAirspeed * (1.0 + 3.0 * x * x) / ((1.0 + x * x) * (1.0 + x * x));
    };
    const Vec3 expected(phi_u(scales.length_u, scales.sigma_u), phi_v(scales.length_u, scales.sigma_u),
                        phi_v(scales.length_w, scales.sigma_w));
    // Each average has a relative deviation of 1/√segments = 6 %; four of them, and some leakage.
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(power[b][axis] / expected[axis], 1.0, 0.25) << bins[b];
  }
}

TEST(Dryden, BlowsOnAVehicleThatHovers) {
  WindConfig config{.speed = 0.0, .turbulence = DrydenConfig{.w20 = 6.0}};
  WindField field(DrawWind(config, 1), 1);
  const Vec3 first = field.At({0, 0, 2}, Milliseconds(1));
  Vec3 last = first;
  for (int i = 0; i < 20'000; ++i) last = field.At({0, 0, 2}, Milliseconds(1));
  EXPECT_GT(first.norm(), 0.0);
  EXPECT_GT((last - first).norm(), 0.05) << "in 20 s of hover";
}

TEST(CosineGust, RisesAndFallsOnce) {
  const CosineGust gust{2.0, 4.0, {0.0, 3.0, 0.0}};
  EXPECT_EQ(GustAt(gust, 1.9), Vec3::Zero().eval());
  EXPECT_NEAR(GustAt(gust, 3.0).y(), 1.5, 1e-12);
  EXPECT_NEAR(GustAt(gust, 4.0).y(), 3.0, 1e-12);
  EXPECT_EQ(GustAt(gust, 6.1), Vec3::Zero().eval());
  WindField field({.gusts = {gust}}, 1);
  Vec3 air = Vec3::Zero();
  for (int i = 0; i < 4000; ++i) air = field.At(Vec3::Zero(), Milliseconds(1));
  EXPECT_NEAR(air.y(), 3.0, 1e-12);
}

World WithWall(double width) {
  World world;
  world.wind.mean_W = {5.0, 0.0, 0.0};
  world.wind.shelter = true;
  // Two pieces on top of each other: one wall 3 m high whose lee face is x = 0.
  for (const double z : {0.75, 2.25}) {
    world.objects.push_back({.name = "wall",
                             .shape = geometry::Box{{0.1, 0.5 * width, 0.75}},
                             .X_WO = {base::Quat::Identity(), {-0.1, 0, z}}});
  }
  return world;
}

TEST(Shelter, BehindAWideWallIsPereras) {
  const Shelter shelter(WithWall(400.0), {5.0, 0.0, 0.0});
  for (const double x : {16.0, 30.0, 60.0}) {
    for (const double z : {0.5, 1.5, 3.0, 6.0}) {
      const double K = 0.32 / std::log(3.0 / 0.03);
      const double eta = z / 3.0 * std::pow(K * x / 3.0, -0.47);
      const double deficit = std::min(9.75 * 3.0 / x * eta * std::exp(-0.67 * std::pow(eta, 1.5)), 0.95);
      EXPECT_NEAR(shelter.Through({x, 0.0, z}), 1.0 - deficit, 1e-9) << x << " m behind, " << z << " m up";
    }
  }
  EXPECT_EQ(shelter.Through({-5.0, 0.0, 1.0}), 1.0) << "before the wall";
  EXPECT_EQ(shelter.Through({100.0, 0.0, 1.0}), 1.0) << "far behind";
  EXPECT_LT(shelter.Through({6.0, 0.0, 1.5}), 0.2) << "close behind";
}

TEST(Shelter, OfANarrowThingIsNarrowAndFades) {
  const Shelter narrow(WithWall(3.0), {5.0, 0.0, 0.0});
  const Shelter wide(WithWall(400.0), {5.0, 0.0, 0.0});
  EXPECT_GT(narrow.Through({40.0, 0.0, 1.5}), wide.Through({40.0, 0.0, 1.5}));
  EXPECT_GT(narrow.Through({20.0, 12.0, 1.5}), 0.99) << "beside it";
  EXPECT_NEAR(narrow.Through({15.0, 2.0, 1.0}), narrow.Through({15.0, -2.0, 1.0}), 1e-12);
}

TEST(WindField, IsSlowerBehindAWall) {
  WindField field(WithWall(20.0), 1);
  EXPECT_NEAR(field.At({-5, 0, 1.5}, Milliseconds(20)).x(), 5.0, 1e-12);
  EXPECT_LT(field.At({8, 0, 1.5}, Milliseconds(20)).x(), 1.5);
}

}  // namespace
}  // namespace alula::worlds

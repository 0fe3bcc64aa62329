#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/shape.h"
#include "vehicles/quadrotor.h"

namespace alula::vehicles {

namespace {

using base::Transform;
using base::Vec3;

constexpr double kArmWidth = 0.014;       // m
constexpr double kArmThickness = 0.006;   // m, carbon
constexpr double kMotorRadius = 0.014;    // m, a 2306 motor
constexpr double kMotorHeight = 0.020;    // m
constexpr double kDiscThickness = 0.008;  // m that a turning propeller sweeps

struct Solid {
  Part part;
  double mass;
};

geometry::Material Plain(std::string name, float r, float g, float b) {
  return {.name = std::move(name), .colour = {r, g, b}, .texture = nullptr};
}

/// The solids in the chassis frame: origin between the rotors in the plane of the arms.
std::vector<Solid> Solids(const FrameConfig& f, double rotor_diameter) {
  const auto carbon = Plain("carbon", 0.12F, 0.12F, 0.13F), grey = Plain("grey", 0.45F, 0.45F, 0.48F);
  const auto blue = Plain("battery", 0.10F, 0.20F, 0.55F), orange = Plain("propeller", 0.95F, 0.50F, 0.10F);
  const auto black = Plain("camera", 0.05F, 0.05F, 0.05F);
  const double arm = f.wheelbase / std::sqrt(8.0);  // x and y of a motor

  std::vector<Solid> solids;
  const auto add = [&solids](std::string name, geometry::Shape shape, const Transform& X, const geometry::Material& m,
                             double mass) -> Part& {
    solids.push_back({{.name = std::move(name), .shape = std::move(shape), .X_BP = X, .material = m}, mass});
    return solids.back().part;
  };
  const auto at = [](double x, double y, double z) { return Transform{base::Quat::Identity(), {x, y, z}}; };

  add("body", geometry::Box{0.5 * f.body_size}, at(0, 0, 0), grey, f.body_mass);
  // The battery is strapped where the whole balances between the rotors.
  const double back = -f.camera_mass * f.camera_forward / f.battery_mass;
  add("battery", geometry::Box{0.5 * f.battery_size}, at(back, 0, 0.5 * (f.body_size.z() + f.battery_size.z())), blue,
      f.battery_mass);
  add("camera", geometry::Box{0.5 * f.camera_size}, at(f.camera_forward, 0, -f.camera_below), black, f.camera_mass);
  const Vec3 arms(0.5 * f.wheelbase, 0.5 * kArmWidth, 0.5 * kArmThickness);
  add("arms_a", geometry::Box{arms}, {base::FromYaw(M_PI / 4), Vec3::Zero()}, carbon, 2 * f.arm_mass);
  add("arms_b", geometry::Box{arms}, {base::FromYaw(-M_PI / 4), Vec3::Zero()}, carbon, 2 * f.arm_mass);

  const std::array<std::pair<double, double>, kRotors> corners{{{1, -1}, {-1, 1}, {1, 1}, {-1, -1}}};
  for (int i = 0; i < kRotors; ++i) {
    const double x = corners[static_cast<std::size_t>(i)].first * arm;
    const double y = corners[static_cast<std::size_t>(i)].second * arm;
    const std::string n = std::to_string(i);
    add("motor" + n, geometry::Cylinder{kMotorRadius, 0.5 * kMotorHeight},
        at(x, y, 0.5 * (kArmThickness + kMotorHeight)), grey, f.motor_mass);
    add("propeller" + n, geometry::Cylinder{0.5 * rotor_diameter, 0.5 * kDiscThickness}, at(x, y, f.rotor_above),
        orange, f.propeller_mass);
    Part& leg = add("leg" + n, geometry::Capsule{f.leg_radius, 0.5 * f.leg_length - f.leg_radius},
                    at(x, y, -0.5 * f.leg_length), carbon, f.leg_mass);
    leg.hull = false;
    leg.may_touch = true;
  }
  return solids;
}

/// Grows `half` and `radius` until they hold the part: corners of a box, rims of an upright cylinder.
void Enclose(const Part& part, Vec3& half, double& radius) {
  std::vector<Vec3> points;
  if (const auto* box = std::get_if<geometry::Box>(&part.shape)) {
    for (int k = 0; k < 8; ++k) {
      const Vec3 sign((k & 1) ? 1 : -1, (k & 2) ? 1 : -1, (k & 4) ? 1 : -1);
      points.push_back(part.X_BP * Vec3(sign.cwiseProduct(box->half_extents)));
    }
  } else if (const auto* rim = std::get_if<geometry::Cylinder>(&part.shape)) {
    const Vec3 c = part.X_BP.p;
    const Vec3 outward = Vec3(c.x(), c.y(), 0).normalized() * rim->radius;
    for (const double z : {-rim->half_height, rim->half_height}) {
      points.push_back(c + outward + Vec3(0, 0, z));
      for (const double s : {-1.0, 1.0}) {
        points.push_back(c + Vec3(s * rim->radius, 0, z));
        points.push_back(c + Vec3(0, s * rim->radius, z));
      }
    }
  }
  for (const Vec3& p : points) {
    half = half.cwiseMax(p.cwiseAbs());
    radius = std::max(radius, p.norm());
  }
}

}  // namespace

QuadrotorLayout LayOutQuadrotor(const QuadrotorConfig& config) {
  std::vector<Solid> solids = Solids(config.frame, config.rotor.diameter);
  double total = 0;
  Vec3 moment = Vec3::Zero();
  for (const Solid& s : solids) {
    total += s.mass;
    moment += s.mass * s.part.X_BP.p;  // these solids have their centre of mass at their origin
  }
  const Vec3 centre = moment / total;

  QuadrotorLayout layout;
  VehicleBody& body = layout.body;
  body.mass = config.mass;
  body.inertia.setZero();
  for (Solid& s : solids) {
    s.part.X_BP.p -= centre;
    const double mass = s.mass * config.mass / total;
    body.inertia += geometry::InertiaAbout(geometry::Properties(s.part.shape), mass, s.part.X_BP);
    if (s.part.hull) Enclose(s.part, body.hull_half_extents, body.hull_radius);
    body.parts.push_back(std::move(s.part));
  }
  body.standing_height = centre.z() + config.frame.leg_length;

  const double arm = config.frame.wheelbase / std::sqrt(8.0);
  const Vec3 hub = Vec3(0, 0, config.frame.rotor_above) - centre;
  layout.rotors = {{{hub + Vec3(arm, -arm, 0), 1.0},
                    {hub + Vec3(-arm, arm, 0), 1.0},
                    {hub + Vec3(arm, arm, 0), -1.0},
                    {hub + Vec3(-arm, -arm, 0), -1.0}}};
  return layout;
}

}  // namespace alula::vehicles

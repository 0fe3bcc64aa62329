#include "worlds/actors/machines.h"

#include <array>
#include <numbers>
#include <utility>

#include "base/random.h"
#include "worlds/actors/body_shapes.h"
#include "worlds/actors/drive.h"
#include "worlds/furniture.h"
#include "worlds/kit/surface.h"

namespace alula::worlds {
namespace {

using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kPi = std::numbers::pi;

Transform At(double x, double y, double z) { return {base::Quat::Identity(), {x, y, z}}; }

void AddLink(Actor& actor, std::string name, int joint, const Transform& X_JL, int material, geometry::Shape shape,
             bool collides = true) {
  actor.links.push_back({.name = std::move(name),
                         .shape = std::move(shape),
                         .joint = joint,
                         .X_JL = X_JL,
                         .material = material,
                         .collides = collides,
                         .casts_shadow = collides});
}

/// A wheel on its joint: tyre, rim, and two spokes that show it turning.
void AddWheel(Actor& actor, const Drive& drive, int number, int rubber, int rim) {
  const std::string name = "wheel" + std::to_string(number);
  const Transform turned{base::Exp({0.5 * kPi, 0.0, 0.0}), Vec3::Zero()};  // the axle is the joint's y
  const double r = drive.wheel_radius;
  constexpr double kHalfWidth = 0.10;
  AddLink(actor, name + "/tyre", 1 + number, turned, rubber, geometry::Cylinder{r, kHalfWidth});
  AddLink(actor, name + "/rim", 1 + number, turned, rim, geometry::Cylinder{0.25 * r, kHalfWidth + 0.01}, false);
  for (int i = 0; i < 2; ++i) {
    AddLink(actor, name + "/spoke" + std::to_string(i), 1 + number,
            {base::FromYawPitchRoll(0.0, 0.5 * kPi * i, 0.0), Vec3::Zero()}, rim,
            geometry::Box{{0.70 * r, kHalfWidth + 0.006, 0.09 * r}}, false);
  }
}

}  // namespace

void AddCar(World& world, const std::string& name, const Drive& drive, std::uint64_t seed) {
  base::RandomStream random(seed, "world/actors/" + name + "/look");
  base::RandomStream unused(seed, "world/actors/" + name);
  Begin(drive, unused);  // throws where the path cannot be driven
  static const std::array<Eigen::Vector3f, 7> kPaint{{{0.80F, 0.80F, 0.80F},
                                                      {0.15F, 0.16F, 0.18F},
                                                      {0.62F, 0.10F, 0.10F},
                                                      {0.13F, 0.25F, 0.50F},
                                                      {0.50F, 0.52F, 0.54F},
                                                      {0.85F, 0.75F, 0.35F},
                                                      {0.18F, 0.36F, 0.27F}}};
  const int paint = AddPlainMaterial(world, name + "/paint", kPaint[random.Index(kPaint.size())]);
  const int glass = AddPlainMaterial(world, name + "/windows", {0.10F, 0.13F, 0.16F});
  const int rubber = AddPlainMaterial(world, name + "/rubber", {0.07F, 0.07F, 0.07F});
  const int rim = AddPlainMaterial(world, name + "/rims", {0.66F, 0.67F, 0.69F});
  const int lamp = AddPlainMaterial(world, name + "/lamps", {0.95F, 0.94F, 0.85F});
  const int red = AddPlainMaterial(world, name + "/tail_lamps", {0.60F, 0.06F, 0.05F});
  const int plate = AddPlainMaterial(world, name + "/plates", {0.90F, 0.90F, 0.86F});

  Actor actor{.name = name, .semantic = SemanticClass::kCar, .links = {}, .motion = drive};
  const double front = FrontReach(drive);
  const double rear = RearReach(drive);
  const double half = 0.5 * (front + rear);
  const double middle = front - half;
  const double w = drive.half_width;
  const bool is_van = random.Index(3) == 0;
  const double roof = is_van ? random.Uniform(1.75, 1.95) : random.Uniform(1.38, 1.5);
  constexpr double kSill = 0.20, kBelt = 0.78;  // m
  constexpr double kArch = 0.48;                // m: below it the body is narrow, so that the wheels show
  AddLink(actor, "lower", 0, At(middle, 0, 0.5 * (kSill + kArch)), paint,
          geometry::Box{{half - 0.05, 0.5 * drive.track - 0.02, 0.5 * (kArch - kSill)}});
  AddLink(actor, "upper", 0, At(middle, 0, 0.5 * (kArch + kBelt)), paint,
          Frustum({half, w}, {half - 0.08, w - 0.05}, 0.5 * (kBelt - kArch), 0.0));
  const double bonnet = is_van ? 0.55 : 1.05;
  const double boot = is_van ? 0.05 : 0.45;
  const double cabin = half - 0.5 * (bonnet + boot);
  const double cabin_x = middle - 0.5 * (bonnet - boot);
  const double top = cabin - (is_van ? 0.25 : 0.45);
  AddLink(actor, "windows", 0, At(cabin_x, 0, 0.5 * (kBelt + roof)), glass,
          Frustum({cabin, w - 0.07}, {top, w - 0.22}, 0.5 * (roof - kBelt), 0.08));
  AddLink(actor, "roof", 0, At(cabin_x - 0.08, 0, roof + 0.015), paint, geometry::Box{{top + 0.03, w - 0.20, 0.025}});
  for (int i = 0; i < 2; ++i) {
    const double y = i == 0 ? w - 0.25 : 0.25 - w;
    const std::string side = i == 0 ? "left" : "right";
    AddLink(actor, "lamp_" + side, 0, At(front - 0.02, y, 0.62), lamp, geometry::Box{{0.03, 0.16, 0.06}}, false);
    AddLink(actor, "tail_lamp_" + side, 0, At(-rear + 0.02, y, 0.64), red, geometry::Box{{0.03, 0.15, 0.07}}, false);
    AddLink(actor, "mirror_" + side, 0, At(cabin_x + cabin - 0.35, i == 0 ? w + 0.06 : -w - 0.06, 0.92), paint,
            geometry::Box{{0.05, 0.09, 0.07}});
  }
  AddLink(actor, "plate_front", 0, At(front + 0.005, 0, 0.42), plate, geometry::Box{{0.01, 0.26, 0.055}}, false);
  AddLink(actor, "plate_rear", 0, At(-rear - 0.005, 0, 0.5), plate, geometry::Box{{0.01, 0.26, 0.055}}, false);
  for (int i = 0; i < 4; ++i) AddWheel(actor, drive, i, rubber, rim);
  world.actors.push_back(std::move(actor));
}

void AddDrone(World& world, const std::string& name, const Fly& fly, double span, std::uint64_t seed) {
  base::RandomStream random(seed, "world/actors/" + name + "/look");
  static const std::array<Eigen::Vector3f, 3> kShells{
      {{0.85F, 0.85F, 0.86F}, {0.75F, 0.15F, 0.12F}, {0.2F, 0.22F, 0.25F}}};
  const int shell = AddPlainMaterial(world, name + "/shell", kShells[random.Index(kShells.size())]);
  const int dark = AddPlainMaterial(world, name + "/frame", {0.10F, 0.10F, 0.11F});
  const int disc = AddPlainMaterial(world, name + "/propellers", {0.55F, 0.56F, 0.58F});
  Actor actor{.name = name, .semantic = SemanticClass::kDrone, .links = {}, .motion = fly};
  const double arm = span / std::sqrt(8.0);  // x and y of a rotor
  const double radius = 0.9 * arm;
  AddLink(actor, "body", 0, At(0, 0, 0), shell, Ellipsoid({0.30 * span, 0.17 * span, 0.11 * span}, 1.0));
  AddLink(actor, "camera", 0, At(0.24 * span, 0, -0.09 * span), dark, geometry::Sphere{0.06 * span});
  for (int i = 0; i < 4; ++i) {
    const double x = i < 2 ? arm : -arm;
    const double y = i % 2 == 0 ? arm : -arm;
    const std::string n = std::to_string(i);
    const double yaw = std::atan2(y, x);
    AddLink(actor, "arm" + n, 0, {base::FromYaw(yaw), {0.5 * x, 0.5 * y, 0.0}}, dark,
            geometry::Box{{0.25 * span, 0.025 * span, 0.02 * span}});
    AddLink(actor, "motor" + n, 0, At(x, y, 0.03 * span), dark, geometry::Cylinder{0.05 * span, 0.05 * span});
    AddLink(actor, "propeller" + n, 0, At(x, y, 0.09 * span), disc, geometry::Cylinder{radius, 0.004});
    AddLink(actor, "leg" + n, 0, At(0.6 * x, 0.6 * y, -0.12 * span), dark,
            geometry::Capsule{0.012 * span, 0.10 * span});
  }
  world.actors.push_back(std::move(actor));
}

void AddSwingingGate(World& world, int material, const std::string& name, const GatePlan& plan,
                     const DoorSwing& swing) {
  const double side = 0.5 * (plan.opening + plan.frame);  // from mid-opening to the middle of a bar
  const double bar = 0.5 * plan.frame;
  const Transform X_WG{base::FromYaw(plan.yaw), {plan.p.x(), plan.p.y(), plan.height}};
  constexpr double kPost = 0.06;  // m, its radius
  const double post = side + bar + kPost + 0.03;
  const double top = plan.height + side + bar + 0.05;
  AddObject(world, name + "/post", geometry::Cylinder{kPost, 0.5 * top}, X_WG * At(0.0, post, 0.5 * top - plan.height),
            material, 1.3, SemanticClass::kGate);
  AddObject(world, name + "/foot", geometry::Box{{0.35, 0.35, 0.02}}, X_WG * At(0.0, post, 0.02 - plan.height),
            material, 1.3, SemanticClass::kGate);

  // The hinge's axis is the joint's x, upright.
  const Transform X_WH = X_WG * Transform{base::Exp({0.0, -0.5 * kPi, 0.0}), {0.0, post, 0.0}};
  Actor actor{.name = name + "/frame",
              .semantic = SemanticClass::kGate,
              .links = {},
              .motion = Swing{X_WH, swing.amplitude, swing.period, swing.phase}};
  const auto part = [&](const char* what, const Vec3& p_G, const Vec3& half_extents) {
    actor.links.push_back({.name = what,
                           .shape = geometry::Box{half_extents},
                           .X_JL = X_WH.Inverse() * X_WG * Transform{base::Quat::Identity(), p_G},
                           .material = material,
                           .texture_scale = 1.3});
  };
  part("left", {0.0, side, 0.0}, {bar, bar, side + bar});
  part("right", {0.0, -side, 0.0}, {bar, bar, side + bar});
  part("top", {0.0, 0.0, side}, {bar, side - bar, bar});
  part("bottom", {0.0, 0.0, -side}, {bar, side - bar, bar});
  for (int i = 0; i < 2; ++i) {
    const double z = (i == 0 ? 0.7 : -0.7) * side;
    part(i == 0 ? "hinge_above" : "hinge_below", {0.0, 0.5 * (side + bar + post), z},
         {0.02, 0.5 * (post - side - bar), 0.03});
  }
  const auto index = static_cast<int>(world.actors.size());
  world.actors.push_back(std::move(actor));
  world.gates.push_back({name, X_WG, plan.opening, plan.frame, index});
}

}  // namespace alula::worlds

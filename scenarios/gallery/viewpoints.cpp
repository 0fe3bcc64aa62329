#include "scenarios/gallery/viewpoints.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/random.h"
#include "sim/physics_world.h"

namespace alula::scenarios::gallery {
namespace {

using base::Transform;
using base::Vec3;

constexpr double kEyeHeight = 1.4;  // m, above the start

/// A camera at p that looks along heading `yaw`, `down` below the horizon, rad.
Transform CameraAt(const Vec3& p, double yaw, double down = 0.0) {
  return {base::FromYawPitchRoll(yaw, down, 0.0) * base::ForwardCameraRotation(), p};
}

double Towards(const Vec3& from, const Vec3& to) { return std::atan2(to.y() - from.y(), to.x() - from.x()); }

/// A ball without mass, to ask for its clearance.
vehicles::VehicleBody Ball(double radius) {
  vehicles::VehicleBody body;
  vehicles::Part part;
  part.name = "ball";
  part.shape = geometry::Sphere{radius};
  part.collides = false;
  body.parts = {part};
  body.prescribed = true;
  return body;
}

/// From a corner of the bounds over the middle: as high as half the shorter side allows, or as the ceiling does.
Transform Overview(const worlds::World& world) {
  const sim::PhysicsWorld physics(world, Ball(0.1), {});
  const Vec3 start = world.X_WB_start.p + Vec3(0.0, 0.0, 0.5);
  const bool roofed = physics.CastRay(start, start + Vec3(0.0, 0.0, 100.0)).has_value();
  const Vec3 middle = 0.5 * (world.bounds_low + world.bounds_high);
  const Vec3 half = 0.5 * (world.bounds_high - world.bounds_low);
  const double reach = std::min(25.0, 0.92 * std::min(half.x(), half.y()));
  const double free = world.X_WB_start.p.z() + 0.6 * reach + 1.0;
  const double height = roofed ? std::min(world.bounds_high.z() - 0.15, free) : free;
  const Vec3 eye(middle.x() - reach, middle.y() - reach, height);
  const Vec3 look(middle.x(), middle.y(), world.X_WB_start.p.z());
  return CameraAt(eye, Towards(eye, look), std::atan2(eye.z() - look.z(), (look - eye).head<2>().norm()));
}

}  // namespace

stack::CameraIntrinsics WideCamera(int width, int height) {
  const double focal = 0.5 * width / std::tan(40.0 * std::numbers::pi / 180.0);
  return {width, height, focal, focal, 0.5 * (width - 1), 0.5 * (height - 1), {}};
}

std::vector<Viewpoint> NamedViewpoints(const worlds::World& world) {
  const Vec3 eye = world.X_WB_start.p + Vec3(0.0, 0.0, kEyeHeight);
  const double yaw = base::Yaw(world.X_WB_start.q);
  const Vec3 target = world.target + Vec3(0.0, 0.0, 0.3);
  const bool far = (target - eye).norm() > 1.0;
  return {{"start", CameraAt(eye, yaw)},
          {"start, behind", CameraAt(eye, yaw + std::numbers::pi)},
          {"target", CameraAt(target, far ? Towards(target, eye) : yaw + 0.5 * std::numbers::pi, 0.1)},
          {"overview", Overview(world)}};
}

std::vector<Transform> RandomViewpoints(const worlds::World& world, int count, std::uint64_t seed) {
  constexpr double kRadius = 0.4;  // m
  constexpr int kTries = 200;      // a viewpoint
  base::RandomStream random(seed, "gallery/views");
  sim::PhysicsWorld physics(world, Ball(kRadius), {});
  std::vector<Transform> views;
  for (int tried = 0; static_cast<int>(views.size()) < count; ++tried) {
    if (tried == kTries * count) throw base::InputError("world " + world.name + ": no free place to look from");
    const Vec3 above(random.Uniform(world.bounds_low.x(), world.bounds_high.x()),
                     random.Uniform(world.bounds_low.y(), world.bounds_high.y()), world.bounds_high.z());
    const double height = random.Uniform(0.8, 2.5);
    const double yaw = random.Uniform(-std::numbers::pi, std::numbers::pi);
    const auto below = physics.CastRay(above, {above.x(), above.y(), world.bounds_low.z() - 50.0});
    if (!below) continue;
    const Vec3 eye(above.x(), above.y(), std::min(below->point_W.z() + height, above.z()));
    physics.MovePrescribed({{base::Quat::Identity(), eye}, Vec3::Zero(), Vec3::Zero()});
    if (physics.HullClearance(0.01).distance > 0.0) views.push_back(CameraAt(eye, yaw));
  }
  return views;
}

}  // namespace alula::scenarios::gallery

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "base/random.h"
#include "render/camera_renderer.h"
#include "render/internal/gl_renderer.h"

namespace alula::render::test {

inline geometry::Material Plain(float grey) { return {"plain", Eigen::Vector3f::Constant(grey), nullptr}; }

/// A checker-board of 8×8 fields.
inline geometry::Material Checker(int side, std::uint8_t dark, std::uint8_t bright) {
  auto texture = std::make_shared<geometry::Texture>();
  texture->width = texture->height = side;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const std::uint8_t value = ((x * 8 / side) + (y * 8 / side)) % 2 == 0 ? bright : dark;
      texture->rgb.insert(texture->rgb.end(), 3, value);
    }
  }
  return {"checker", Eigen::Vector3f::Ones(), texture};
}

/// Light without direction, so that a surface shows its own grey.
inline worlds::Light Shadowless() {
  worlds::Light light;
  light.sun = 0.0F;
  light.ambient = 1.6F;
  return light;
}

inline void AddBox(worlds::World& world, const base::Transform& X_WO, const base::Vec3& half_extents, int material,
                   double texture_scale = 1.0) {
  world.objects.push_back({"box", geometry::Box{half_extents}, X_WO, material, texture_scale, true});
}

/// A camera at `eye` that looks at `target`, turned by `roll` about its axis; 80° across 640×480, off-centre.
inline View LookAt(const base::Vec3& eye, const base::Vec3& target, double roll = 0.0) {
  const base::Vec3 z = (target - eye).normalized();
  const base::Vec3 x = z.cross(base::Vec3::UnitZ()).normalized();
  base::Mat3 R_WC;
  R_WC << x, z.cross(x), z;
  View view;
  view.X_WC = {base::Quat(R_WC) * base::Exp(base::Vec3(0, 0, roll)), eye};
  view.intrinsics = {640, 480, 381.4, 380.2, 322.7, 236.9, {}};
  return view;
}

/// u, v of a point of the world under the view, px.
inline base::Vec2 Project(const View& view, const base::Vec3& p_W) {
  const base::Vec3 p_C = view.X_WC.Inverse() * p_W;
  return {view.intrinsics.fx * p_C.x() / p_C.z() + view.intrinsics.cx,
          view.intrinsics.fy * p_C.y() / p_C.z() + view.intrinsics.cy};
}

inline base::Transform RandomPose(base::RandomStream& random, const base::Vec3& low, const base::Vec3& high) {
  const base::Vec3 turn = random.GaussianVec3();
  return {base::Exp(turn),
          {random.Uniform(low.x(), high.x()), random.Uniform(low.y(), high.y()), random.Uniform(low.z(), high.z())}};
}

/// Ground, walls, and shapes of every kind at random poses, textured, under a low sun.
inline worlds::World Clutter(std::uint64_t seed, int count = 60) {
  base::RandomStream random(seed, "clutter");
  worlds::World world;
  world.materials = {Checker(256, 60, 180), Checker(128, 20, 230), Plain(0.7F), Plain(0.3F)};
  world.light.to_sun_W = base::Vec3(0.4, -0.5, 0.7).normalized();
  AddBox(world, {base::Quat::Identity(), {0, 0, -0.5}}, {15, 15, 0.5}, 0, 2.0);
  AddBox(world, {base::Quat::Identity(), {10.5, 0, 1.5}}, {0.25, 10, 1.5}, 1, 3.0);
  AddBox(world, {base::Quat::Identity(), {-10.5, 0, 1.5}}, {0.25, 10, 1.5}, 1, 3.0);
  for (int i = 0; i < count; ++i) {
    const double size = random.Uniform(0.1, 0.6);
    const std::array<geometry::Shape, 5> shapes = {
        geometry::Box{base::Vec3(size, 0.7 * size, 0.4 * size)}, geometry::Sphere{size},
        geometry::Cylinder{0.4 * size, size}, geometry::Capsule{0.3 * size, size}, geometry::Cone{0.7 * size, size}};
    world.objects.push_back({"clutter", shapes[random.Index(shapes.size())],
                             RandomPose(random, {-9, -9, 0.2}, {9, 9, 3.0}),
                             static_cast<int>(random.Index(world.materials.size())), 0.5, true});
  }
  return world;
}

inline std::unique_ptr<internal::GlContext> MakeContext(std::string_view maker) {
  return maker == "egl" ? internal::MakeEglContext() : internal::MakeOsMesaContext();
}

}  // namespace alula::render::test

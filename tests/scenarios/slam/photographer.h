#pragma once

#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "render/camera_renderer.h"
#include "render/sensor_effects.h"
#include "scenarios/factories.h"
#include "scenarios/gallery/viewpoints.h"
#include "stack/slam/relative_pose.h"

namespace alula::scenarios::slam::test {

inline constexpr double kDegree = std::numbers::pi / 180;

/// A stereo pair of 80° across and 0.11 m between the eyes.
inline stack::features::StereoRig Rig() {
  const stack::CameraIntrinsics camera = gallery::WideCamera(752, 480);
  return {camera, camera, {base::Quat::Identity(), {0.11, 0.0, 0.0}}};
}

/// A keyframe of a rendered world with what is true of it.
struct Keyframe {
  std::string world;
  base::Transform X_WC;
  stack::slam::PlaceView view;
};

/// Takes keyframes of one world of the catalog.
class Photographer {
 public:
  explicit Photographer(const std::string& name, std::uint64_t seed)
      : name_(name),
        random_(seed, "test/photographer"),
        world_(MakeWorld(LoadWorld(FindAny(name).file, {}, seed), seed)),
        renderer_(render::MakeRendererAtStart("auto", *world_, seed)) {}

  const worlds::World& world() const { return *world_; }

  Keyframe Take(const base::Transform& X_WC) {
    Keyframe keyframe{name_, X_WC, {}};
    const stack::features::StereoRig rig = Rig();
    keyframe.view = stack::slam::ViewOf(rig, Picture(rig.left, X_WC), Picture(rig.right, X_WC * rig.X_LR), {});
    // The vertical as an IMU knows it.
    keyframe.view.up_C =
        base::Exp(0.5 * kDegree * random_.GaussianVec3()) * base::Vec3(X_WC.q.conjugate() * base::Vec3::UnitZ());
    return keyframe;
  }

  /// From somewhere near: up to `metres` away on each axis and turned by up to `degrees`.
  base::Transform Near(const base::Transform& X_WC, double metres, double degrees) {
    const auto one = [&] { return random_.Uniform(-1.0, 1.0); };
    const base::Vec3 shift(metres * one(), metres * one(), metres * one());
    const base::Vec3 turn =
        degrees * kDegree * base::Vec3(0.4 * one(), one(), 0.4 * one());  // most about the camera's vertical
    return X_WC * base::Transform{base::Exp(turn), shift};
  }

  stack::Image Picture(const stack::CameraIntrinsics& camera, const base::Transform& X_WC) {
    render::Picture picture;
    render::View view;
    view.X_WC = X_WC;
    view.intrinsics = camera;
    renderer_->Grey(view, picture);
    render::ApplyPixelNoise(picture, random_.Bits(), {});
    stack::Image image;
    image.width = image.stride = picture.width;
    image.height = picture.height;
    image.bytes = std::make_shared<std::vector<std::uint8_t>>(std::move(picture.bytes));
    return image;
  }
  render::DepthPicture Depth(const stack::CameraIntrinsics& camera, const base::Transform& X_WC) {
    render::DepthPicture picture;
    render::View view;
    view.X_WC = X_WC;
    view.intrinsics = camera;
    renderer_->Depth(view, picture);
    return picture;
  }

 private:
  std::string name_;
  base::RandomStream random_;
  std::shared_ptr<const worlds::World> world_;
  std::unique_ptr<render::CameraRenderer> renderer_;
};

struct Error {
  double metres = 0.0, degrees = 0.0;
};
inline Error ErrorOf(const stack::slam::RelativePose& pose, const Keyframe& a, const Keyframe& b) {
  const base::Transform truth = a.X_WC.Inverse() * b.X_WC;
  return {(pose.X_AB.p - truth.p).norm(), base::Log(pose.X_AB.q.conjugate() * truth.q).norm() / kDegree};
}

}  // namespace alula::scenarios::slam::test

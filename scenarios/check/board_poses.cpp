#include "scenarios/check/board_poses.h"

#include <cmath>
#include <cstdlib>
#include <utility>

#include "scenarios/check/check_worlds.h"
#include "scenarios/check/rig.h"
#include "stack/interface/camera_model.h"

namespace alula::scenarios::check {
namespace {

using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kMargin = 3.0;  // px between border and edge of the picture

/// The board with its middle on the ray of a pixel, square to the ray but for a tilt, `share` of the picture's height
/// high.
Transform Aim(const stack::CameraIntrinsics& camera, const Vec2& pixel, double share, const Vec3& tilt) {
  const Vec3 ray = stack::Ray(camera, pixel);
  const double distance = 2.0 * Board::kHalfHeight * camera.fy / (share * camera.height);
  return {base::Quat::FromTwoVectors(Vec3::UnitZ(), ray) * base::Exp(tilt), distance * ray};
}

/// As near to the pixel as it can be without leaving the picture; smaller where it does not fit at all.
Transform AimInside(const stack::CameraIntrinsics& camera, const Vec2& target, double share, const Vec3& tilt) {
  const Vec2 middle(camera.cx, camera.cy);
  for (; share > 0.1; share *= 0.93) {
    for (double along = 1.0; along >= 0.0; along -= 0.02) {
      const Transform X_CT = Aim(camera, middle + along * (target - middle), share, tilt);
      if (BoardInside(camera, X_CT)) return X_CT;
    }
  }
  return Aim(camera, middle, share, tilt);
}

constexpr int kAveraged = 4;  // frames of one view, against noise

/// Frames of one view, added up.
struct Sum {
  Frame last;
  std::vector<std::uint32_t> grey;
  std::uint32_t count = 0;

  void Add(std::vector<Frame> frames) {
    for (Frame& frame : frames) {
      grey.resize(frame.grey.size());
      for (std::size_t i = 0; i < grey.size(); ++i) grey[i] += frame.grey[i];
      last = std::move(frame);
      ++count;
    }
  }
  Frame Mean() {
    for (std::size_t i = 0; i < grey.size(); ++i) {
      last.grey[i] = static_cast<std::uint8_t>((grey[i] + count / 2) / count);
    }
    return std::move(last);
  }
};

/// So many frames a pose that neither exposure, rolling nor an eye's offset reaches into the next one: an odd number.
int FramesAPose(const Rig& isolated, const CameraGroup& group) {
  const sim::CameraConfig& camera = ConfigOf(isolated.sensors, Only(group));
  const bool pair = group.kind == CameraGroup::Kind::kStereo;
  const std::int64_t offset = pair ? std::abs(isolated.sensors.stereo->eye_offset.ns) : 0;
  const double reach = 1e-9 * static_cast<double>(sim::HalfSpan(camera, camera.exposure).ns + offset) + 0.003;
  int frames = 1;
  while (0.5 * frames * camera.rate.Period() < reach) frames += 2;
  return frames;
}

}  // namespace

Vec3 BoardCorner(int n) {
  const int column = n % Board::kColumns, row = n / Board::kColumns;
  return Board::kSquare * Vec3(column - 0.5 * (Board::kColumns - 1), row - 0.5 * (Board::kRows - 1), 0.0);
}

std::vector<Vec2> ProjectBoard(const stack::CameraIntrinsics& camera, const Transform& X_CT) {
  std::vector<Vec2> pixels;
  for (int n = 0; n < Board::kColumns * Board::kRows; ++n) {
    pixels.push_back(stack::Project(camera, X_CT * BoardCorner(n)));
  }
  return pixels;
}

bool BoardInside(const stack::CameraIntrinsics& camera, const Transform& X_CT) {
  constexpr int kPoints = 5;  // along each half side: the sides bend
  const double limit = stack::LargestAngle(camera);
  const bool fisheye = camera.model == stack::DistortionModel::kEquidistant;
  for (int i = -kPoints; i <= kPoints; ++i) {
    const double along = static_cast<double>(i) / kPoints;
    for (const double side : {-1.0, 1.0}) {
      for (const Vec2& at : {Vec2(along, side), Vec2(side, along)}) {
        const Vec3 p_C = X_CT * Vec3(at.x() * Board::kHalfWidth, at.y() * Board::kHalfHeight, 0.0);
        if (!fisheye && p_C.z() < 0.05) return false;
        if (std::atan2(p_C.head<2>().norm(), p_C.z()) > 0.98 * limit) return false;
        if (!stack::Inside(camera, stack::Project(camera, p_C), kMargin)) return false;
      }
    }
  }
  return true;
}

std::vector<Transform> BoardPoses(const stack::CameraIntrinsics& camera) {
  constexpr double kSmall = 0.5, kLarge = 0.9;  // share of the picture's height
  constexpr int kGrid = 4;
  std::vector<Transform> poses;
  const auto tilt_of = [](std::size_t n) {
    constexpr double kTilts[5][3] = {{25, 0, 4}, {0, 28, -7}, {-25, 10, 8}, {8, -28, 0}, {-14, -16, -5}};
    const double* t = kTilts[n % 5];
    return Vec3(kDegree * Vec3(t[0], t[1], t[2]));
  };
  for (int row = 0; row < kGrid; ++row) {
    for (int column = 0; column < kGrid; ++column) {
      const Vec2 target(camera.width * (column + 0.0) / (kGrid - 1), camera.height * (row + 0.0) / (kGrid - 1));
      poses.push_back(AimInside(camera, target, kSmall, tilt_of(poses.size())));
    }
  }
  for (int i = 0; i < 5; ++i) {
    poses.push_back(AimInside(camera, {camera.cx, camera.cy}, kLarge, 1.2 * tilt_of(poses.size())));
  }
  return poses;
}

BoardSession RecordBoard(const Rig& isolated, const CameraGroup& group, render::CameraRenderer& renderer) {
  const std::vector<CameraGeometry> cameras = GeometryOf(isolated, group);
  const sim::CameraConfig& config = ConfigOf(isolated.sensors, Only(group));
  const base::Rate rate = config.rate;
  const int settle = FramesAPose(isolated, group), hold = settle + kAveraged - 1;
  BoardSession session;
  for (const CameraGeometry& camera : cameras) {  // each eye has its turn
    for (const Transform& X_CT : BoardPoses(camera.intrinsics)) {
      session.X_WB.push_back(BodyPose(ChartPose() * X_CT.Inverse(), camera.X_BC));
    }
  }
  const auto views = static_cast<std::int64_t>(session.X_WB.size());
  const Motion motion = [&](base::Time t) {
    const std::int64_t view = std::min(NearestFrame(rate, t) / hold, views - 1);
    return vehicles::BodyState{session.X_WB[static_cast<std::size_t>(view)], Vec3::Zero(), Vec3::Zero()};
  };
  const base::Duration all = rate.SampleTime(views * hold) - base::Time{} + config.read_out + base::Milliseconds(60);
  std::vector<std::vector<Sum>> sums(cameras.size(), std::vector<Sum>(session.X_WB.size()));
  Record(isolated, &renderer, motion, all, [&](stack::Measurement&& m) {
    const std::size_t view = m.seq / static_cast<std::uint32_t>(hold);
    const int within = static_cast<int>(m.seq % static_cast<std::uint32_t>(hold)) - settle / 2;
    if (within < 0 || within >= kAveraged || view >= session.X_WB.size()) return;
    for (std::size_t eye = 0; eye < cameras.size(); ++eye) {
      if (m.sensor == cameras[eye].sensor) sums[eye][view].Add(FramesOf({m}));
    }
  });
  for (std::vector<Sum>& eye : sums) {
    session.frames.emplace_back();
    for (Sum& sum : eye) session.frames.back().push_back(sum.Mean());
  }
  return session;
}

}  // namespace alula::scenarios::check

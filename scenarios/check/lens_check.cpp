#include "scenarios/check/lens_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/error.h"
#include "scenarios/check/board_poses.h"
#include "scenarios/check/check_worlds.h"
#include "scenarios/check/statistics.h"
#include "stack/interface/camera_model.h"

namespace alula::scenarios::check {
namespace {

using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kLeastViews = 12;

/// Corners by view; empty where the board was not found.
using Views = std::vector<std::vector<Vec2>>;

Views FindBoards(const BoardSession& session, std::size_t eye, const CameraGeometry& claimed) {
  Views views;
  for (std::size_t i = 0; i < session.X_WB.size(); ++i) {
    const Transform X_CT = (session.X_WB[i] * claimed.X_BC).Inverse() * ChartPose();
    std::optional<std::vector<Vec2>> found;
    // A board that is cut off is not looked for: the search would take its time.
    if (!session.frames[eye][i].grey.empty() && BoardInside(claimed.intrinsics, X_CT)) {
      found = FindBoard(session.frames[eye][i], ProjectBoard(claimed.intrinsics, X_CT));
    }
    views.push_back(found.value_or(std::vector<Vec2>{}));
  }
  return views;
}

template <typename T>
std::vector<T> Where(const std::vector<T>& values, const std::vector<bool>& keep) {
  std::vector<T> kept;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (keep[i]) kept.push_back(values[i]);
  }
  return kept;
}

std::vector<bool> Seen(const Views& views) {
  std::vector<bool> seen;
  for (const auto& view : views) seen.push_back(!view.empty());
  return seen;
}

/// Empties views whose corners lie much farther from the model than those of most views: the search for a corner has
/// settled on something else there. A lens that is not what it is taken for spoils all views alike, and they stay.
bool SetOutliersAside(const CalibratedCamera& camera, Views& views) {
  constexpr double kTimes = 5.0;  // the median view's error
  std::vector<double> errors(views.size(), 0.0), found;
  std::size_t pose = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].empty()) continue;
    const std::vector<Vec2> expected = ProjectBoard(camera.intrinsics, camera.X_CT[pose++]);
    for (std::size_t n = 0; n < expected.size(); ++n) errors[i] += (views[i][n] - expected[n]).squaredNorm();
    found.push_back(errors[i]);
  }
  std::nth_element(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2), found.end());
  const double most = kTimes * kTimes * found[found.size() / 2];
  bool any = false;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (errors[i] <= most) continue;
    views[i].clear();
    any = true;
  }
  return any;
}

/// The tangential coefficients go together; k3 and k4 are sought where they are configured.
LensKind KindOf(const stack::CameraIntrinsics& claimed) {
  const std::array<double, 5>& k = claimed.distortion;
  const bool fisheye = claimed.model == stack::DistortionModel::kEquidistant;
  return {claimed.width, claimed.height, claimed.model,
          fisheye ? std::array<bool, 5>{true, true, k[2] != 0.0, k[3] != 0.0, false}
                  : std::array<bool, 5>{true, true, true, true, k[4] != 0.0}};
}

/// Mean and largest distance between the pixels that two models give to one ray, over the picture as far from the axis
/// as corners were found (beyond, coefficients are not measured but extrapolated), once the measured camera is turned
/// so that they fit best: a shift of the centre is a turn of the mount, which has a row of its own.
struct Difference {
  double mean = 0.0, largest = 0.0;
  double share = 0.0;  // of the picture
};

/// The greatest angle to the axis at which a corner was found, rad.
double ReachOf(const Views& views, const stack::CameraIntrinsics& claimed) {
  double reach = 0.0;
  for (const auto& corners : views) {
    for (const Vec2& corner : corners) {
      const Vec3 ray = stack::Ray(claimed, corner);
      if (ray.allFinite()) reach = std::max(reach, std::atan2(ray.head<2>().norm(), ray.z()));
    }
  }
  return reach;
}

/// Pixels of the measured model for rays turned by `turn`, less those of the claimed one; two rows a ray.
Eigen::VectorXd PixelDifferences(const stack::CameraIntrinsics& measured, const std::vector<Vec2>& pixels,
                                 const std::vector<Vec3>& rays, const Vec3& turn) {
  Eigen::VectorXd differences(2 * static_cast<Eigen::Index>(pixels.size()));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    differences.segment<2>(2 * static_cast<Eigen::Index>(i)) =
        stack::Project(measured, base::Exp(turn) * rays[i]) - pixels[i];
  }
  return differences;
}

Difference DifferenceOf(const stack::CameraIntrinsics& claimed, const stack::CameraIntrinsics& measured, double reach) {
  constexpr int kSteps = 24;
  std::vector<Vec2> pixels;
  std::vector<Vec3> rays;
  double inside = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Vec2 pixel((claimed.width - 1.0) * i / kSteps, (claimed.height - 1.0) * j / kSteps);
      const Vec3 ray = stack::Ray(claimed, pixel);
      if (!ray.allFinite() || !stack::Project(measured, ray).allFinite()) continue;
      ++inside;
      if (std::atan2(ray.head<2>().norm(), ray.z()) > reach) continue;
      pixels.push_back(pixel);
      rays.push_back(ray);
    }
  }
  constexpr double h = 1e-5;  // rad
  Vec3 turn = Vec3::Zero();
  for (int pass = 0; pass < 3; ++pass) {
    Eigen::MatrixXd J(2 * static_cast<Eigen::Index>(pixels.size()), 3);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 d = h * Vec3::Unit(axis);
      J.col(axis) =
          (PixelDifferences(measured, pixels, rays, turn + d) - PixelDifferences(measured, pixels, rays, turn - d)) /
          (2.0 * h);
    }
    turn -= LeastSquares(J, PixelDifferences(measured, pixels, rays, turn)).x;
  }
  const Eigen::VectorXd left = PixelDifferences(measured, pixels, rays, turn);
  Difference difference{.share = static_cast<double>(pixels.size()) / inside};
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double distance = left.segment<2>(2 * static_cast<Eigen::Index>(i)).norm();
    difference.mean += distance / static_cast<double>(pixels.size());
    difference.largest = std::max(difference.largest, distance);
  }
  return difference;
}

void AddOptics(const CameraGeometry& claimed, const CalibratedCamera& found, double reach, Report& report) {
  const stack::CameraIntrinsics &c = claimed.intrinsics, &m = found.intrinsics;
  // Corners are found to some hundredths of a pixel, with errors that are not all random: the floors.
  const auto add = [&](const char* name, double configured, double measured, double sigma, double floor,
                       const char* unit) {
    report.Add(Compare(claimed.name, name, configured, measured, floor + kSigmas * sigma, unit));
  };
  add("fx", c.fx, m.fx, found.optics_sigma[0], 3e-4 * c.fx, "px");
  add("fy", c.fy, m.fy, found.optics_sigma[1], 3e-4 * c.fy, "px");
  add("cx", c.cx, m.cx, found.optics_sigma[2], 0.05, "px");
  add("cy", c.cy, m.cy, found.optics_sigma[3], 0.05, "px");
  const bool fisheye = c.model == stack::DistortionModel::kEquidistant;
  constexpr const char* kBrown[] = {"k1", "k2", "p1", "p2", "k3"};
  constexpr const char* kFisheye[] = {"k1", "k2", "k3", "k4", ""};
  const LensKind kind = KindOf(c);
  for (std::size_t i = 0; i < 5; ++i) {
    if (!kind.free[i]) continue;
    add(fisheye ? kFisheye[i] : kBrown[i], c.distortion[i], m.distortion[i], found.distortion_sigma[i], 1e-4, "1");
  }
  report.Add(Compare(claimed.name, "reprojection RMSE", 0.0, found.rmse, 0.1, "px"));
  const Difference difference = DifferenceOf(c, m, reach);
  report.Add(Compare(claimed.name, "share of the picture within the corners' reach", 1.0, difference.share, 0.35, "1"));
  report.Add(Compare(claimed.name, "lens model's difference, mean", 0.0, difference.mean, 0.15, "px"));
  report.Add(Compare(claimed.name, "lens model's difference, largest", 0.0, difference.largest, 0.4, "px"));
}

/// Mean of poses that differ little, with the standard error of angle (rad) and place (m).
struct MeanPose {
  Transform X;
  double angle_error = 0.0, place_error = 0.0;
};
MeanPose Average(const std::vector<Transform>& poses) {
  MeanPose mean{poses.front()};
  const auto n = static_cast<double>(poses.size());
  for (int pass = 0; pass < 3; ++pass) {
    Vec3 turn = Vec3::Zero(), place = Vec3::Zero();
    double turns = 0.0, places = 0.0;
    for (const Transform& pose : poses) {
      const Vec3 d = base::Log(mean.X.q.conjugate() * pose.q);
      turn += d / n;
      place += pose.p / n;
      turns += d.squaredNorm();
      places += (pose.p - mean.X.p).squaredNorm();
    }
    mean.X = {mean.X.q * base::Exp(turn), place};
    mean.angle_error = std::sqrt(turns / (n * (n - 1.0)));
    mean.place_error = std::sqrt(places / (n * (n - 1.0)));
  }
  return mean;
}

/// An error of the centre or the focal length moves all views alike: turn and distance of the board come with it.
void AddMount(const CameraGeometry& claimed, const MeanPose& mount, const CalibratedCamera& camera, Report& report) {
  const stack::CameraIntrinsics& k = claimed.intrinsics;
  const double turn = std::hypot(camera.optics_sigma[2] / k.fx, camera.optics_sigma[3] / k.fy);
  double distance = 0.0;
  for (const Transform& X_CT : camera.X_CT) distance += X_CT.p.norm() / static_cast<double>(camera.X_CT.size());
  const double place_error = std::hypot(mount.place_error, distance * camera.optics_sigma[0] / k.fx);
  const double angle_error = std::hypot(mount.angle_error, turn);
  constexpr const char* kPlaces[] = {"position x in the body", "position y in the body", "position z in the body"};
  for (int i = 0; i < 3; ++i) {
    report.Add(Compare(claimed.name, kPlaces[i], claimed.X_BC.p[i], mount.X.p[i], 5e-4 + kSigmas * place_error, "m"));
  }
  const double angle = base::Log(claimed.X_BC.q.conjugate() * mount.X.q).norm() / kDegree;
  report.Add(Compare(claimed.name, "mount's angle to the configured one", 0.0, angle,
                     0.01 + kSigmas * angle_error / kDegree, "deg"));
}

/// One eye's views: corners and poses X_CT of the board by view (both meaningless where it was not found).
struct EyeViews {
  Views corners;
  std::vector<Transform> X_CT;
  double focal_error = 0.0;   // relative
  double centre_error = 0.0;  // rad
};

EyeViews ByView(Views corners, const CalibratedCamera& camera) {
  EyeViews eye{std::move(corners),
               {},
               camera.optics_sigma[0] / camera.intrinsics.fx,
               std::hypot(camera.optics_sigma[2], camera.optics_sigma[3]) / camera.intrinsics.fx};
  std::size_t found = 0;
  for (const auto& view : eye.corners) eye.X_CT.push_back(view.empty() ? Transform{} : camera.X_CT[found++]);
  return eye;
}

void AddPair(const std::vector<CameraGeometry>& claimed, const std::vector<CameraGeometry>& measured,
             const std::vector<EyeViews>& eyes, Report& report) {
  std::vector<bool> both;
  std::vector<Transform> each;  // pose of the right eye in the left one, by view
  double distance = 0.0;
  for (std::size_t i = 0; i < eyes[0].corners.size(); ++i) {
    both.push_back(!eyes[0].corners[i].empty() && !eyes[1].corners[i].empty());
    if (!both.back()) continue;
    each.push_back(eyes[0].X_CT[i] * eyes[1].X_CT[i].Inverse());
    distance += eyes[0].X_CT[i].p.norm();
  }
  const std::string name = std::string(kVehicle) + "/stereo";
  const Transform X_LR = claimed[0].X_BC.Inverse() * claimed[1].X_BC;
  const double baseline = X_LR.p.norm();
  if (each.size() < kLeastViews) {
    report.Add(Compare(name, "baseline", baseline, kNothing, 0.0, "m"));
    return;
  }
  distance /= static_cast<double>(each.size());
  const Transform found = CalibratePair(measured[0].intrinsics, measured[1].intrinsics, Where(eyes[0].corners, both),
                                        Where(eyes[1].corners, both));
  // Errors: what the views scatter by, and what all of them take over from focal lengths and centres.
  const MeanPose scatter = Average(each);
  const double along = kSigmas * scatter.place_error / std::sqrt(3.0);
  const double depth = distance * std::hypot(eyes[0].focal_error, eyes[1].focal_error);
  const double direction = kSigmas * std::hypot(scatter.place_error, depth) / baseline / kDegree;
  const double turn = kSigmas * std::hypot(scatter.angle_error, eyes[0].centre_error, eyes[1].centre_error) / kDegree;
  const double aside = std::acos(std::clamp(found.p.normalized().dot(X_LR.p.normalized()), -1.0, 1.0)) / kDegree;
  report.Add(Compare(name, "baseline", baseline, found.p.norm(), 1e-3 * baseline + along, "m"));
  report.Add(Compare(name, "direction of the baseline", 0.0, aside, 0.1 + direction, "deg"));
  report.Add(Compare(name, "turn between the eyes", base::Log(X_LR.q).norm() / kDegree,
                     base::Log(found.q).norm() / kDegree, 0.02 + turn, "deg"));
}

}  // namespace

std::vector<CameraGeometry> CheckLens(const Rig& isolated, const CameraGroup& group,
                                      const std::vector<CameraGeometry>& claimed, Report& report) {
  const auto renderer = render::MakeRenderer(isolated.render, BoardWorld(), {});
  const BoardSession session = RecordBoard(isolated, group, *renderer);
  std::vector<CameraGeometry> measured = claimed;
  std::vector<EyeViews> eyes;
  for (std::size_t eye = 0; eye < claimed.size(); ++eye) {
    Views corners = FindBoards(session, eye, claimed[eye]);
    const auto enough = [&] {
      const Views found = Where(corners, Seen(corners));
      if (found.size() >= kLeastViews) return true;
      report.Add(Compare(claimed[eye].name, "views of the board that are found", kLeastViews,
                         static_cast<double>(found.size()), 0.0, "1"));
      return false;
    };
    const auto calibrate = [&] {
      return CalibrateCamera(KindOf(claimed[eye].intrinsics), Where(corners, Seen(corners)));
    };
    if (!enough()) return claimed;
    CalibratedCamera camera = calibrate();
    if (SetOutliersAside(camera, corners)) {
      if (!enough()) return claimed;
      camera = calibrate();
    }
    const std::vector<bool> seen = Seen(corners);
    const Views found = Where(corners, seen);
    AddOptics(claimed[eye], camera, ReachOf(found, claimed[eye].intrinsics), report);
    std::vector<Transform> mounts;
    const std::vector<Transform> bodies = Where(session.X_WB, seen);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      mounts.push_back(bodies[i].Inverse() * ChartPose() * camera.X_CT[i].Inverse());
    }
    const MeanPose mount = Average(mounts);
    AddMount(claimed[eye], mount, camera, report);
    measured[eye].intrinsics = camera.intrinsics;
    measured[eye].X_BC = mount.X;
    eyes.push_back(ByView(std::move(corners), camera));
  }
  if (claimed.size() == 2) AddPair(claimed, measured, eyes, report);
  return measured;
}

}  // namespace alula::scenarios::check

// The cameras against the physics, and against the inertial unit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

#include "base/random.h"
#include "render/camera_renderer.h"
#include "sim/physics_world.h"
#include "sim/sensors/optics.h"
#include "sim/sensors/suite.h"
#include "tests/sim/test_world.h"
#include "vehicles/prescribed.h"
#include "worlds/courtyard.h"

namespace alula::sim {
namespace {

using base::Vec3;

/// Mesa reads these when its first context is made.
const bool kEnvironment = [] {
  ::setenv("LP_NUM_THREADS", "0", 1);
  ::setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
  return true;
}();

/// Bullet and the renderer are built from one geometry: whatever a pixel sees, a ray hits at the same depth.
TEST(Cameras, RenderedDepthIsWhereBulletsRaysEnd) {
  const worlds::World world = worlds::MakeWorld({}, 3);
  vehicles::VehicleBody body = testing::PlateOnLegs();
  body.prescribed = true;
  const PhysicsWorld physics(world, body, testing::At({0, 0, 50}));
  const auto renderer = render::MakeRenderer("auto", world, {});
  StereoCameraConfig camera;
  const stack::CameraIntrinsics k = IntrinsicsOf(camera);
  base::RandomStream random(5, "test/depth");
  int compared = 0, different = 0;
  render::DepthPicture depth;
  for (int pose = 0; pose < 8; ++pose) {
    const Vec3 p(random.Uniform(-12, 12), random.Uniform(-7, 7), random.Uniform(0.8, 2.8));
    const base::Quat q =
        base::FromYawPitchRoll(random.Uniform(-3.1, 3.1), random.Uniform(-0.2, 0.3), random.Uniform(-0.2, 0.2));
    const base::Transform X_WC = base::Transform{q, p} * EyePose(camera, 0);
    renderer->Depth({.X_WC = X_WC, .intrinsics = k}, depth);
    for (int i = 0; i < 400; ++i) {
      const int u = static_cast<int>(random.Index(640)), v = static_cast<int>(random.Index(480));
      const Vec3 ray((u - k.cx) / k.fx, (v - k.cy) / k.fy, 1.0);  // unit depth
      const auto hit = physics.CastRay(X_WC.p, X_WC * Vec3(60.0 * ray));
      const double seen = static_cast<double>(depth.metres[static_cast<std::size_t>(v) * 640 + u]);
      const double ray_depth = hit ? hit->distance / ray.norm() : 0.0;
      ++compared;
      // Round solids are drawn with 24 facets: up to r (1 − cos 7.5°) ≈ 1 % of their radius, seen at a slant; pixels on
      // an edge may see either side.
      if (std::abs(seen - ray_depth) > 0.03 + 0.01 * ray_depth) ++different;
    }
  }
  EXPECT_EQ(compared, 3200);
  EXPECT_LT(different, compared / 50);
}

using Motion = std::function<vehicles::BodyState(base::Time)>;

vehicles::BodyState AlongX(base::Time t) { return testing::At({2.0 * t.Seconds(), 0, 1}); }

/// What a suite measures over 130 ms.
std::vector<stack::Measurement> Record(const SensorsConfig& config, render::CameraRenderer& renderer, int workers,
                                       const Motion& motion = AlongX) {
  SensorSuite suite(config, testing::PlateOnLegs(), base::Milliseconds(1), 9, "vehicle0", &renderer, workers);
  std::vector<stack::Measurement> all, measurements;
  TruthWindow window{{0}, {0}, motion({0}), motion({0})};
  suite.Settle(window.at_end);
  for (int i = 0; i < 130; ++i) {
    suite.Measure(window, {});
    suite.Collect(window.end, measurements);
    all.insert(all.end(), measurements.begin(), measurements.end());
    const base::Time next = window.end + base::Milliseconds(1);
    window = {window.end, next, window.at_end, motion(next)};
    suite.Integrate(next, window.at_begin, window.at_end);
  }
  return all;
}

/// All pictures of one sensor, one after another; of all sensors without an id.
std::vector<std::uint8_t> BytesOf(const std::vector<stack::Measurement>& measurements,
                                  std::optional<stack::SensorId> sensor = std::nullopt) {
  std::vector<std::uint8_t> bytes;
  for (const stack::Measurement& m : measurements) {
    const auto* image = std::get_if<stack::Image>(&m.data);
    if (image == nullptr || (sensor && m.sensor != *sensor)) continue;
    bytes.insert(bytes.end(), image->bytes->begin(), image->bytes->end());
  }
  return bytes;
}

SensorsConfig SmallStereo() {
  SensorsConfig config;
  config.stereo = StereoCameraConfig{};
  config.stereo->width = 160;
  config.stereo->height = 120;
  return config;
}

TEST(Cameras, ThreadChangesNoByte) {
  const worlds::World world = testing::GroundAndCrate();
  SensorsConfig config = SmallStereo();
  config.stereo->motion_blur = true;
  config.stereo->auto_exposure = AutoExposureConfig{};
  const auto renderer = render::MakeRenderer("auto", world, {});
  const std::vector<std::uint8_t> here = BytesOf(Record(config, *renderer, 1));
  EXPECT_EQ(here.size(), 6U * 160 * 120);
  EXPECT_EQ(here, BytesOf(Record(config, *renderer, 2)));
}

/// A right eye that is 5 ms late sees what it would see if the whole flight were 5 ms ahead; every second frame only
/// where every second one is late.
TEST(Cameras, LateEyeSeesWhatComesLater) {
  const worlds::World world = testing::GroundAndCrate();
  const auto renderer = render::MakeRenderer("raster", world, {});
  const Motion sideways = [](base::Time t) { return testing::At({0, 10.0 * t.Seconds() - 0.5, 1}); };
  const Motion ahead = [&](base::Time t) { return sideways(t + base::Milliseconds(5)); };
  SensorsConfig config = SmallStereo();
  const stack::SensorId left{10}, right{11};
  const auto prompt = Record(config, *renderer, 1, sideways), shifted = Record(config, *renderer, 1, ahead);
  config.stereo->eye_offset = base::Milliseconds(5);
  const auto late = Record(config, *renderer, 1, sideways);
  EXPECT_EQ(BytesOf(late, left), BytesOf(prompt, left));
  EXPECT_EQ(BytesOf(late, right), BytesOf(shifted, right));
  EXPECT_TRUE(BytesOf(late, right) != BytesOf(prompt, right));
  config.stereo->eye_offset_every = 2;
  const auto now_and_then = BytesOf(Record(config, *renderer, 1, sideways), right);
  const auto always = BytesOf(late, right), never = BytesOf(prompt, right);
  const std::ptrdiff_t frame = 160 * 120;
  EXPECT_TRUE(std::equal(always.begin(), always.begin() + frame, now_and_then.begin()));
  EXPECT_TRUE(std::equal(never.begin() + frame, never.begin() + 2 * frame, now_and_then.begin() + frame));
}

/// A camera on a gimbal that looks straight down sees what one that is screwed on looking down sees.
TEST(Cameras, GimbalTurnsTheCamera) {
  const worlds::World world = testing::GroundAndCrate();
  const auto renderer = render::MakeRenderer("raster", world, {});
  NamedCameraConfig camera;
  camera.name = "down";
  camera.width = 160;
  camera.height = 120;
  camera.position = {0.03, 0, 0};
  camera.pitch = 1.0;
  SensorsConfig fixed;
  fixed.cameras = {camera};
  fixed.cameras[0].position = base::FromYawPitchRoll(0, 0.5, 0) * camera.position + Vec3(0.1, 0, -0.05);
  fixed.cameras[0].pitch = 1.5;
  SensorsConfig turned;
  turned.cameras = {camera};
  turned.cameras[0].gimbal = "belly";
  turned.gimbals.resize(1);
  turned.gimbals[0].name = "belly";
  turned.gimbals[0].position = {0.1, 0, -0.05};
  turned.gimbals[0].start = {0, 0.5, 0};
  const auto a = BytesOf(Record(fixed, *renderer, 1)), b = BytesOf(Record(turned, *renderer, 1));
  ASSERT_EQ(a.size(), b.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different += std::abs(a[i] - b[i]) > 1;
  EXPECT_LT(different, a.size() / 1000);  // the two poses are equal but for rounding
}

TEST(Cameras, SeesTheVehicleWhereItIsToldTo) {
  const worlds::World world = testing::GroundAndCrate();
  std::vector<render::Mover> movers;
  for (const vehicles::Part& part : testing::PlateOnLegs().parts)
    movers.push_back({part.name, part.shape, part.material});
  const auto renderer = render::MakeRenderer("raster", world, movers);
  SensorsConfig config;
  config.cameras.resize(1);
  config.cameras[0].name = "down";
  config.cameras[0].kind = stack::CameraKind::kColour;
  config.cameras[0].pitch = 1.57;
  config.cameras[0].position = {0, 0, -0.03};  // under the plate, between the legs
  config.cameras[0].fov = 2.4;
  const auto blind = BytesOf(Record(config, *renderer, 1));
  EXPECT_EQ(blind.size(), 3U * 640 * 480 * 3);
  config.cameras[0].sees_vehicle = true;
  const auto seeing = BytesOf(Record(config, *renderer, 1));
  std::size_t different = 0;
  for (std::size_t i = 0; i < blind.size(); ++i) different += blind[i] != seeing[i];
  EXPECT_GT(different, blind.size() / 500);  // four thin legs
}

/// A crate 2.9 m off, seen by an RGB-D camera: depth in the pixels that the calibration says, registered or not.
TEST(Cameras, RgbdMeasuresDepthInThePixelsItSays) {
  const worlds::World world = testing::GroundAndCrate();
  const auto renderer = render::MakeRenderer("raster", world, {});
  for (const bool registered : {true, false}) {
    SensorsConfig config;
    config.rgbd.resize(1);
    RgbdCameraConfig& camera = config.rgbd[0];
    camera.name = "front";
    camera.depth.registered = registered;
    camera.depth.width = 320;
    camera.depth.height = 240;
    camera.depth.light.farthest = 5;
    camera.depth.light.holes = 0;
    camera.depth.light.disparity_noise = 0;
    camera.depth.light.disparity_step = 0.01;
    const stack::Calibration truth = TrueCalibration(config, testing::PlateOnLegs(), "vehicle0");
    ASSERT_EQ(truth.cameras.size(), 2U);
    const stack::CameraCalibration& depth = truth.cameras[1];
    EXPECT_EQ(depth.kind, stack::CameraKind::kDepth);
    EXPECT_EQ(depth.intrinsics.width, registered ? 640 : 320);
    int images = 0, seen = 0;
    const auto still = [](base::Time) { return testing::At({0, 0, 0.6}); };
    for (const stack::Measurement& m : Record(config, *renderer, 1, still)) {
      const auto* image = std::get_if<stack::DepthImage>(&m.data);
      if (image == nullptr) continue;
      ++images;
      const base::Transform X_WC = base::Transform{base::Quat::Identity(), {0, 0, 0.6}} * depth.X_BC;
      const stack::CameraIntrinsics& k = depth.intrinsics;
      for (int v = 0; v < image->height; v += 5) {
        for (int u = 0; u < image->width; u += 5) {
          const double z = 1e-3 * (*image->millimetres)[static_cast<std::size_t>(v * image->width + u)];
          if (z == 0) continue;
          const Vec3 p = X_WC * Vec3(z * (u - k.cx) / k.fx, z * (v - k.cy) / k.fy, z);
          const bool on_crate = std::abs(p.x() - 3) < 0.02, on_ground = std::abs(p.z()) < 0.03;
          EXPECT_TRUE(on_crate || on_ground || std::abs(p.z() - 1) < 0.02) << p.transpose();
          seen += on_crate;
        }
      }
    }
    EXPECT_GE(images, 2);
    EXPECT_GT(seen, 100);
  }
}

/// The pattern of a depth camera does not come back from glass; the ground about it is measured as before.
TEST(Cameras, RgbdMeasuresNoDepthOnGlass) {
  worlds::World world = testing::GroundAndCrate();
  world.light.sun = 0.1F;  // on white ground it would drown the pattern
  SensorsConfig config;
  config.rgbd.resize(1);
  config.rgbd[0].name = "front";
  config.rgbd[0].depth.registered = false;
  config.rgbd[0].depth.light.farthest = 5;
  const auto measured = [&] {
    const auto renderer = render::MakeRenderer("raster", world, {});
    std::vector<std::uint16_t> first;
    for (const stack::Measurement& m : Record(config, *renderer, 1)) {
      const auto* image = std::get_if<stack::DepthImage>(&m.data);
      if (image != nullptr && first.empty()) first = *image->millimetres;
    }
    return first;
  };
  const std::vector<std::uint16_t> wood = measured();
  world.objects[1].semantic = worlds::SemanticClass::kGlass;
  const std::vector<std::uint16_t> glass = measured();
  ASSERT_EQ(wood.size(), glass.size());
  std::size_t lost = 0, kept = 0;
  for (std::size_t i = 0; i < wood.size(); ++i) {
    lost += wood[i] != 0 && glass[i] == 0;
    kept += wood[i] != 0 && glass[i] == wood[i];
    EXPECT_TRUE(glass[i] == 0 || glass[i] == wood[i]);
  }
  EXPECT_GT(lost, wood.size() / 50);
  EXPECT_GT(kept, wood.size() / 50);
}

/// What is lost does not come, what is stuck shows the frame before, what is late comes late.
TEST(Cameras, FramesAreLostStuckAndLate) {
  const worlds::World world = testing::GroundAndCrate();
  const auto renderer = render::MakeRenderer("raster", world, {});
  SensorsConfig config = SmallStereo();
  config.stereo->faults.drop = 1.0;
  EXPECT_TRUE(BytesOf(Record(config, *renderer, 1)).empty());
  config.stereo->faults = {.drop = 0, .late = 1.0, .late_by = base::Milliseconds(30), .freeze = 0, .freeze_frames = 1};
  for (const stack::Measurement& m : Record(config, *renderer, 1)) {
    if (!std::holds_alternative<stack::Image>(m.data)) continue;
    EXPECT_GT(m.available, m.captured + config.stereo->read_out);
    EXPECT_LE(m.available, m.captured + config.stereo->read_out + base::Milliseconds(30));
  }
  config.stereo->faults = {.drop = 0, .late = 0, .late_by = {}, .freeze = 1.0, .freeze_frames = 3};
  const auto stuck = BytesOf(Record(config, *renderer, 1), stack::SensorId{10});
  const std::ptrdiff_t frame = 160 * 120;
  ASSERT_EQ(static_cast<std::ptrdiff_t>(stuck.size()), 3 * frame);
  EXPECT_TRUE(std::equal(stuck.begin(), stuck.begin() + frame, stuck.begin() + frame));
  EXPECT_TRUE(std::equal(stuck.begin(), stuck.begin() + frame, stuck.begin() + 2 * frame));
}

/// A dark ball before a bright sky, high above the ground: its centroid is a landmark to about a
/// tenth of a pixel (it is 5 px across its radius, and seen off the axis its centre lies 0.07 px from the ball's).
worlds::World BallInTheSky(const Vec3& p_W) {
  worlds::World world;
  world.name = "ball";
  world.materials.push_back({.name = "dark", .colour = {0.02F, 0.02F, 0.02F}, .texture = nullptr});
  world.objects.push_back({.name = "ball", .shape = geometry::Sphere{0.12}, .X_WO = {base::Quat::Identity(), p_W}});
  world.light.sky = {1, 1, 1};
  return world;
}

/// Centroid of darkness; nothing where the ball is cut off or away.
std::optional<base::Vec2> Centroid(const stack::Image& image) {
  double weight = 0, su = 0, sv = 0;
  int low_u = image.width, high_u = -1, low_v = image.height, high_v = -1;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const double dark = 255.0 - image.Row(v)[u];
      if (dark < 200.0) continue;  // the ground below the horizon is grey, the ball is black
      weight += dark;
      su += dark * u;
      sv += dark * v;
      low_u = std::min(low_u, u), high_u = std::max(high_u, u);
      low_v = std::min(low_v, v), high_v = std::max(high_v, v);
    }
  }
  const bool cut = low_u < 2 || low_v < 2 || high_u > image.width - 3 || high_v > image.height - 3;
  if (weight < 5000.0 || cut) return std::nullopt;
  return base::Vec2(su / weight, sv / weight);
}

/// Rotation of the body from t0 to t1 out of gyro samples alone, trapezoids between their stamps.
base::Quat GyroTurn(const std::vector<std::pair<base::Time, Vec3>>& gyro, base::Time t0, base::Time t1) {
  const auto at = [&](base::Time t) {
    const auto after =
        std::lower_bound(gyro.begin(), gyro.end(), t, [](const auto& s, base::Time x) { return s.first < x; });
    const auto before = std::prev(after);
    const double s = (t - before->first).Seconds() / (after->first - before->first).Seconds();
    return Vec3((1 - s) * before->second + s * after->second);
  };
  base::Quat q = base::Quat::Identity();
  constexpr int kParts = 50;
  for (int i = 0; i < kParts; ++i) {
    const double dt = (t1 - t0).Seconds() / kParts;
    q = q * base::Exp(dt * at(t0 + base::Seconds((i + 0.5) * dt)));
  }
  return q;
}

/// Where a landmark goes in the picture over half a second is what gyro and velocity say: cameras, IMU and their stamps
/// describe one motion. A time shift δ between them shows as f δ |ω(t1) − ω(t0)|: 1 ms here is about 0.7 px.
TEST(Cameras, OpticalFlowAgreesWithGyroAndVelocity) {
  const Vec3 ball(9, 0, 30);
  const worlds::World world = BallInTheSky(ball);
  vehicles::SineMotion motion;
  motion.start = {0, 0, 30};
  motion.terms = {{{0.8, 0.8, 0.4}, 0.25, {0, 1.0, 2.0}}};
  motion.yaw_amplitude = 0.35;
  motion.yaw_frequency = 0.5;
  motion.ramp = 1.0;
  motion.flight_time = 6.0;
  vehicles::PrescribedConfig config;
  config.standstill = 0.2;
  config.motion = motion;
  config.attitude = vehicles::SineAttitude{0.15, 0.6, 0.12, 0.7};
  const auto vehicle = vehicles::MakePrescribed(config, "vehicle0");

  SensorsConfig sensors;
  sensors.imu->noise = {};
  sensors.stereo = StereoCameraConfig{};
  sensors.stereo->noise = {0.0, 0.0};
  const stack::Calibration truth = TrueCalibration(sensors, vehicle->body(), "vehicle0");
  const auto renderer = render::MakeRenderer("auto", world, {});
  SensorSuite suite(sensors, vehicle->body(), base::Milliseconds(1), 1, "vehicle0", renderer.get(), 1);

  std::vector<std::pair<base::Time, Vec3>> gyro;
  std::vector<std::pair<base::Time, std::optional<base::Vec2>>> seen;
  std::vector<stack::Measurement> measurements;
  TruthWindow window{{0}, {0}, vehicle->Prescribed({0}), vehicle->Prescribed({0})};
  suite.Settle(window.at_end);
  for (int i = 0; i < 5500; ++i) {
    suite.Measure(window, {});
    suite.Collect(window.end, measurements);
    for (const stack::Measurement& m : measurements) {
      if (const auto* imu = std::get_if<stack::ImuSample>(&m.data))
        gyro.emplace_back(m.captured, imu->angular_velocity);
      const auto* image = std::get_if<stack::Image>(&m.data);
      if (image != nullptr && m.sensor == truth.cameras[0].sensor) seen.emplace_back(m.captured, Centroid(*image));
    }
    const base::Time next = window.end + base::Milliseconds(1);
    window = {window.end, next, window.at_end, vehicle->Prescribed(next)};
    suite.Integrate(next, window.at_begin, window.at_end);
  }

  const stack::CameraIntrinsics& k = truth.cameras[0].intrinsics;
  const base::Transform& X_BC = truth.cameras[0].X_BC;
  int compared = 0;
  double largest = 0.0, fastest = 0.0;
  constexpr std::size_t kFrames = 10;
  double squares = 0.0;
  for (std::size_t i = 0; i + kFrames < seen.size(); ++i) {
    const auto& [t0, c0] = seen[i];
    const auto& [t1, c1] = seen[i + kFrames];
    if (!c0 || !c1 || t0 < gyro.front().first || t1 > gyro.back().first) continue;
    // The landmark in the first camera from its picture and its true distance, carried on by gyro and velocity.
    const vehicles::BodyState s0 = vehicle->Prescribed(t0);
    const double range = (s0.X_WB * X_BC.p - ball).norm();
    const Vec3 p_C0 = range * Vec3((c0->x() - k.cx) / k.fx, (c0->y() - k.cy) / k.fy, 1.0).normalized();
    Vec3 moved_W = Vec3::Zero();
    for (base::Time t = t0; t < t1; t += base::Milliseconds(1)) {
      moved_W += 1e-3 * vehicle->Prescribed(t + base::Microseconds(500)).v_WB;
    }
    const Vec3 moved_B0 = s0.X_WB.q.conjugate() * moved_W;
    const Vec3 p_B1 = GyroTurn(gyro, t0, t1).conjugate() * Vec3(X_BC * p_C0 - moved_B0);
    const Vec3 p_C1 = X_BC.Inverse() * p_B1;
    const base::Vec2 expected(k.fx * p_C1.x() / p_C1.z() + k.cx, k.fy * p_C1.y() / p_C1.z() + k.cy);
    largest = std::max(largest, (expected - *c1).norm());
    squares += (expected - *c1).squaredNorm();
    fastest = std::max(fastest, (*c1 - *c0).norm());
    ++compared;
  }
  EXPECT_GT(compared, 60);
  EXPECT_GT(fastest, 100.0);  // px: there was something to agree on
  EXPECT_LT(largest, 0.4);    // px, two centroids' errors
  EXPECT_LT(std::sqrt(squares / compared), 0.2);
}

/// Mean of |a − b|, grey levels.
double MeanDifference(const stack::Image& a, const stack::Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.bytes->size(); ++i) sum += std::abs((*a.bytes)[i] - (*b.bytes)[i]);
  return sum / static_cast<double>(a.bytes->size());
}

/// A flight past the things of the courtyard that turns and shakes: 2 m/s, 1.5 rad/s, and 40 Hz of ±0.4°.
Instant ShakingFlight(base::Time t) {
  const double s = t.Seconds();
  const base::Quat q = base::FromYawPitchRoll(1.5 * s, 0.007 * std::sin(2 * M_PI * 40 * s), 0.4 * s);
  const base::Transform X_WB{q, {-6 + 2 * s, -5, 1.5}};
  return {X_WB * MountPose(CameraConfig{}), X_WB};
}

class Shutter : public ::testing::TestWithParam<bool> {};  // with rolling rows, or without

/// The instants and bands that PlanExposure takes give the picture that 64 instants a band, and a band a row or two,
/// give. The bound is what rounding a mean to grey levels leaves (0.25 of a level in the mean), doubled.
TEST_P(Shutter, ShowsWhatSixtyFourSubFramesShow) {
  const worlds::World world = worlds::MakeWorld({}, 3);
  const auto renderer = render::MakeRenderer("raster", world, {});
  CameraConfig config;
  config.noise = {0.0, 0.0};
  config.motion_blur = true;
  config.exposure = base::Milliseconds(6);
  if (GetParam()) {
    config.width = 320;
    config.height = 240;
    config.row_delay = base::Microseconds(60);
  }
  const stack::CameraIntrinsics k = IntrinsicsOf(config);
  const Optics optics = MakeOptics(config, k, nullptr, "camera", 1, {}, world.light);
  const auto plan = [&](base::Time t, double step) {
    return PlanExposure(config, optics.intrinsics.fx, {config.exposure, 1.0}, t, ShakingFlight, step);
  };
  for (const double at : {0.5, 1.7}) {
    const Exposure used = plan(base::Time{} + base::Seconds(at), 0.75);
    const Exposure finest = plan(base::Time{} + base::Seconds(at), 1e-3);
    EXPECT_EQ(finest.slices[0].instants.size(), 64U);
    EXPECT_LT(used.slices[0].instants.size(), 20U);
    const stack::Image a = TakeImage(optics, used, *renderer);
    const stack::Image b = TakeImage(optics, finest, *renderer);
    const Exposure::Slice sharp{0, config.height, {ShakingFlight(used.captured)}};
    const stack::Image c = TakeImage(optics, {0, used.captured, used.setting, {sharp}}, *renderer);
    std::printf("%zu bands of %zu instants: mean difference %.3f levels; without blur and rolling %.3f\n",
                used.slices.size(), used.slices[0].instants.size(), MeanDifference(a, b), MeanDifference(c, b));
    EXPECT_LT(MeanDifference(a, b), 0.5);
    EXPECT_GT(MeanDifference(c, b), 1.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Shutter, ::testing::Bool(),
                         [](const auto& kind) { return kind.param ? "Rolling" : "Global"; });

}  // namespace
}  // namespace alula::sim

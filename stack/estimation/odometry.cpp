#include "stack/estimation/odometry.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <optional>

#include "base/error.h"
#include "base/random.h"
#include "stack/estimation/eye_delay.h"
#include "stack/estimation/input_guard.h"
#include "stack/estimation/internal/sliding_window.h"
#include "stack/estimation/static_initialiser.h"
#include "stack/estimation/steady_motion.h"
#include "stack/features/line_segments.h"
#include "stack/features/line_stereo.h"
#include "stack/features/line_tracks.h"
#include "stack/features/pose_ransac.h"
#include "stack/features/stereo_tracker.h"
#include "stack/features/translation_ransac.h"

namespace alula::stack::estimation {
namespace {

using base::Mat3;
using base::Mat6;
using base::Time;
using base::Transform;
using base::Vec2;
using base::Vec3;
using features::Track;

constexpr double kRansacGate = 3.0;       // px
constexpr int kRansacTrials = 40;         // two points: 80 % inliers fail with 1e-18
constexpr double kFewAgree = 0.4;         // of the points: fewer, and the gyroscope is asked about
constexpr double kUnsureOfBias = 0.005;   // rad/s, of the gyroscope's
constexpr double kSaturatedGyro = 1.0;    // rad/s/√Hz: how far a saturated reading may be off
constexpr double kSaturatedAccel = 10.0;  // m/s²/√Hz
constexpr int kPoseTrials = 100;          // three points: 60 % inliers fail with 1e-10

/// Processor time of a scope in ms, for profiling alone.
class StageClock {
 public:
  explicit StageClock(double& total) : total_(total), begin_(Now()) {}
  ~StageClock() { total_ += Now() - begin_; }
  StageClock(const StageClock&) = delete;
  StageClock& operator=(const StageClock&) = delete;

 private:
  static double Now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
  }
  double& total_;
  double begin_;
};

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

SensorSet Checked(const Calibration& calibration, const OdometryConfig& config) {
  SensorSet set = ChooseSensors(calibration, config.sensors);
  if (config.lines.enabled && set.rig.depth != features::DepthSource::kStereo)
    throw base::InputError("odometry.lines.enabled: lines need a stereo pair");
  return set;
}

/// Where there is none: steady motion of the body itself.
ImuCalibration ImuOf(const SensorSet& set, const MotionConfig& motion) {
  if (set.imu) return *set.imu;
  ImuCalibration steady;
  steady.noise = SteadyNoise(motion);
  return steady;
}

/// What these sensors cannot tell is not estimated.
WindowConfig Adapted(WindowConfig window, const SensorSet& set) {
  constexpr double kHeld = 1e-6;
  if (set.rig.depth != features::DepthSource::kStereo) window.eye_rotation_sigma = kHeld;
  if (set.imu) return window;
  window.camera_rotation_sigma = window.time_offset_sigma = kHeld;
  window.imu_noise_scale = 1.0;
  return window;
}

Vec3 GravityOf(const SensorSet& set) { return {0, 0, set.imu ? -base::kGravity : 0.0}; }

/// Between neighbours, s.
double LargestGap(const std::vector<TimedImu>& samples) {
  double gap = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i)
    gap = std::max(gap, (samples[i].time - samples[i - 1].time).Seconds());
  return gap;
}

}  // namespace

class Odometry::Impl {
 public:
  Impl(const Calibration& calibration, const OdometryConfig& config, const Transform& X_OB_start)
      : config_(config),
        sensors_(Checked(calibration, config)),
        rig_(sensors_.rig),
        imu_(ImuOf(sensors_, config.motion)),
        gravity_(GravityOf(sensors_)),
        X_OB_start_(X_OB_start),
        tracker_(rig_, config.tracker),
        window_(rig_, imu_.X_BI.Inverse() * sensors_.X_BC, imu_.noise, Adapted(config.window, sensors_), config.lines,
                gravity_) {
    if (rig_.depth == features::DepthSource::kStereo && sensors_.imu) eye_delay_.emplace(rig_);
  }

  FrameResult Process(const FrameInput& input) {
    ++timing_.frames;
    FrameResult result;
    result.seq = input.seq;
    result.reset_counter = reset_counter_;
    TakeSamples(input, result);
    if (samples_.empty()) {
      result.note = "no inertial samples yet";
    } else if (last_stamp_ && input.stamp <= *last_stamp_) {
      result.note = "image is not newer than the one before";
    } else if (holding_ && StandsStill(input)) {
      Hold(input, result);
    } else if (running_) {
      holding_ = false;
      Run(input, result);
    } else if (sensors_.imu) {
      Initialise(input, result);
    } else {
      BeginAtOnce(input, result);
    }
    if (!last_stamp_ || input.stamp > *last_stamp_) {
      last_stamp_ = input.stamp;
      last_left_ = input.left;
    }
    if (running_) Report(result);
    return result;
  }

  const SensorSet& sensors() const { return sensors_; }
  CalibrationEstimate Rig() const {
    CalibrationEstimate rig = window_.Rig();
    if (eye_delay_) rig.eye_delay = eye_delay_->usual();
    return rig;
  }
  OdometryTiming Timing() const { return timing_; }

 private:
  void TakeSamples(const FrameInput& input, FrameResult& result) {
    if (!sensors_.imu) {
      if (!last_stamp_ || input.stamp > *last_stamp_)
        samples_ = SteadySamples(last_stamp_.value_or(input.stamp), input.stamp, rate_);
      return;
    }
    constexpr Time kLongAgo{std::numeric_limits<std::int64_t>::min()};
    for (const TimedImu& s : Sound(input.imu, samples_.empty() ? kLongAgo : samples_.back().time, result.note))
      samples_.push_back(s);
  }

  // --- beginning --------------------------------------------------------------------------------------------------

  void BeginAtOnce(const FrameInput& input, FrameResult& result) {
    tracker_.Follow(input.left, input.right, Transform(), input.depth);
    ImuState state;
    state.stamp = input.stamp;
    state.X_OI = X_OB_start_ * imu_.X_BI;
    Begin(state, SteadyStart());
    result.inliers = result.tracked = tracker_.ReferenceCount();
    if (result.inliers < config_.static_init.min_features) {
      result.note = "too few corners to begin";
      return;
    }
    result.keyframe = true;
    running_ = true;
  }

  /// Any speed is possible; what stands for an IMU has no biases.
  StartSigmas SteadyStart() const {
    StartSigmas sigmas;
    sigmas.tilt = sigmas.heading;
    sigmas.velocity = config_.failure.max_speed;
    sigmas.gyro_bias = sigmas.accel_bias = 1e-6;
    return sigmas;
  }

  double FlowOf(const std::vector<Track>& tracks) const {
    std::vector<double> flow;
    for (const Track& t : tracks) flow.push_back((t.left - t.reference).norm() * rig_.left.fx);
    return Median(std::move(flow));
  }

  bool StandsStill(const FrameInput& input) {
    tracks_ = tracker_.Follow(input.left, input.right, Transform(), input.depth);
    return static_cast<int>(tracks_.size()) >= config_.static_init.min_features &&
           FlowOf(tracks_) <= config_.static_init.max_median_flow;
  }

  /// One camera learns nothing of depth before it moves: the window begins anew with every image until then.
  void Hold(const FrameInput& input, FrameResult& result) {
    ImuState state = window_.Newest();
    state.stamp = input.stamp;
    window_.Start(state, StandingSigmas(), Sightings(tracks_));
    last_keyframe_ = last_seeing_ = state.stamp;
    std::erase_if(samples_, [&](const TimedImu& s) { return s.time < input.stamp - base::Milliseconds(100); });
    result.inliers = result.tracked = static_cast<int>(tracks_.size());
    View(tracks_, result);
  }

  StartSigmas StandingSigmas() const {
    StartSigmas sigmas;
    sigmas.tilt = config_.window.tilt_sigma;
    sigmas.gyro_bias = 1e-3;  // the mean of a second, rotors turning
    if (imu_.noise.accelerometer_turn_on_bias > 0) sigmas.accel_bias = imu_.noise.accelerometer_turn_on_bias;
    return sigmas;
  }

  void Initialise(const FrameInput& input, FrameResult& result) {
    const std::vector<Track> tracks = tracker_.Follow(input.left, input.right, Transform(), input.depth);
    result.tracked = static_cast<int>(tracks.size());
    const bool few = result.tracked < config_.static_init.min_features;
    const bool moves = FlowOf(tracks) > config_.static_init.max_median_flow;
    if (!still_since_ || few || moves) {
      result.note = !still_since_ ? "waiting for standstill" : few ? "too few corners to judge standstill" : "moving";
      tracker_.MakeReference();
      still_since_ = input.stamp;
      std::erase_if(samples_, [&input](const TimedImu& s) { return s.time < input.stamp; });
      return;
    }
    if ((input.stamp - *still_since_).Seconds() < config_.static_init.duration) {
      result.note = "standing still, averaging";
      return;
    }
    const double yaw = base::Yaw(X_OB_start_.q);
    const std::optional<StandstillState> standing =
        FromStandstill(Cut(samples_, *still_since_, input.stamp), imu_.X_BI.q.conjugate(), yaw);
    if (!standing) {
      result.note = "images stand still, the IMU does not read gravity alone";
      still_since_.reset();
      return;
    }
    ImuState state;
    state.stamp = input.stamp;
    state.X_OI.q = standing->q_OI;
    const base::Quat q_OB = standing->q_OI * imu_.X_BI.q.conjugate();
    state.X_OI.p = X_OB_start_.p + q_OB * imu_.X_BI.p;
    state.gyro_bias = standing->gyro_bias;
    Begin(state, StandingSigmas());
    holding_ = rig_.depth == features::DepthSource::kNone;
    result.inliers = result.tracked;
    result.keyframe = true;
    running_ = true;
  }

  /// (Re)starts the window at a state, with the newest pair as keyframe.
  void Begin(const ImuState& state, const StartSigmas& sigmas) {
    window_.Start(state, sigmas, Sightings(tracker_.MakeReference()));
    last_keyframe_ = last_seeing_ = state.stamp;
    X_OC_reference_ = window_.Newest().X_OI * window_.X_IC();
    window_covariance_ = window_.NewestCovariance();
  }

  // --- flying -----------------------------------------------------------------------------------------------------

  /// The same image again, and it showed something, though by the gyroscope the body has turned since. How far it went
  /// is no such sign: a wrong speed would be believed for ever.
  bool Frozen(const FrameInput& input, const ImuState& predicted) {
    if (!sensors_.imu || last_tracked_ == 0 || !Repeats(last_left_, input.left)) {
      first_of_repeated_.reset();
      return false;
    }
    if (!first_of_repeated_) first_of_repeated_ = window_.Newest();
    const double turn = base::Log(first_of_repeated_->X_OI.q.conjugate() * predicted.X_OI.q).norm();
    const double unsure = kUnsureOfBias * (predicted.stamp - first_of_repeated_->stamp).Seconds();
    return turn > config_.guard.frozen_turn + unsure;
  }

  void Run(const FrameInput& input, FrameResult& result) {
    const ImuState before = window_.Newest();
    const std::vector<TimedImu> samples = Cut(samples_, before.stamp, input.stamp);
    if (samples_.back().time < input.stamp) result.note = "inertial samples end before the image";
    std::erase_if(samples_, [&](const TimedImu& s) { return s.time < input.stamp - base::Milliseconds(100); });
    ImuState predicted = Propagate(before, samples, gravity_);
    if (const double gap = LargestGap(samples); sensors_.imu && gap > config_.failure.max_imu_gap) {
      Follow(input, predicted, result);
      Restart(predicted, samples.back(), gap, result);
      return;
    }

    const Saturation saturation = SaturationOf(samples, imu_.noise, config_.guard.saturation);
    if (saturation.any())
      result.note = saturation.gyro ? "the gyroscope is saturated" : "the accelerometer is saturated";
    trusts_turn_ = sensors_.imu && !saturation.gyro;
    const bool frozen = Frozen(input, predicted);
    if (frozen) result.note = "the images are frozen";
    std::vector<Track> tracks = frozen ? std::vector<Track>() : Follow(input, predicted, result);
    const bool keyframe = !frozen && KeyframeDue(tracks, predicted);
    if (keyframe) {
      const StageClock clock(timing_.detect);
      tracks = tracker_.MakeReference();
      last_keyframe_ = input.stamp;
    }
    BringEyesTogether(predicted, samples.back().gyro, tracks, result);
    const std::vector<LineSighting> lines = frozen ? std::vector<LineSighting>() : SeeLines(input, predicted, keyframe);
    bool solved = false;
    {
      const StageClock clock(timing_.solve);
      window_.AddFrame(samples, Sightings(tracks), keyframe, lines,
                       trusts_turn_ ? std::nullopt : std::optional(predicted.X_OI), NoiseWith(saturation));
      solved = window_.Solve();
      tracker_.Drop(window_.RejectOutliers());
    }
    const double dt = (input.stamp - before.stamp).Seconds();
    if (!sensors_.imu) rate_ = base::Log(before.X_OI.q.conjugate() * window_.Newest().X_OI.q) / dt;
    result.inliers = 0;
    for (const Track& t : tracks) result.inliers += window_.SeenInNewest(t.id) ? 1 : 0;
    result.inliers += window_.UsedLines();
    if (keyframe) X_OC_reference_ = window_.Newest().X_OI * window_.X_IC();
    result.keyframe = keyframe;
    if (keyframe) {
      for (const ImuState& s : window_.KeyframesBefore())
        result.window.push_back({s.stamp, s.X_OI * imu_.X_BI.Inverse()});
    }
    View(tracks, result);

    const std::string failure = Failure(solved, predicted, input.stamp, result.inliers);
    if (!failure.empty()) {
      Reset(predicted, failure, result);
      return;
    }
    {
      const StageClock clock(timing_.covariance);
      if (timing_.frames % kCovariancePeriod == 0 || keyframe) window_covariance_ = window_.NewestCovariance();
    }
    const StageClock clock(timing_.marginalise);
    window_.Slide();
  }

  /// Corners in the new images, without those that do not move as the scene does. Where nothing but the images tells
  /// how the camera turned, they correct the prediction.
  std::vector<Track> Follow(const FrameInput& input, ImuState& predicted, FrameResult& result) {
    const StageClock clock(timing_.track);
    const Transform X_OC = predicted.X_OI * window_.X_IC();
    std::vector<Track> tracks = tracker_.Follow(input.left, input.right, X_OC_reference_.Inverse() * X_OC, input.depth);
    result.tracked = last_tracked_ = static_cast<int>(tracks.size());

    std::vector<features::PointAndRay> points;
    std::vector<std::size_t> index;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      const std::optional<Vec3> p_O = window_.Landmark(tracks[i].id);
      if (!p_O) continue;
      index.push_back(i);
      points.push_back({*p_O, tracks[i].left});
    }
    const std::vector<bool> inlier = trusts_turn_ ? AgreeingWithTurn(points, X_OC.Inverse(), input.seq)
                                                  : AgreeingWithPose(points, X_OC.Inverse(), input.seq, predicted);
    std::vector<std::uint64_t> outliers;
    for (std::size_t k = 0; k < index.size(); ++k) {
      if (!inlier[k]) outliers.push_back(tracks[index[k]].id);
    }
    tracker_.Drop(outliers);
    std::erase_if(tracks, [&outliers](const Track& t) {
      return std::find(outliers.begin(), outliers.end(), t.id) != outliers.end();
    });
    return tracks;
  }

  std::vector<bool> AgreeingWithTurn(const std::vector<features::PointAndRay>& points, const Transform& X_CO,
                                     std::uint32_t seq) {
    std::vector<features::TurnedPoint> turned;
    for (const features::PointAndRay& p : points) turned.push_back({X_CO.q * p.p, p.seen});
    base::RandomStream random(seq, "odometry/translation_ransac");
    features::TranslationResult motion =
        features::FindTranslation(turned, X_CO.p, kRansacGate / rig_.left.fx, kRansacTrials, random);
    const int count = static_cast<int>(points.size());
    if (motion.inliers > kFewAgree * count) {
      verdict_ = watch_.Update(count, motion.inliers, motion.inliers);
      return std::move(motion.inlier);
    }
    base::RandomStream second(seq, "odometry/pose_ransac");
    const features::PoseResult pose = features::FindPose(points, X_CO, kRansacGate / rig_.left.fx, kPoseTrials, second);
    verdict_ = watch_.Update(count, motion.inliers, pose.inliers);
    return std::move(motion.inlier);
  }

  /// What a saturated sensor read is less than what was.
  std::optional<ImuNoise> NoiseWith(const Saturation& saturation) const {
    if (!saturation.any()) return std::nullopt;
    ImuNoise noise = window_.noise();
    if (saturation.gyro) noise.gyro_noise = kSaturatedGyro;
    noise.accelerometer_noise = kSaturatedAccel;  // turned wrongly where the gyroscope is the one
    return noise;
  }

  /// Where the right eye sees later than the left one, what it saw is moved back.
  void BringEyesTogether(const ImuState& predicted, const Vec3& gyro, std::vector<Track>& tracks, FrameResult& result) {
    if (!eye_delay_) return;
    const Vec3 w_I = gyro - predicted.gyro_bias;
    const Transform X_IR = window_.X_IC() * rig_.X_LR;
    const base::Quat q_RI = X_IR.q.conjugate();
    const EyeMotion motion{q_RI * Vec3(predicted.X_OI.q.conjugate() * predicted.v_OI + w_I.cross(X_IR.p)), q_RI * w_I};
    const double delay = eye_delay_->Update(tracks, motion);
    if (std::abs(delay) > config_.guard.eye_delay && result.note.empty()) {
      char text[80];
      std::snprintf(text, sizeof text, "the right eye sees about %.0f ms %s than the left one",
                    5.0 * std::round(200.0 * std::abs(delay)), delay > 0 ? "later" : "sooner");
      result.note = text;
    }
    if (delay == 0.0 || !config_.guard.compensate_eye_delay) return;
    for (Track& track : tracks) {
      if (track.right && track.depth > 0.0) *track.right -= delay * eye_delay_->Velocity(track, motion);
    }
  }

  std::vector<bool> AgreeingWithPose(const std::vector<features::PointAndRay>& points, const Transform& X_CO,
                                     std::uint32_t seq, ImuState& predicted) const {
    base::RandomStream random(seq, "odometry/pose_ransac");
    const features::PoseResult pose = features::FindPose(points, X_CO, kRansacGate / rig_.left.fx, kPoseTrials, random);
    if (pose.inliers >= config_.failure.min_inliers) predicted.X_OI = pose.X_TS.Inverse() * window_.X_IC().Inverse();
    return pose.inlier;
  }

  /// Lines of the window where they are seen now; in a keyframe also those that are new, by both eyes.
  std::vector<LineSighting> SeeLines(const FrameInput& input, const ImuState& predicted, bool keyframe) {
    const LinesConfig& c = config_.lines;
    if (!c.enabled) return {};
    const StageClock clock(timing_.detect);
    const std::vector<features::LineSegment> left = features::DetectLines(input.left, c.detect);
    const Transform X_CO = (predicted.X_OI * window_.X_IC()).Inverse();
    std::vector<features::ExpectedLine> expected;
    for (const KnownLine& known : window_.Lines()) {
      const auto segment = features::ExpectSegment(rig_.left, X_CO * known.ends_O[0], X_CO * known.ends_O[1]);
      if (segment) expected.push_back({known.track, *segment});
    }
    std::vector<std::optional<LineSighting>> of_segment(left.size());
    const auto seen_by = [](const CameraIntrinsics& camera, const features::LineSegment& s) {
      return SeenSegment{Normalise(camera, s.a), Normalise(camera, s.b)};
    };
    for (const features::FollowedLine& followed : features::FollowLines(expected, left, c.track)) {
      const auto i = static_cast<std::size_t>(followed.segment);
      of_segment[i] = LineSighting{followed.id, seen_by(rig_.left, left[i]), {}, {}};
    }
    if (keyframe) {
      const std::vector<features::LineSegment> right = features::DetectLines(input.right, c.detect);
      for (const features::StereoLine& match :
           features::MatchLines(rig_, input.left, input.right, left, right, c.stereo)) {
        const auto i = static_cast<std::size_t>(match.left);
        if (!of_segment[i]) of_segment[i] = LineSighting{++newest_line_, seen_by(rig_.left, left[i]), {}, match.ends_L};
        of_segment[i]->right = seen_by(rig_.right, right[static_cast<std::size_t>(match.right)]);
      }
    }
    std::vector<LineSighting> lines;
    for (const std::optional<LineSighting>& one : of_segment) {
      if (one) lines.push_back(*one);
    }
    return lines;
  }

  bool KeyframeDue(const std::vector<Track>& tracks, const ImuState& predicted) const {
    const KeyframeConfig& c = config_.keyframe;
    const double age = (predicted.stamp - last_keyframe_).Seconds();
    const double count = static_cast<double>(tracks.size());
    if (age > c.max_age || count < c.min_track_share * tracker_.ReferenceCount()) return true;
    // In a blind stretch every image would be a keyframe; twice a second is enough to look for corners again.
    if (count < c.min_tracks && age > 0.5) return true;
    const base::Quat q_CR = (X_OC_reference_.q.conjugate() * predicted.X_OI.q * window_.X_IC().q).conjugate();
    std::vector<double> flow, parallax;
    for (const Track& t : tracks) {
      flow.push_back((t.left - t.reference).norm());
      const Vec3 turned = q_CR * Vec3(t.reference.homogeneous());
      if (turned.z() > 0.1) parallax.push_back((turned.head<2>() / turned.z() - t.left).norm());
    }
    return Median(std::move(parallax)) * rig_.left.fx > c.min_parallax ||
           Median(std::move(flow)) * rig_.left.fx > c.max_flow;
  }

  static std::vector<Sighting> Sightings(const std::vector<Track>& tracks) {
    std::vector<Sighting> sightings;
    for (const Track& t : tracks) sightings.push_back({t.id, t.left, t.right});
    return sightings;
  }

  // --- failing ----------------------------------------------------------------------------------------------------

  std::string Failure(bool solved, const ImuState& predicted, Time stamp, int inliers) {
    const FailureConfig& c = config_.failure;
    const ImuState state = window_.Newest();
    const double blind = (stamp - last_seeing_).Seconds();
    if (inliers >= c.min_inliers) last_seeing_ = stamp;
    failed_solves_ = solved ? 0 : failed_solves_ + 1;
    if (verdict_ == MotionWatch::Verdict::kFitsNothing) return "what the images show fits no motion";
    if (verdict_ == MotionWatch::Verdict::kTurnsOtherwise)
      return "the images turn otherwise than the gyroscope: is the camera's pose on the body right?";
    if (failed_solves_ > 3) return "the solver failed repeatedly";
    if (blind > (sensors_.imu ? c.max_blind_time : config_.motion.max_blind_time)) return "blind for too long";
    if (state.gyro_bias.norm() > c.max_gyro_bias) return "gyroscope bias out of range";
    if (state.accel_bias.norm() > c.max_accel_bias) return "accelerometer bias out of range";
    if (state.v_OI.norm() > c.max_speed) return "speed out of range";
    if ((state.X_OI.p - predicted.X_OI.p).norm() > c.max_jump) return "the solution left the IMU's prediction";
    return {};
  }

  /// Starts anew where the IMU says that the vehicle is.
  void Reset(const ImuState& predicted, const std::string& why, FrameResult& result) {
    ImuState state = predicted;
    state.accel_bias.setZero();
    if (state.gyro_bias.norm() > config_.failure.max_gyro_bias) state.gyro_bias.setZero();
    if (state.v_OI.norm() > config_.failure.max_speed) state.v_OI.setZero();
    StartSigmas sigmas;
    sigmas.tilt = 0.05;
    sigmas.velocity = 0.5;
    sigmas.gyro_bias = 0.01;
    sigmas.accel_bias = 0.3;
    if (!sensors_.imu) {
      sigmas = SteadyStart();
      rate_.setZero();
      state.v_OI.setZero();
    }
    BeginAnew(state, sigmas, why, result);
  }

  /// Starts anew after a stretch of which nothing is known: the vehicle may have been carried anywhere. Biases stay;
  /// what is up says the accelerometer, roughly; heading and place are guesses.
  void Restart(const ImuState& predicted, const TimedImu& newest, double gap, FrameResult& result) {
    ImuState state = window_.Newest();
    state.stamp = predicted.stamp;
    state.v_OI.setZero();
    const Vec3 up_I = (newest.accel - state.accel_bias).normalized();
    state.X_OI.q = (base::Quat::FromTwoVectors(state.X_OI.q * up_I, Vec3::UnitZ()) * state.X_OI.q).normalized();
    StartSigmas sigmas;
    sigmas.tilt = 0.15;
    sigmas.velocity = 2.0;
    sigmas.gyro_bias = 0.003;
    sigmas.accel_bias = 0.1;
    char text[80];
    std::snprintf(text, sizeof text, "inertial samples are missing for %.1f s", gap);
    BeginAnew(state, sigmas, text, result);
  }

  void BeginAnew(const ImuState& state, const StartSigmas& sigmas, const std::string& why, FrameResult& result) {
    Begin(state, sigmas);
    failed_solves_ = 0;
    watch_.Restart();
    verdict_ = MotionWatch::Verdict::kFits;
    ++reset_counter_;
    result.keyframe = true;
    result.window.clear();
    result.reset_counter = reset_counter_;
    result.note = "reset: " + why;
  }

  // --- reporting --------------------------------------------------------------------------------------------------

  void Report(FrameResult& result) const {
    const ImuState s = window_.Newest();
    const Transform X_IB = imu_.X_BI.Inverse();
    NavState& out = result.state;
    out.stamp = s.stamp;
    out.X_OB = s.X_OI * X_IB;
    out.gyro_bias = s.gyro_bias;
    out.accel_bias = s.accel_bias;
    const Vec3 rate = sensors_.imu ? Vec3(Cut(samples_, s.stamp, s.stamp).front().gyro - s.gyro_bias) : rate_;
    const Vec3 w_B = imu_.X_BI.q * rate;
    out.w_B = w_B;
    out.v_OB = s.v_OI - out.X_OB.q * w_B.cross(imu_.X_BI.p);
    result.initialised = true;

    // δp_OB = δp_OI − R_OI [p_IB]× δθ_I and δθ_B = R_BI δθ_I.
    Mat6 A = Mat6::Identity();
    A.topRightCorner<3, 3>() = -s.X_OI.R() * base::Hat(X_IB.p);
    A.bottomRightCorner<3, 3>() = imu_.X_BI.R();
    const Mat6 pose = window_covariance_.topLeftCorner<6, 6>();
    result.pose_covariance = A * pose * A.transpose();
    result.velocity_covariance = window_covariance_.block<3, 3>(6, 6);
    if (result.note.empty() && result.inliers < config_.failure.min_inliers)
      result.note = "few corners: mostly inertial";
  }

  void View(const std::vector<Track>& tracks, FrameResult& result) const {
    const Transform X_CO = (window_.Newest().X_OI * window_.X_IC()).Inverse();
    for (const Track& t : tracks) {
      FeatureView view;
      view.u = static_cast<float>(t.pixel.x());
      view.v = static_cast<float>(t.pixel.y());
      view.age = t.age;
      if (const std::optional<Vec3> p_O = window_.Landmark(t.id)) {
        view.depth = static_cast<float>(std::max(0.0, (X_CO * *p_O).z()));
      }
      result.features.push_back(view);
    }
  }

  static constexpr std::uint64_t kCovariancePeriod = 4;  // frames; a millisecond each

  OdometryConfig config_;
  SensorSet sensors_;
  features::StereoRig rig_;
  ImuCalibration imu_;
  Vec3 gravity_;  // m/s², in O
  Transform X_OB_start_;
  features::StereoTracker tracker_;
  SlidingWindow window_;
  std::vector<TimedImu> samples_;
  std::optional<EyeDelay> eye_delay_;  // of a stereo pair
  MotionWatch watch_;
  MotionWatch::Verdict verdict_ = MotionWatch::Verdict::kFits;
  bool trusts_turn_ = true;  // the gyroscope's, for this frame
  std::optional<Time> last_stamp_, still_since_;
  Image last_left_;
  int last_tracked_ = 0;                       // of the last image that was not frozen
  std::optional<ImuState> first_of_repeated_;  // when the image was taken that repeats itself
  bool running_ = false;
  bool holding_ = false;       // one camera that has not moved yet
  std::vector<Track> tracks_;  // of an image in which it may hold
  Vec3 rate_ = Vec3::Zero();   // rad/s, body, as the last two images show it; without an IMU
  Time last_keyframe_, last_seeing_;
  Transform X_OC_reference_;  // left camera of the tracker's reference pair
  Mat15 window_covariance_ = Mat15::Zero();
  std::uint64_t newest_line_ = 0;
  int failed_solves_ = 0;
  std::uint32_t reset_counter_ = 0;
  OdometryTiming timing_;
};

Odometry::Odometry(const Calibration& calibration, const OdometryConfig& config, const Transform& X_OB_start)
    : impl_(std::make_unique<Impl>(calibration, config, X_OB_start)) {}
Odometry::~Odometry() = default;
Odometry::Odometry(Odometry&&) noexcept = default;
Odometry& Odometry::operator=(Odometry&&) noexcept = default;

FrameResult Odometry::Process(const FrameInput& input) { return impl_->Process(input); }
const SensorSet& Odometry::sensors() const { return impl_->sensors(); }
CalibrationEstimate Odometry::RefinedCalibration() const { return impl_->Rig(); }
OdometryTiming Odometry::Timing() const { return impl_->Timing(); }

}  // namespace alula::stack::estimation

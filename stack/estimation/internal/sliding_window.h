#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "stack/estimation/imu_preintegration.h"
#include "stack/estimation/internal/imu_factor.h"
#include "stack/estimation/internal/line_factor.h"
#include "stack/estimation/internal/linear_system.h"
#include "stack/estimation/internal/reprojection_factor.h"
#include "stack/estimation/internal/window_problem.h"
#include "stack/estimation/odometry.h"
#include "stack/estimation/odometry_config.h"
#include "stack/features/stereo_rig.h"

namespace alula::stack::estimation {

/// Motion of the IMU frame and its biases.
struct ImuState {
  base::Time stamp;
  base::Transform X_OI;
  base::Vec3 v_OI = base::Vec3::Zero();
  base::Vec3 gyro_bias = base::Vec3::Zero();
  base::Vec3 accel_bias = base::Vec3::Zero();
};

/// How well the first state of a window is known, 1σ.
struct StartSigmas {
  double position = 1e-3;    // m; with heading it fixes the gauge
  double heading = 1e-3;     // rad
  double tilt = 0.035;       // rad
  double velocity = 0.02;    // m/s
  double gyro_bias = 0.005;  // rad/s
  double accel_bias = 0.1;   // m/s²
};

/// A landmark seen in one stereo pair, normalised coordinates.
struct Sighting {
  std::uint64_t track = 0;
  base::Vec2 left = base::Vec2::Zero();
  std::optional<base::Vec2> right;
};

/// A line seen in one stereo pair, normalised coordinates.
struct LineSighting {
  std::uint64_t track = 0;
  SeenSegment left;
  std::optional<SeenSegment> right;
  /// Its ends by stereo, m, left camera: with them it may become a landmark.
  std::optional<std::array<base::Vec3, 2>> ends_L;
};

/// A line of the window that may be seen again: its ends as they were seen first, on the line as it is known now.
struct KnownLine {
  std::uint64_t track = 0;
  std::array<base::Vec3, 2> ends_O{base::Vec3::Zero(), base::Vec3::Zero()};
};

/// The state, carried forward by the IMU from `from` to the end of `samples` (which begin at from.stamp).
ImuState Propagate(const ImuState& from, const std::vector<TimedImu>& samples,
                   const base::Vec3& gravity = {0, 0, -base::kGravity});

/// The estimator's window: keyframes and the newest frames, their landmarks, the rig's refinement and a prior that
/// holds what has left. It knows tracks, not images. One turn: AddFrame → Solve → RejectOutliers → Slide.
///
/// Frames that were no keyframes leave without a trace: their sights are dropped and their IMU interval is joined to
/// the next one. The oldest keyframe is marginalised: with its speed and biases, with the landmarks that nobody
/// follows any more, and with a share of those that are still followed (their sights so far go into the prior; the
/// track goes on as a landmark without a past, so that nothing is counted twice). The other followed landmarks just
/// lose that sight.
class SlidingWindow {
 public:
  SlidingWindow(const features::StereoRig& rig, const base::Transform& X_IC, const ImuNoise& noise,
                const WindowConfig& config, const LinesConfig& lines = {},
                const base::Vec3& gravity = {0, 0, -base::kGravity});

  /// Forgets everything but the rig's refinement and begins with one state.
  void Start(const ImuState& state, const StartSigmas& sigmas, const std::vector<Sighting>& sightings,
             const std::vector<LineSighting>& lines = {});
  /// Adds a state at the end of `samples`, which begin at the newest state's stamp. `X_OI`: where the solution is
  /// looked for, in place of the samples' prediction. `noise`: of these samples, where it is not as calibrated.
  void AddFrame(const std::vector<TimedImu>& samples, const std::vector<Sighting>& sightings, bool keyframe,
                const std::vector<LineSighting>& lines = {}, const std::optional<base::Transform>& X_OI = std::nullopt,
                const std::optional<ImuNoise>& noise = std::nullopt);
  /// Returns false where the solver failed; the states are as before then.
  bool Solve();
  /// Drops sights that do not fit and returns the tracks that should be followed no more.
  std::vector<std::uint64_t> RejectOutliers();
  void Slide();

  ImuState Newest() const;
  /// Keyframes but the newest frame, oldest first.
  std::vector<ImuState> KeyframesBefore() const;
  /// Position of a track's landmark in O, m; none as long as nothing has told its depth.
  std::optional<base::Vec3> Landmark(std::uint64_t track) const;
  bool SeenInNewest(std::uint64_t track) const;
  std::vector<KnownLine> Lines() const;
  /// Lines that the last solve made use of.
  int UsedLines() const;
  /// Covariance of the newest state: (δp, δθ, δv, δb_g, δb_a), IMU frame.
  Mat15 NewestCovariance() const;
  CalibrationEstimate Rig() const;
  /// Left camera in the IMU frame, with the refinement.
  base::Transform X_IC() const;
  const ImuNoise& noise() const { return noise_; }  // as it is taken for
  std::size_t frames() const { return frames_.size(); }
  std::size_t landmarks() const { return landmarks_.size(); }
  /// What Solve hands to a solver, where the parameters stand now; valid until the window changes.
  WindowProblem Problem() const;

 private:
  struct Frame {
    std::size_t slot = 0;
    base::Time stamp;
    bool keyframe = false;
    base::Vec3 gyro = base::Vec3::Zero();  // reading at the stamp, rad/s
    PairModel pair;
    std::unique_ptr<ImuPreintegration> integral;  // from the frame before; null for the first
    std::unique_ptr<ImuFactor> factor;            // of `integral`
  };
  struct Sight {
    std::size_t slot = 0;
    std::unique_ptr<ReprojectionFactor> left, right;
  };
  struct MapPoint {
    std::size_t slot = 0;
    std::vector<Sight> sights;
    bool placed = false;  // its depth is known
  };

  struct LineSight {
    std::size_t slot = 0;
    std::unique_ptr<LineFactor> left, right;
  };
  struct MapLine {
    std::size_t slot = 0;
    std::vector<LineSight> sights;
    std::array<base::Vec3, 2> ends_O;
    bool used = false;  // known well enough for the solver
  };

  double* rig_parameters() const { return arena_.get(); }
  double* pose(std::size_t slot) const { return arena_.get() + pose_begin_ + 8 * slot; }
  double* speed_bias(std::size_t slot) const { return arena_.get() + speed_begin_ + 10 * slot; }
  double* point(std::size_t slot) const { return arena_.get() + point_begin_ + 4 * slot; }

  double* line(std::size_t slot) const { return arena_.get() + line_begin_ + 8 * slot; }
  void AddLines(const Frame& frame, const std::vector<LineSighting>& lines);
  void AddLinesTo(WindowProblem& problem, const std::vector<int>& pose_of) const;
  /// ½ Σ ρ of a line's sights, poses held; with H and b its normal equations.
  double LineCost(const MapLine& one, const double* x, Eigen::Matrix4d* H, Eigen::Vector4d* b) const;
  /// A line by itself, poses held, as long as the solver does not have it.
  void FitLine(MapLine& one);
  /// Decides which lines the solver gets.
  void JudgeLines();
  void RejectLines();
  void EraseLine(std::map<std::uint64_t, MapLine>::iterator it);
  void EraseLineSights(std::size_t slot);
  void MakeArena();
  void WriteState(std::size_t slot, const ImuState& state);
  ImuState ReadState(const Frame& frame) const;
  Frame& AppendFrame(base::Time stamp, bool keyframe, const base::Vec3& gyro);
  void AddSightings(const Frame& frame, const std::vector<Sighting>& sightings);
  void Place(MapPoint& landmark, const base::Vec3& p_O);
  /// Where both eyes see a landmark.
  std::optional<base::Vec3> ByStereo(const Frame& frame, const Sighting& seen) const;
  /// The point nearest to all rays of a landmark (least squares), as soon as they make an angle.
  std::optional<base::Vec3> ByMotion(const MapPoint& landmark) const;
  /// Left camera at a frame's exposure.
  base::Transform X_OC(const Frame& frame) const;
  void RefreshModels();
  void RelineariseFactors();
  void DropUnusable();
  void ErasePoint(std::map<std::uint64_t, MapPoint>::iterator it);
  void EraseSights(std::size_t slot);
  void RemoveFrame(std::size_t index);
  void MarginaliseOldest();
  bool UsesPoint(const MapPoint& p) const { return p.placed && p.sights.size() >= 2; }
  const Frame* FrameOf(std::size_t slot) const;
  /// Largest error of a sight at the current estimate, px; none where it lies behind the camera.
  std::optional<double> SightError(const Sight& sight, const double* landmark) const;

  features::StereoRig rig_;
  base::Transform X_IC_, X_RL_;
  ImuNoise noise_;
  base::Vec3 gravity_;  // m/s², in O
  WindowConfig config_;
  LinesConfig lines_config_;
  std::size_t max_points_, max_lines_;
  std::size_t pose_begin_ = 0, speed_begin_ = 0, point_begin_ = 0, line_begin_ = 0, arena_size_ = 0;
  std::unique_ptr<double[]> arena_;  // all parameters in one piece: the solver orders blocks by their address
  std::vector<std::size_t> free_slots_, free_points_, free_lines_;  // taken from the back
  std::vector<std::unique_ptr<Frame>> frames_;                      // oldest first
  std::map<std::uint64_t, MapPoint> landmarks_;                     // by track: a fixed order
  std::map<std::uint64_t, MapLine> lines_;
  LinearPrior prior_;
  std::uint64_t consumption_ = 0;  // counts followed landmarks of leaving keyframes
};

}  // namespace alula::stack::estimation

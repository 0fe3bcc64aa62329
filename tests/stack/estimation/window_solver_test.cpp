#include <ceres/sized_cost_function.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "stack/estimation/internal/window_linearisation.h"
#include "stack/estimation/internal/window_problem.h"
#include "tests/stack/estimation/track_simulator.h"

namespace alula::stack::estimation::test {
namespace {

/// All that a problem's solver may write.
struct Parameters {
  explicit Parameters(const WindowProblem& p) : problem(&p) {
    for (const auto& s : p.states) blocks.emplace_back(s.x, s.x + AmbientSize(s.kind));
    for (const auto& l : p.landmarks) blocks.emplace_back(l.x, l.x + l.kind->ambient);
  }
  void Write() const {
    std::size_t i = 0;
    for (const auto& s : problem->states) std::copy(blocks[i].begin(), blocks[i].end(), s.x), ++i;
    for (const auto& l : problem->landmarks) std::copy(blocks[i].begin(), blocks[i].end(), l.x), ++i;
  }
  const WindowProblem* problem;
  std::vector<std::vector<double>> blocks;
};

/// Moves everything off its minimum: poses by centimetres and tenths of a degree, landmarks by 5 cm.
void Disturb(const WindowProblem& problem, base::RandomStream& random) {
  for (const auto& s : problem.states) {
    if (s.constant) continue;
    if (s.kind == BlockKind::kPose) {
      base::Vec6 delta;
      delta << 0.02 * random.GaussianVec3(), 0.003 * random.GaussianVec3();
      std::array<double, kPoseSize> moved{};
      PosePlus(s.x, delta.data(), moved.data());
      std::copy(moved.begin(), moved.end(), s.x);
    } else {
      const double size = s.kind == BlockKind::kRig ? 1e-4 : 0.01;
      for (int k = 0; k < TangentSize(s.kind); ++k) s.x[k] += size * random.Gaussian();
    }
  }
  for (const auto& l : problem.landmarks) {
    for (int k = 0; k < l.kind->ambient; ++k) l.x[k] += 0.05 * random.Gaussian();
  }
}

/// Largest difference of two solutions: of poses (m, rad).
double PosesApart(const Parameters& a, const Parameters& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.problem->states.size(); ++i) {
    if (a.problem->states[i].kind != BlockKind::kPose) continue;
    worst = std::max(worst, PoseDifference(a.blocks[i].data(), b.blocks[i].data()).cwiseAbs().maxCoeff());
  }
  return worst;
}

/// Windows of a flight, solved as they come; `look` sees each one that is full.
template <typename Look>
void FlyWindows(const WindowConfig& config, Look look) {
  constexpr std::uint64_t kSeed = 7;
  const Flight flight({0, -6, 0.1}, M_PI, {{-6, -5, 1.5}, {-8, 0, 1.8}, {-6, 5, 1.5}}, 2.0, 1.0, false);
  const Calibration truth = TrueCalibration(), told = WrongCalibration(truth, kSeed, 1.0);
  TrackSimulator tracks(truth, told, {-12, -9, 0}, {12, 9, 4}, 1500, 0.5, DrawTimeOffset(kSeed), kSeed);
  const std::vector<TimedImu> imu = SimulateImu(flight, *truth.imu, kSeed);
  SlidingWindow window(features::MakeRig(told), truth.imu->X_BI.Inverse() * told.cameras[0].X_BC, truth.imu->noise,
                       config);
  for (Time stamp{500'000'000}; stamp + base::Milliseconds(60) < flight.end(); stamp += base::Milliseconds(50)) {
    const TrackSimulator::Pair pair = tracks.See(flight, stamp);
    if (window.frames() == 0) {
      ImuState state;
      state.stamp = stamp;
      state.X_OI = flight.At(stamp).X_WB * truth.imu->X_BI;
      window.Start(state, {}, pair.sightings);
      continue;
    }
    window.AddFrame(Cut(imu, window.Newest().stamp, stamp), pair.sightings, pair.keyframe);
    ASSERT_TRUE(window.Solve());
    if (window.frames() == static_cast<std::size_t>(config.frames)) look(window);
    window.RejectOutliers();
    window.Slide();
  }
}

/// Our solver against Ceres, both from the same disturbed start until nothing gains any more.
void CompareWithCeres(const WindowConfig& config) {
  const SolverLimits converge{.iterations = 60, .function_tolerance = 1e-15};
  base::RandomStream random(3, "test/window_solver");
  int windows = 0, compared = 0;
  FlyWindows(config, [&](const SlidingWindow& window) {
    if (++windows % 12 != 0) return;
    const WindowProblem problem = window.Problem();
    const Parameters solved(problem);
    Disturb(problem, random);
    const Parameters start(problem);
    const SolverSummary ceres = SolveWithCeres(problem, converge);
    const Parameters by_ceres(problem);
    start.Write();
    const SolverSummary schur = SolveWithSchur(problem, converge);
    const Parameters by_schur(problem);
    EXPECT_TRUE(ceres.usable && schur.usable);
    EXPECT_NEAR(schur.initial_cost, ceres.initial_cost, 1e-9 * ceres.initial_cost);
    EXPECT_LT(schur.final_cost, 0.2 * schur.initial_cost);  // there was something to do
    EXPECT_NEAR(schur.final_cost, ceres.final_cost, 1e-6 * ceres.final_cost);
    EXPECT_LT(PosesApart(by_schur, by_ceres), 5e-6);
    EXPECT_GT(PosesApart(by_schur, start), 1e-3);
    solved.Write();
    ++compared;
  });
  EXPECT_GE(compared, 10);
}

TEST(SchurSolver, FindsTheMinimumThatCeresFinds) { CompareWithCeres({}); }

TEST(SchurSolver, FindsItWithTheRigHeldToo) {
  WindowConfig config;
  config.refine_calibration = false;
  CompareWithCeres(config);
}

/// The gradient that the linearisation steps along is that of the cost.
TEST(SchurSolver, PromisesWhatASmallStepGains) {
  WindowConfig config;
  base::RandomStream random(5, "test/window_solver");
  int windows = 0;
  FlyWindows(config, [&](const SlidingWindow& window) {
    if (++windows % 40 != 0) return;
    const WindowProblem problem = window.Problem();
    const Parameters solved(problem);
    Disturb(problem, random);
    const PriorProducts prior(problem);
    WindowLinearisation here(problem);
    ASSERT_TRUE(here.Linearise(problem, prior));
    // Strong damping: a step so small that the model is the cost to a part in a thousand.
    const double promised = here.Step(problem, 1e-3);
    double cost = 0.0;
    ASSERT_TRUE(CostOf(problem, cost));
    EXPECT_GT(promised, 0.0);
    EXPECT_NEAR((here.cost() - cost) / promised, 1.0, 1e-2);
    solved.Write();
  });
}

/// A straight edge between two planes: where it meets x = 4 m and x = 8 m (y, z each); seen, its first end's row and
/// its second end's column.
class EdgeFactor final : public ceres::SizedCostFunction<2, kPoseSize, 4, kRigSize> {
 public:
  EdgeFactor(const PairModel& pair, const base::Vec2& seen) : pair_(&pair), seen_(seen) {}
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    for (int end = 0; end < 2; ++end) {
      const double point[3] = {end == 0 ? 4.0 : 8.0, x[1][2 * end], x[1][2 * end + 1]};
      const ReprojectionFactor factor(*pair_, false, seen_);
      Eigen::Matrix<double, 2, 7, Eigen::RowMajor> by_pose;
      Eigen::Matrix<double, 2, 3, Eigen::RowMajor> by_point;
      Eigen::Matrix<double, 2, 6, Eigen::RowMajor> by_rig;
      base::Vec2 r;
      const double* blocks[3] = {x[0], point, x[2]};
      double* out[3] = {by_pose.data(), by_point.data(), by_rig.data()};
      if (!factor.Evaluate(blocks, r.data(), out)) return false;
      residuals[end] = r[end];
      if (jacobians == nullptr) continue;
      if (jacobians[0] != nullptr) Eigen::Map<Eigen::Matrix<double, 1, 7>>(jacobians[0] + 7 * end) = by_pose.row(end);
      if (jacobians[2] != nullptr) Eigen::Map<Eigen::Matrix<double, 1, 6>>(jacobians[2] + 6 * end) = by_rig.row(end);
      if (jacobians[1] == nullptr) continue;
      Eigen::Map<Eigen::Matrix<double, 1, 4>> by_edge(jacobians[1] + 4 * end);
      by_edge.setZero();
      by_edge.segment<2>(2 * end) = by_point.row(end).tail<2>();
    }
    return true;
  }

 private:
  const PairModel* pair_;
  base::Vec2 seen_;
};

/// Landmarks of four parameters go the way of those of three: three poses, a rig, ten edges and ten points.
TEST(SchurSolver, EliminatesLandmarksOfFourParametersBesideThoseOfThree) {
  base::RandomStream random(17, "test/window_solver");
  PairModel pair;
  pair.X_IC = {base::ForwardCameraRotation(), Vec3(0.1, 0, 0)};
  pair.X_RL = {Quat::Identity(), Vec3(-0.11, 0, 0)};
  pair.weight = 381.0;
  constexpr std::size_t kPoses = 3, kOfEach = 10;
  // One arena: Ceres orders blocks by their addresses.
  std::array<double, 6 + 7 * kPoses + 7 * kOfEach> arena{};
  double *rig = arena.data(), *poses = rig + 6, *points = poses + 7 * kPoses, *edges = points + 3 * kOfEach;
  for (std::size_t i = 0; i < kPoses; ++i)
    SetPose({base::Exp(0.05 * random.GaussianVec3()), 0.4 * random.GaussianVec3()}, poses + 7 * i);
  for (std::size_t i = 0; i < kOfEach; ++i) {
    points[3 * i] = random.Uniform(4, 9);
    for (std::size_t k = 1; k < 3; ++k) points[3 * i + k] = random.Uniform(-2, 2);
    for (std::size_t k = 0; k < 4; ++k) edges[4 * i + k] = random.Uniform(-2, 2);
  }

  WindowProblem problem;
  problem.huber = 1.5;
  problem.states.push_back({rig, BlockKind::kRig});
  LinearPrior prior;
  for (std::size_t i = 0; i < kPoses; ++i) problem.states.push_back({poses + 7 * i, BlockKind::kPose});
  for (const auto& s : problem.states) {
    prior.blocks.push_back({s.x, s.kind, {}});
    std::copy_n(s.x, AmbientSize(s.kind), prior.blocks.back().x0.begin());
  }
  prior.J = 50.0 * Eigen::MatrixXd::Identity(6 + 6 * kPoses, 6 + 6 * kPoses);
  prior.r = Eigen::VectorXd::Constant(6 + 6 * kPoses, 0.1);
  problem.prior = &prior;
  const LandmarkKind point_kind, edge_kind{4, 4, nullptr};
  std::vector<std::unique_ptr<ceres::CostFunction>> factors;
  const auto see = [&](double* x, const LandmarkKind& kind, const auto& make) {
    problem.landmarks.push_back({x, &kind, static_cast<int>(problem.sights.size()), kPoses});
    for (int i = 1; i <= static_cast<int>(kPoses); ++i) {
      base::Vec2 r;
      const double* blocks[3] = {problem.states[static_cast<std::size_t>(i)].x, x, rig};
      EXPECT_TRUE(make(base::Vec2(0, 0))->Evaluate(blocks, r.data(), nullptr));
      const base::Vec2 noise(random.Gaussian(), random.Gaussian());
      factors.push_back(make((r + noise) / pair.weight));
      problem.sights.push_back({factors.back().get(), i});
    }
  };
  for (std::size_t i = 0; i < kOfEach; ++i) {
    see(points + 3 * i, point_kind, [&](const base::Vec2& seen) -> std::unique_ptr<ceres::CostFunction> {
      return std::make_unique<ReprojectionFactor>(pair, false, seen);
    });
    see(edges + 4 * i, edge_kind, [&](const base::Vec2& seen) -> std::unique_ptr<ceres::CostFunction> {
      return std::make_unique<EdgeFactor>(pair, seen);
    });
  }

  Disturb(problem, random);
  const Parameters start(problem);
  const SolverLimits converge{.iterations = 60, .function_tolerance = 1e-15};
  const SolverSummary ceres = SolveWithCeres(problem, converge);
  const Parameters by_ceres(problem);
  start.Write();
  const SolverSummary schur = SolveWithSchur(problem, converge);
  EXPECT_NEAR(schur.final_cost, ceres.final_cost, 1e-6 * ceres.final_cost);
  EXPECT_LT(PosesApart(Parameters(problem), by_ceres), 5e-6);
  EXPECT_LT(schur.final_cost, 0.2 * schur.initial_cost);
}

}  // namespace
}  // namespace alula::stack::estimation::test

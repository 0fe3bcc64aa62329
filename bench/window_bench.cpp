// What a sliding window costs on one thread: our solver beside Ceres on the same windows of a synthetic flight (150
// tracks, 10 states, 3 iterations), the covariance and the sliding. Medians of processor time.
#include <algorithm>
#include <vector>

#include "base/processor_clock.h"
#include "bench/bench.h"
#include "stack/estimation/internal/sliding_window.h"
#include "tests/stack/estimation/track_simulator.h"

namespace alula::bench {
namespace {

namespace estimation = stack::estimation;
namespace test = stack::estimation::test;

template <typename Act>
void Time(std::vector<double>& times, Act act) {
  const double start = base::ProcessorMs();
  act();
  times.push_back(base::ProcessorMs() - start);
}

double Median(std::vector<double> times) {
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

}  // namespace

void Run_window(Figures& figures) {
  constexpr std::uint64_t kSeed = 7;
  const test::Flight flight({0, -6, 0.1}, M_PI, {{-6, -5, 1.5}, {-8, 0, 1.8}, {-6, 5, 1.5}}, 2.0, 1.0, false);
  const stack::Calibration truth = test::TrueCalibration();
  test::TrackSimulator tracks(truth, truth, {-12, -9, 0}, {12, 9, 4}, 1500, 0.5, 0.0, kSeed);
  const std::vector<estimation::TimedImu> imu = test::SimulateImu(flight, *truth.imu, kSeed);
  const auto rig = stack::features::MakeRig(truth);
  const base::Transform X_IC = truth.imu->X_BI.Inverse() * truth.cameras[0].X_BC;
  estimation::WindowConfig ours, reference;
  ours.solver = estimation::WindowSolver::kSchur;
  reference.solver = estimation::WindowSolver::kCeres;
  estimation::SlidingWindow window(rig, X_IC, truth.imu->noise, ours), twin(rig, X_IC, truth.imu->noise, reference);
  std::vector<double> schur, ceres, covariance, slide;
  for (base::Time stamp{500'000'000}; stamp + base::Milliseconds(60) < flight.end(); stamp += base::Milliseconds(50)) {
    const test::TrackSimulator::Pair pair = tracks.See(flight, stamp);
    if (window.frames() == 0) {
      estimation::ImuState state;
      state.stamp = stamp;
      state.X_OI = flight.At(stamp).X_WB * truth.imu->X_BI;
      window.Start(state, {}, pair.sightings);
      twin.Start(state, {}, pair.sightings);
      continue;
    }
    const auto samples = Cut(imu, window.Newest().stamp, stamp);
    window.AddFrame(samples, pair.sightings, pair.keyframe);
    twin.AddFrame(samples, pair.sightings, pair.keyframe);
    Time(schur, [&] { window.Solve(); });
    Time(ceres, [&] { twin.Solve(); });
    window.RejectOutliers();
    twin.RejectOutliers();
    Time(covariance, [&] { window.NewestCovariance(); });
    Time(slide, [&] { window.Slide(); });
    twin.Slide();
  }
  figures.Add("window/flight/schur/solve_ms", Median(schur));
  figures.Add("window/flight/ceres/solve_ms", Median(ceres));
  figures.Add("window/flight/normal_equations/covariance_ms", Median(covariance));
  figures.Add("window/flight/normal_equations/slide_ms", Median(slide));
}

}  // namespace alula::bench

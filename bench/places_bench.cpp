// What finding, naming and knowing again costs on one thread: ORB beside OpenCV's, words, a query of 1000 keyframes,
// and the relative pose of two views. Pictures of the motion-capture room; medians of CPU time.
#include <algorithm>
#include <ctime>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "base/random.h"
#include "bench/bench.h"
#include "render/camera_renderer.h"
#include "render/sensor_effects.h"
#include "scenarios/factories.h"
#include "scenarios/gallery/viewpoints.h"
#include "scenarios/slam/train_vocabulary.h"
#include "stack/features/orb.h"
#include "stack/slam/keyframe_database.h"
#include "stack/slam/relative_pose.h"

namespace alula::bench {
namespace {

namespace features = stack::features;
namespace slam = stack::slam;

constexpr int kViews = 6;

double ThreadMs() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// Median over the views in turn.
double Median(const std::function<void(std::size_t)>& act) {
  std::vector<double> times;
  for (std::size_t turn = 0; turn < 7 * kViews; ++turn) {
    const double start = ThreadMs();
    act(turn % kViews);
    times.push_back(ThreadMs() - start);
  }
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

struct Pair {
  stack::Image left, right;
};

/// A stereo pair from each of some places, and one from 0.2 m beside it.
std::vector<Pair> Photograph(const features::StereoRig& rig) {
  const auto world = scenarios::MakeWorld(scenarios::LoadWorld(scenarios::FindAny("vicon_room").file, {}, 1), 1);
  const auto renderer = render::MakeRendererAtStart("auto", *world, 1);
  const auto picture = [&](const base::Transform& X_WC, std::uint64_t key) {
    render::Picture raw;
    render::View view;
    view.X_WC = X_WC;
    view.intrinsics = rig.left;
    renderer->Grey(view, raw);
    render::ApplyPixelNoise(raw, key, {});
    stack::Image image;
    image.width = image.stride = raw.width;
    image.height = raw.height;
    image.bytes = std::make_shared<std::vector<std::uint8_t>>(std::move(raw.bytes));
    return image;
  };
  std::vector<Pair> pairs;
  for (const base::Transform& X_WC : scenarios::gallery::RandomViewpoints(*world, kViews, 1)) {
    for (const double shift : {0.0, 0.2}) {
      const base::Transform X = X_WC * base::Transform{base::Quat::Identity(), {shift, 0.0, 0.0}};
      pairs.push_back({picture(X, 2 * pairs.size()), picture(X * rig.X_LR, 2 * pairs.size() + 1)});
    }
  }
  return pairs;
}

void MeasureOrb(const std::vector<Pair>& pairs, Figures& figures) {
  const auto image = [&](std::size_t i) -> const stack::Image& { return pairs[2 * i].left; };
  figures.Add("places/vicon_room/orb_500/752x480_ms",
              Median([&](std::size_t i) { features::DetectOrb(image(i), {}); }));
  const auto reference = cv::ORB::create(500, 1.2F, 8);
  figures.Add("places/vicon_room/opencv_orb_500/752x480_ms", Median([&](std::size_t i) {
                const stack::Image& p = image(i);
                const cv::Mat view(p.height, p.width, CV_8UC1, const_cast<std::uint8_t*>(p.Row(0)));
                std::vector<cv::KeyPoint> keypoints;
                cv::Mat descriptors;
                reference->detectAndCompute(view, cv::noArray(), keypoints, descriptors);
              }));
}

void MeasurePlaces(const features::StereoRig& rig, const std::vector<Pair>& pairs, Figures& figures) {
  std::vector<slam::PlaceView> views;
  for (const Pair& p : pairs) views.push_back(slam::ViewOf(rig, p.left, p.right, {}));
  figures.Add("places/vicon_room/stereo_view/752x480_ms",
              Median([&](std::size_t i) { slam::ViewOf(rig, pairs[2 * i].left, pairs[2 * i].right, {}); }));
  const slam::Vocabulary vocabulary = slam::LoadVocabulary(slam::VocabularyPath());
  figures.Add("places/vicon_room/vocabulary/load_ms",
              Median([&](std::size_t) { slam::LoadVocabulary(slam::VocabularyPath()); }));
  figures.Add("places/vicon_room/vocabulary/words_of_500_ms",
              Median([&](std::size_t i) { vocabulary.WordsOf(views[2 * i]); }));
  slam::KeyframeDatabase database;  // the same views again and again, each time with some other points
  base::RandomStream random(1, "bench/places");
  for (slam::KeyframeId id = 0; id < 1000; ++id) {
    slam::PlaceView view = views[id % views.size()];
    for (slam::PlacePoint& p : view.points) {
      if (random.Uniform() < 0.7) p.descriptor = {random.Bits(), random.Bits(), random.Bits(), random.Bits()};
    }
    database.Add(id, vocabulary.WordsOf(view));
  }
  figures.Add("places/vicon_room/database/query_of_1000_ms",
              Median([&](std::size_t i) { database.Query(vocabulary.WordsOf(views[2 * i]), {}); }));
  figures.Add("places/vicon_room/relative_pose/same_place_ms",
              Median([&](std::size_t i) { slam::EstimateRelativePose(views[2 * i], views[2 * i + 1], {}, i); }));
  figures.Add("places/vicon_room/relative_pose/other_place_ms", Median([&](std::size_t i) {
                slam::EstimateRelativePose(views[2 * i], views[(2 * i + 2) % views.size()], {}, i);
              }));
}

}  // namespace

void Run_places(Figures& figures) {
  const stack::CameraIntrinsics camera = scenarios::gallery::WideCamera(752, 480);
  const features::StereoRig rig{camera, camera, {base::Quat::Identity(), {0.11, 0.0, 0.0}}};
  const std::vector<Pair> pairs = Photograph(rig);
  MeasureOrb(pairs, figures);
  MeasurePlaces(rig, pairs, figures);
}

}  // namespace alula::bench

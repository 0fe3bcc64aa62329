#include "scenarios/slam/recording_feed.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "scenarios/dataset/image_file.h"
#include "stack/features/depth_registration.h"
#include "stack/interface/grey.h"

namespace alula::scenarios::slam {
namespace {

using base::Duration;
using base::Time;
using dataset::ImageFile;
using dataset::Recording;

constexpr Duration kTogether = base::Milliseconds(5);  // two eyes' stamps that far apart are one pair

const ImageFile* PartnerOf(const ImageFile& left, const std::vector<ImageFile>& rights) {
  auto it = std::lower_bound(rights.begin(), rights.end(), left.captured - kTogether,
                             [](const ImageFile& image, Time time) { return image.captured < time; });
  const ImageFile* best = nullptr;
  for (; it != rights.end() && it->captured <= left.captured + kTogether; ++it) {
    const auto gap = [&left](const ImageFile& image) { return std::abs((image.captured - left.captured).ns); };
    if (best == nullptr || gap(*it) < gap(*best)) best = &*it;
  }
  return best;
}

/// Depth images as the camera of the pictures would see them.
class Depths {
 public:
  Depths(const Recording& recording, std::size_t picture) : recording_(recording) {
    if (!recording.depth) return;
    const stack::CameraCalibration &from = recording.calibration.cameras.at(recording.depth->camera),
                                   &into = recording.calibration.cameras.at(picture);
    if (!stack::features::Registered(from, into)) registration_.emplace(from, into);
  }

  /// Empty where the picture has none.
  stack::DepthImage Of(std::size_t picture) const {
    const std::optional<std::size_t> i = recording_.depth->of_picture.at(picture);
    if (!i) return {};
    const std::size_t camera = recording_.depth->camera;
    const stack::DepthImage image = dataset::LoadDepth(
        recording_.images[camera][*i], recording_.calibration.cameras[camera], recording_.depth->values_per_metre);
    return registration_ ? (*registration_)(image) : image;
  }

 private:
  const Recording& recording_;
  std::optional<stack::features::DepthRegistration> registration_;
};

/// A time cut to whole tenths of a second.
Time Tenths(Time time) { return {time.ns - time.ns % 100'000'000}; }

base::Transform StartOf(const Recording& recording, Time first) {
  if (recording.truth.empty()) return {};
  const auto it = std::lower_bound(recording.truth.begin(), recording.truth.end(), first,
                                   [](const dataset::BodyTruth& state, Time time) { return state.time < time; });
  return it == recording.truth.end() ? recording.truth.back().X_WB : it->X_WB;
}

Duration EpochOf(const Recording& recording) {
  if (recording.images.empty() || recording.images.front().empty())
    throw base::InputError("the recording has no images");
  return recording.images.front().front().captured - Time{};
}

}  // namespace

base::Duration SpanOf(const Recording& recording) {
  return recording.images.front().back().captured - Time{} - EpochOf(recording);
}

std::vector<base::StampedPose> TruthOf(const Recording& recording) {
  const Duration epoch = EpochOf(recording);
  std::vector<base::StampedPose> truth;
  for (const dataset::BodyTruth& state : recording.truth) truth.push_back({state.time - epoch, state.X_WB});
  return truth;
}

std::vector<EstimatorResult> FeedRecording(const Recording& recording, const std::vector<Variant>& variants,
                                           const std::function<void(base::Time)>& progress) {
  const stack::estimation::SensorSet set = stack::estimation::ChooseSensors(recording.calibration, {});
  const auto l = static_cast<std::size_t>(set.picture);
  const std::vector<ImageFile>& lefts = recording.images.at(l);
  const Depths depths(recording, l);
  const Duration epoch = EpochOf(recording);
  std::vector<EstimatorRun> runs;
  for (const Variant& variant : variants)
    runs.emplace_back(variant, recording.calibration, StartOf(recording, lefts.front().captured));

  const Duration offset = recording.calibration.cameras[l].time_offset;
  std::size_t used = 0;
  std::uint32_t seq = 0;
  for (std::size_t i = 0; i < lefts.size(); ++i) {
    progress(Tenths(lefts[i].captured - epoch));
    stack::estimation::FrameInput frame;
    if (set.right) {
      const auto r = static_cast<std::size_t>(*set.right);
      const ImageFile* right = PartnerOf(lefts[i], recording.images.at(r));
      if (right == nullptr) continue;
      frame.right = stack::ToGrey(dataset::LoadImage(*right, recording.calibration.cameras[r]));
    }
    if (set.depth) frame.depth = depths.Of(i);
    frame.seq = seq++;
    const Time stamp = lefts[i].captured + offset;
    frame.stamp = stamp - epoch;
    frame.left = stack::ToGrey(dataset::LoadImage(lefts[i], recording.calibration.cameras[l]));
    for (; used < recording.imu.size() && (used == 0 || recording.imu[used - 1].time < stamp); ++used) {
      const dataset::ImuReading& reading = recording.imu[used];
      frame.imu.push_back({reading.time - epoch, reading.sample.angular_velocity, reading.sample.specific_force});
    }
    for (EstimatorRun& run : runs) run.Feed(frame);
  }
  std::vector<EstimatorResult> results;
  for (EstimatorRun& run : runs) results.push_back(run.Finish());
  return results;
}

}  // namespace alula::scenarios::slam

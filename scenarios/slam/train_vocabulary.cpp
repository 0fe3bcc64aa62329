#include "scenarios/slam/train_vocabulary.h"

#include <numbers>

#include "base/random.h"
#include "render/camera_renderer.h"
#include "render/sensor_effects.h"
#include "scenarios/factories.h"
#include "scenarios/gallery/viewpoints.h"
#include "scenarios/write_file.h"
#include "stack/features/orb.h"

namespace alula::scenarios::slam {
namespace {

constexpr int kWidth = 752;
constexpr int kHeight = 480;

stack::Image ImageOf(render::Picture picture) {
  stack::Image image;
  image.width = image.stride = picture.width;
  image.height = picture.height;
  image.bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(picture.bytes));
  return image;
}

void AddViews(const CatalogEntry& entry, std::uint64_t seed, const VocabularyTraining& training,
              stack::slam::TrainingSet& set) {
  const auto world = MakeWorld(LoadWorld(entry.file, {}, seed), seed);
  const auto renderer = render::MakeRendererAtStart(training.render, *world, seed);
  base::RandomStream random(seed, "vocabulary/" + entry.name);
  for (const base::Transform& X_WC : gallery::RandomViewpoints(*world, training.views, seed)) {
    constexpr double kTilt = 15.0 * std::numbers::pi / 180.0;
    const base::Vec3 tilt(random.Uniform(-kTilt, kTilt), 0.0, random.Uniform(-kTilt, kTilt));  // pitch and roll
    render::View view;
    view.X_WC = {X_WC.q * base::Exp(tilt), X_WC.p};
    view.intrinsics = gallery::WideCamera(kWidth, kHeight);
    render::Picture picture;
    renderer->Grey(view, picture);
    render::ApplyPixelNoise(picture, random.Bits(), {});
    std::vector<stack::features::Descriptor> descriptors;
    for (const auto& keypoint : stack::features::DetectOrb(ImageOf(std::move(picture)), training.orb)) {
      descriptors.push_back(keypoint.descriptor);
    }
    set.points.push_back(std::move(descriptors));
  }
}

}  // namespace

stack::slam::TrainingSet CollectTrainingSet(const VocabularyTraining& training, const TrainingProgress& progress) {
  std::vector<CatalogEntry> worlds = ListCatalogs();
  std::erase_if(worlds, [](const CatalogEntry& entry) { return entry.kind != "world"; });
  stack::slam::TrainingSet set;
  int done = 0;
  for (const CatalogEntry& entry : worlds) {
    for (int i = 0; i < training.variants; ++i) {
      AddViews(entry, training.seed + static_cast<std::uint64_t>(i), training, set);
    }
    progress(++done, static_cast<int>(worlds.size()));
  }
  return set;
}

std::size_t WriteVocabulary(const VocabularyTraining& training, const std::filesystem::path& file,
                            const TrainingProgress& progress) {
  const stack::slam::TrainingSet set = CollectTrainingSet(training, progress);
  const std::vector<std::uint8_t> bytes =
      stack::slam::ToBytes(stack::slam::TrainVocabulary(set, training.points, {}, training.seed));
  WriteFile("--out", file, std::string(bytes.begin(), bytes.end()));
  return bytes.size();
}

}  // namespace alula::scenarios::slam

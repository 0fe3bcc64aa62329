#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "stack/features/orb_config.h"
#include "stack/slam/vocabulary.h"

namespace alula::scenarios::slam {

/// What a vocabulary is trained on: pictures of every world of the catalog, none of a recording.
struct VocabularyTraining {
  std::uint64_t seed = 1000;  // of the first variant of each world, its views and the trees; flights have small ones
  int variants = 3;           // of each world: seed, seed + 1, …
  int views = 32;             // of each variant, from gallery::RandomViewpoints
  stack::features::OrbConfig orb;
  stack::slam::TreeShape points{.branching = 32,
                                .levels = 3};  // 32,000 words, 1.2 MB: finds more than 10⁴ in four levels
  std::string render = "auto";
};

/// Told of each world when its pictures are done: how many of how many.
using TrainingProgress = std::function<void(int done, int all)>;

/// Draws the views (752×480 px, 80°, pixel noise, each turned as a multicopter's may be: ± 15° of roll and pitch) and
/// describes them.
stack::slam::TrainingSet CollectTrainingSet(const VocabularyTraining& training, const TrainingProgress& progress);

/// Collects, trains and writes the file. Returns its size in bytes. The same training gives the same file.
std::size_t WriteVocabulary(const VocabularyTraining& training, const std::filesystem::path& file,
                            const TrainingProgress& progress);

}  // namespace alula::scenarios::slam

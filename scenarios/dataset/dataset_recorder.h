#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "scenarios/dataset/dataset_writer.h"
#include "scenarios/runner.h"

namespace alula::scenarios::dataset {

/// How much a dataset came to hold.
struct DatasetSize {
  std::int64_t images = 0;  // depth images apart
  std::int64_t depth_images = 0;
  std::int64_t imu_samples = 0;
  base::Duration span{};  // of the run
};

/// Where a dataset goes and what it says of itself.
struct DatasetRequest {
  Format format = Format::kEuroc;
  std::string scenario;  // its name
  std::uint64_t seed = 1;
  /// A folder of its own, put in place when the run has ended; none: dataset/ in the run's folder.
  std::optional<std::filesystem::path> folder;
};

/// Writes a run as a dataset while it goes: what the stack is given, and the truth as often as the IMU samples (200 Hz
/// without one), with the true calibration. `size` is filled at the end.
SpectatorMaker RecordDataset(DatasetRequest request, std::shared_ptr<DatasetSize> size);

}  // namespace alula::scenarios::dataset

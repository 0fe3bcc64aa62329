#pragma once

#include <filesystem>

#include "scenarios/dataset/recording.h"

namespace alula::scenarios::dataset {

/// Reads a sequence in EuRoC's ASL layout, ours and EuRoC's own: `folder` holds mav0/ or is it. Cameras cam0, cam1, …
/// and imu0 are read where they are there; of the ground truth (state_groundtruth_estimate0) the pose, and velocity and
/// biases where its rows have all 17 columns. Images are read when they are wanted; a stamp whose file is missing is
/// passed over and counted, as EuRoC has some. Ids of sensors are given here: the IMU's is 1, camera i's 10 + i.
/// Throws base::InputError with file and line for what is broken, not ascending in time or missing.
Recording ReadEuroc(const std::filesystem::path& folder);

}  // namespace alula::scenarios::dataset

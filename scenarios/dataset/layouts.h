#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "scenarios/dataset/recording.h"

namespace alula::scenarios::dataset {

/// What a folder holds, by its files: mav0/, cam0/ or imu0/ (EuRoC), calib.txt and an image_N/ (KITTI odometry),
/// rgb.txt (TUM RGB-D); none where it is none of these.
std::optional<Layout> LayoutOf(const std::filesystem::path& folder);

/// "EuRoC ASL", "KITTI odometry", "TUM RGB-D".
std::string_view NameOf(Layout layout);

/// Reads a sequence in whichever of the layouts it is. Images are read when they are wanted; stamps whose file is
/// missing are passed over and counted, files without a stamp are not looked at. `camera_yaml` takes the place of the
/// calibration of a TUM RGB-D recording, which is somebody's guess more often than not; the other layouts have their
/// own. Throws base::InputError with file and line for what is broken, and where the folder is missing or in no layout.
Recording OpenRecording(const std::filesystem::path& folder,
                        const std::optional<std::filesystem::path>& camera_yaml = std::nullopt);

}  // namespace alula::scenarios::dataset

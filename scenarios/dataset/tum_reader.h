#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "scenarios/dataset/recording.h"

namespace alula::scenarios::dataset {

/// For each of `pictures` the index of the entry of `others` that belongs to it: pairs at most `apart` from each other,
/// the closest first, each image in one pair at most (as TUM's own tool pairs them). Both ascend in time.
std::vector<std::optional<std::size_t>> PairByStamp(const std::vector<ImageFile>& pictures,
                                                    const std::vector<ImageFile>& others, base::Duration apart);

/// Reads a sequence in TUM's RGB-D layout: rgb.txt, depth.txt and groundtruth.txt (where they are there), and the
/// calibration that the layout lacks: `camera_yaml` (tum_files.h) where one is given, or else of the folder rgb.yaml
/// and depth.yaml as our own exports have them (sensor.yaml of EuRoC's) or camera.yaml. Camera 0 is that of rgb.txt,
/// camera 1 the depth camera. Body B: forward-left-up at the optical centre of camera 0, whose optical frame is what
/// groundtruth.txt has the poses of. Their world is the recording's own; where gravity-direction.txt says how it hangs,
/// it is turned so that W's z is up. Throws base::InputError with file and line.
Recording ReadTum(const std::filesystem::path& folder,
                  const std::optional<std::filesystem::path>& camera_yaml = std::nullopt);

}  // namespace alula::scenarios::dataset

#pragma once

#include <filesystem>

#include "scenarios/dataset/recording.h"

namespace alula::scenarios::dataset {

/// Reads a sequence in KITTI's odometry layout: calib.txt, times.txt, image_0/ to image_3/ (NNNNNN.png; 0 and 1 are the
/// grey pair, 2 and 3 the colour pair), and of the truth poses.txt or, as KITTI ships it, ../../poses/<name>.txt.
/// Body B: forward-left-up at the optical centre of the camera that the poses are of (image_0's), which is taken to be
/// level at the start: W is B of the first image. Images are read when they are wanted, but the first one of each
/// camera, whose size no file says. Cameras stand in the order of their numbers; the first pair that is whole is
/// `calibration.stereo`. Throws base::InputError with file and line.
Recording ReadKitti(const std::filesystem::path& folder);

}  // namespace alula::scenarios::dataset

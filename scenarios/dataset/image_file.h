#pragma once

#include "scenarios/dataset/recording.h"

namespace alula::scenarios::dataset {

/// An image file's pixels, PNG or JPEG as its first bytes say: 8-bit grey or RGB; nothing is known of the exposure.
/// Throws base::InputError where it is broken or has 16 bits a sample.
stack::Image ReadImage(const std::filesystem::path& file);

/// One image of a recording. Throws base::InputError where it is broken or not of the size that the camera's
/// calibration says.
stack::Image LoadImage(const ImageFile& image, const stack::CameraCalibration& camera);

/// One depth image of a recording, of 16-bit PNG. Values of 0 and 65535 are no measurement, nor is what lies beyond the
/// 65.5 m that stack::DepthImage can hold; depths are rounded to the millimetre. Throws as LoadImage does.
stack::DepthImage LoadDepth(const ImageFile& image, const stack::CameraCalibration& camera, double values_per_metre);

}  // namespace alula::scenarios::dataset

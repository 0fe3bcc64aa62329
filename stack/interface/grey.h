#pragma once

#include "stack/interface/measurement.h"

namespace alula::stack {

/// The luma of a colour image, Y = 0.299 R + 0.587 G + 0.114 B (ITU-R BT.601, as OpenCV and JPEG have it), rounded to
/// the nearest; a grey image as it is, its pixels shared.
Image ToGrey(const Image& image);

}  // namespace alula::stack

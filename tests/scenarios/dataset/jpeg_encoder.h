#pragma once

#include <string>

#include "stack/interface/measurement.h"

namespace alula::scenarios::dataset::testing {

/// An image as a baseline JPEG file of quality 95, colour at full resolution, made by libjpeg itself.
std::string EncodeJpeg(const stack::Image& image);

}  // namespace alula::scenarios::dataset::testing

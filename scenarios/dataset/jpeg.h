#pragma once

#include <string>
#include <string_view>

#include "stack/interface/measurement.h"

namespace alula::scenarios::dataset {

/// True where the bytes begin as a JPEG file does.
bool LooksLikeJpeg(std::string_view bytes);

/// Reads a JPEG file's bytes: grey stays grey, colour becomes RGB; nothing is known of the exposure. The accurate
/// integer transform is used, so that every machine gives the same pixels. `name` goes into the message. Throws
/// base::InputError for anything else, broken and cut files, and images of more than 2²⁶ pixels.
stack::Image DecodeJpeg(std::string_view bytes, const std::string& name);

}  // namespace alula::scenarios::dataset

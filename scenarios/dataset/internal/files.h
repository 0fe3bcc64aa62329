#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text_rows.h"
#include "scenarios/dataset/recording.h"

// What the readers of all layouts share.
namespace alula::scenarios::dataset::internal {

/// The id that a reader gives to camera i.
constexpr stack::SensorId CameraId(int i) { return static_cast<stack::SensorId>(10 + i); }

/// A whole file. Throws base::InputError that ends in `wanted`.
std::string ReadWhole(const std::filesystem::path& file, std::string_view wanted);

/// `time`; throws base::InputError at the row's place where it is not later than `last`.
base::Time Later(const base::TextRow& row, base::Time time, std::optional<base::Time> last);

/// Appends the image if its file is there, and counts it as missing if not.
void AddIfThere(ImageFile image, std::vector<ImageFile>& images, int& missing);

/// One over the median time between images, as a fraction of whole microseconds; 1 Hz for fewer than two.
base::Rate MedianRate(const std::vector<base::Time>& times);

}  // namespace alula::scenarios::dataset::internal

#include "scenarios/dataset/internal/files.h"

#include <algorithm>
#include <numeric>
#include <sstream>
#include <utility>

#include "base/error.h"

namespace alula::scenarios::dataset::internal {

std::string ReadWhole(const std::filesystem::path& file, std::string_view wanted) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  std::error_code error;
  if (!stream || std::filesystem::is_directory(file, error) || !(text << stream.rdbuf())) {
    throw base::InputError({file.string()}, "", "cannot be read; " + std::string(wanted));
  }
  return text.str();
}

base::Time Later(const base::TextRow& row, base::Time time, std::optional<base::Time> last) {
  if (last && time <= *last) row.Fail("timestamp", "is not later than that of the row before");
  return time;
}

void AddIfThere(ImageFile image, std::vector<ImageFile>& images, int& missing) {
  std::error_code error;
  if (std::filesystem::is_regular_file(image.file, error)) {
    images.push_back(std::move(image));
  } else {
    ++missing;
  }
}

base::Rate MedianRate(const std::vector<base::Time>& times) {
  if (times.size() < 2) return {1, 1};
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back((times[i] - times[i - 1]).ns);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  constexpr std::int64_t kMicrosecond = 1000, kSecond = 1'000'000;
  const std::int64_t period = std::max<std::int64_t>(1, (*middle + kMicrosecond / 2) / kMicrosecond);
  const std::int64_t divisor = std::gcd(kSecond, period);
  return {kSecond / divisor, period / divisor};
}

}  // namespace alula::scenarios::dataset::internal

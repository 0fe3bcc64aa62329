#include "scenarios/dataset/layouts.h"

#include "base/error.h"
#include "scenarios/dataset/euroc_reader.h"
#include "scenarios/dataset/kitti_reader.h"
#include "scenarios/dataset/tum_reader.h"

namespace alula::scenarios::dataset {
namespace fs = std::filesystem;
namespace {

struct Reader {
  Layout layout;
  std::string_view name;
  bool (*fits)(const fs::path& folder);
  Recording (*read)(const fs::path& folder);
};

bool Has(const fs::path& folder, std::string_view name) {
  std::error_code error;
  return fs::exists(folder / name, error);
}

const Reader kReaders[] = {
    {Layout::kEuroc, "EuRoC ASL",
     [](const fs::path& folder) { return Has(folder, "mav0") || Has(folder, "cam0") || Has(folder, "imu0"); },
     ReadEuroc},
    {Layout::kKitti, "KITTI odometry",
     [](const fs::path& folder) {
       return Has(folder, "calib.txt") && (Has(folder, "image_0") || Has(folder, "image_2"));
     },
     ReadKitti},
    {Layout::kTum, "TUM RGB-D", [](const fs::path& folder) { return Has(folder, "rgb.txt"); },
     [](const fs::path& folder) { return ReadTum(folder); }},
};

}  // namespace

std::optional<Layout> LayoutOf(const fs::path& folder) {
  for (const Reader& reader : kReaders) {
    if (reader.fits(folder)) return reader.layout;
  }
  return std::nullopt;
}

std::string_view NameOf(Layout layout) {
  for (const Reader& reader : kReaders) {
    if (reader.layout == layout) return reader.name;
  }
  return {};
}

Recording OpenRecording(const fs::path& folder, const std::optional<fs::path>& camera_yaml) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw base::InputError({folder.string()}, "", "is no folder");
  const std::optional<Layout> layout = LayoutOf(folder);
  if (camera_yaml && layout == Layout::kTum) return ReadTum(folder, camera_yaml);
  if (camera_yaml && layout) {
    throw base::InputError({camera_yaml->string()}, "",
                           "is not wanted: " + std::string(NameOf(*layout)) + " has a calibration of its own");
  }
  for (const Reader& reader : kReaders) {
    if (reader.layout == layout) return reader.read(folder);
  }
  throw base::InputError({folder.string()}, "",
                         "holds no recording; wanted is mav0/ (EuRoC ASL), calib.txt beside image_0/ (KITTI odometry) "
                         "or rgb.txt (TUM RGB-D)");
}

}  // namespace alula::scenarios::dataset

#pragma once

#include <filesystem>

namespace alula::scenarios::campaign {

/// A sweep's folder, locked: two sweeps in one folder would fly everything twice. Throws base::InputError.
class SweepFolder {
 public:
  SweepFolder(const std::filesystem::path& folder, bool fresh);
  ~SweepFolder();
  SweepFolder(const SweepFolder&) = delete;
  SweepFolder& operator=(const SweepFolder&) = delete;
  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
  int lock_ = -1;
};

}  // namespace alula::scenarios::campaign

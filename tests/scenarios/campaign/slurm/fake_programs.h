#pragma once

#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::slurm::testing {

/// Programs of our own in the place of Slurm's, for one test: shell scripts in a folder that comes first on the PATH.
class FakePrograms {
 public:
  explicit FakePrograms(const std::string& test) : folder_("slurm_fake_" + test), path_(std::getenv("PATH")) {
    ::setenv("PATH", (folder_.path().string() + ":" + path_).c_str(), 1);
  }
  ~FakePrograms() { ::setenv("PATH", path_.c_str(), 1); }
  FakePrograms(const FakePrograms&) = delete;
  FakePrograms& operator=(const FakePrograms&) = delete;

  void Add(const std::string& name, const std::string& body) {
    const std::filesystem::path file = folder_.path() / name;
    std::ofstream(file) << "#!/bin/bash\n" << body << "\n";
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }
  /// Nothing but what this folder holds.
  void HideOthers() { ::setenv("PATH", folder_.path().c_str(), 1); }
  std::filesystem::path path() const { return folder_.path(); }

 private:
  scenarios::testing::TemporaryFolder folder_;
  std::string path_;
};

}  // namespace alula::scenarios::slurm::testing

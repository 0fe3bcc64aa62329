#pragma once

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace alula::sim {

/// The folder of one run. Everything is written into a hidden folder inside it and moved out by `Commit`, so that a run
/// killed at any moment leaves whole files of an earlier run or none. Without Commit nothing stays behind, not even
/// folders that were made for it.
class RunFolder {
 public:
  /// Throws base::InputError where the folder cannot be made or written to. `writer`: a process whose hidden folder is
  /// taken over, with all that it had written before it died; 0: this process, with nothing in it.
  explicit RunFolder(const std::filesystem::path& folder, pid_t writer = 0);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  /// The hidden folder of a process.
  static std::filesystem::path PartialOf(const std::filesystem::path& folder, pid_t writer);
  /// Where a file called `name` is to be written.
  std::filesystem::path PathOf(std::string_view name) const { return partial_ / name; }
  /// Writes a whole text file.
  void Write(std::string_view name, std::string_view text) const;
  /// Replaces the files of an earlier run by those of this one; verdict.json goes first and comes back last. Files and
  /// folders that not every run makes are named in `optional`: one of an earlier run goes, so that what lies here is
  /// one run's.
  void Commit(std::initializer_list<std::string_view> optional = {});
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
  std::filesystem::path partial_;
  std::vector<std::filesystem::path> made_;  // folders that did not exist, innermost first
  bool committed_ = false;
};

/// A text file that is written as a stream, line by line, so that what a process wrote before it died is there. Throws
/// base::FaultError("disk") when the disk is full.
class StreamFile {
 public:
  explicit StreamFile(const std::filesystem::path& file);
  ~StreamFile();
  StreamFile(const StreamFile&) = delete;
  StreamFile& operator=(const StreamFile&) = delete;

  void Write(std::string_view text);
  void Close();

 private:
  std::string name_;
  std::FILE* file_ = nullptr;
};

}  // namespace alula::sim

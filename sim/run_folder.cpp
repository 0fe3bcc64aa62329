#include "sim/run_folder.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include "base/error.h"

namespace alula::sim {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kPrefix = ".partial-";

/// Leftovers of runs that were killed: hidden folders whose process is gone.
void RemoveStale(const fs::path& folder, pid_t spared) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(kPrefix)) continue;
    const pid_t pid = static_cast<pid_t>(std::atoi(name.c_str() + kPrefix.size()));
    if (pid == spared) continue;
    if (pid <= 0 || (::kill(pid, 0) != 0 && errno == ESRCH)) fs::remove_all(entry.path(), ignored);
  }
}

}  // namespace

fs::path RunFolder::PartialOf(const fs::path& folder, pid_t writer) {
  return folder.lexically_normal() / (std::string(kPrefix) + std::to_string(writer));
}

RunFolder::RunFolder(const fs::path& folder, pid_t writer) : folder_(folder.lexically_normal()) {
  for (fs::path p = folder_; !p.empty() && !fs::exists(p); p = p.parent_path()) made_.push_back(p);
  std::error_code error;
  fs::create_directories(folder_, error);
  if (!error) {
    RemoveStale(folder_, writer);
    partial_ = PartialOf(folder_, writer != 0 ? writer : ::getpid());
    if (writer == 0) fs::remove_all(partial_, error);
    fs::create_directory(partial_, error);
  }
  if (error) {
    throw base::InputError("--out: cannot write to " + folder_.string() + " (" + error.message() +
                           "); name a folder that can be written");
  }
}

RunFolder::~RunFolder() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
  for (const fs::path& p : made_) fs::remove(p, ignored);  // fails, as it should, where something else lies in it
}

void RunFolder::Write(std::string_view name, std::string_view text) const {
  StreamFile file(PathOf(name));
  file.Write(text);
  file.Close();
}

void RunFolder::Commit(std::initializer_list<std::string_view> optional) {
  const fs::path verdict = "verdict.json";
  fs::remove(folder_ / verdict);
  for (const std::string_view name : optional) fs::remove_all(folder_ / name);
  for (const fs::directory_entry& entry : fs::directory_iterator(partial_)) {
    const fs::path name = entry.path().filename();
    if (name == verdict) continue;
    if (entry.is_directory()) fs::remove_all(folder_ / name);
    fs::rename(entry.path(), folder_ / name);
  }
  if (fs::exists(partial_ / verdict)) fs::rename(partial_ / verdict, folder_ / verdict);
  fs::remove_all(partial_);
  committed_ = true;
}

StreamFile::StreamFile(const fs::path& file) : name_(file.filename().string()), file_(std::fopen(file.c_str(), "wb")) {
  if (file_ != nullptr) std::setvbuf(file_, nullptr, _IOLBF, BUFSIZ);
  if (file_ == nullptr) throw base::FaultError("disk", "cannot open " + name_ + ": " + std::strerror(errno));
}

StreamFile::~StreamFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void StreamFile::Write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) {
    throw base::FaultError("disk", "cannot write " + name_ + ": " + std::strerror(errno));
  }
}

void StreamFile::Close() {
  std::FILE* const file = file_;
  file_ = nullptr;
  if (file != nullptr && std::fclose(file) != 0) {
    throw base::FaultError("disk", "cannot finish " + name_ + ": " + std::strerror(errno));
  }
}

}  // namespace alula::sim

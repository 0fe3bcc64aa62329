#include "geometry/internal/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace alula::geometry::internal {
namespace {

/// A file descriptor that closes itself.
struct Opened {
  explicit Opened(const std::filesystem::path& file)
      // Without O_NONBLOCK a pipe that nobody writes to would hold us for ever.
      : descriptor(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {}
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  ~Opened() {
    if (descriptor >= 0) close(descriptor);
  }
  int descriptor;
};

}  // namespace

void FailIn(const std::filesystem::path& file, std::string_view what) {
  throw base::InputError({file.generic_string()}, "", what);
}

std::string ReadWhole(const std::filesystem::path& file, std::string_view kind, std::size_t max_bytes) {
  const std::string name(kind);
  const Opened opened(file);
  if (opened.descriptor < 0) {
    if (errno == ENOENT || errno == ENOTDIR) FailIn(file, "there is no such " + name + " file");
    FailIn(file, "the " + name + " file cannot be read: " + std::strerror(errno));
  }
  struct stat status = {};
  if (fstat(opened.descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    FailIn(file, "is no regular file; name a " + name + " file");
  }
  if (status.st_size == 0) FailIn(file, "the " + name + " file is empty");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > max_bytes) {
    FailIn(file, "the " + name + " file has " + std::to_string(size) + " bytes; at most " + std::to_string(max_bytes) +
                     " are read");
  }
  std::string bytes(size, '\0');
  for (std::size_t done = 0; done < size;) {
    const ssize_t got = read(opened.descriptor, bytes.data() + done, size - done);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) FailIn(file, "the " + name + " file cannot be read to its end");
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

std::string LowerExtension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string Shown(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string shown(text.substr(0, kLongest));
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < 0x20 || c > 0x7e; }, '?');
  return shown;
}

}  // namespace alula::geometry::internal

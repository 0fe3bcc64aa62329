#include "scenarios/report/mp4_writer.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.h"

extern char** environ;

namespace alula::scenarios {

namespace {

/// ffmpeg's arguments: raw RGB from standard input, H.264 that every player shows, index at the front of the file.
std::vector<std::string> EncoderArguments(const std::filesystem::path& file, int width, int height, int rate) {
  return {"ffmpeg",
          "-hide_banner",
          "-loglevel",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pix_fmt",
          "rgb24",
          "-video_size",
          std::to_string(width) + "x" + std::to_string(height),
          "-framerate",
          std::to_string(rate),
          "-i",
          "pipe:0",
          "-an",
          "-c:v",
          "libx264",
          "-preset",
          "veryfast",
          "-crf",
          "22",
          "-pix_fmt",
          "yuv420p",
          "-threads",
          "1",
          "-movflags",
          "+faststart",
          "-f",
          "mp4",
          file.string()};
}

/// Starts ffmpeg with `read_end` as its standard input; it ignores Ctrl-C, which is ours to handle.
pid_t Spawn(std::vector<std::string> arguments, int read_end, int write_end) {
  std::vector<char*> argv;
  for (std::string& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, read_end, 0);
  posix_spawn_file_actions_addclose(&actions, write_end);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  pid_t child = -1;
  const int failed = posix_spawnp(&child, "ffmpeg", &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return failed == 0 ? child : -1;
}

}  // namespace

Mp4Writer::Mp4Writer(const std::filesystem::path& file, int width, int height, int rate)
    : file_(file),
      part_(file.parent_path() / ("." + file.filename().string() + ".part")),
      frame_bytes_(static_cast<std::size_t>(width) * height * 3) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw base::FaultError("video", "no pipe to ffmpeg: " + std::error_code(errno, std::generic_category()).message());
  }
  std::signal(SIGPIPE, SIG_IGN);  // a dead encoder is reported by write(), not by the end of this process
  child_ = Spawn(EncoderArguments(part_, width, height, rate), ends[0], ends[1]);
  close(ends[0]);
  pipe_ = ends[1];
  if (child_ < 0) {
    Abandon();
    throw base::InputError("--video: ffmpeg cannot be started; install the package ffmpeg");
  }
}

Mp4Writer::~Mp4Writer() { Abandon(); }

void Mp4Writer::Add(std::span<const std::uint8_t> rgb) {
  if (rgb.size() != frame_bytes_) throw base::FaultError("video", "a picture of the wrong size");
  for (std::size_t done = 0; done < rgb.size();) {
    const ssize_t n = write(pipe_, rgb.data() + done, rgb.size() - done);
    if (n > 0) {
      done += static_cast<std::size_t>(n);
    } else if (errno != EINTR) {
      throw base::FaultError("video", "ffmpeg stopped reading pictures");
    }
  }
}

void Mp4Writer::Finish() {
  close(pipe_);
  pipe_ = -1;
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    Abandon();
    throw base::FaultError("video", "ffmpeg failed to finish the video");
  }
  std::filesystem::rename(part_, file_);
}

void Mp4Writer::Abandon() noexcept {
  if (pipe_ >= 0) close(pipe_);
  pipe_ = -1;
  if (child_ > 0) {
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
    child_ = -1;
  }
  std::error_code ignored;  // nothing to remove after Finish
  std::filesystem::remove(part_, ignored);
}

}  // namespace alula::scenarios

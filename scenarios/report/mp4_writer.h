#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <span>

namespace alula::scenarios {

/// Encodes RGB pictures as H.264 in MP4 through an ffmpeg child process that reads raw frames from a pipe.
/// The file is written under a temporary name beside the target and renamed by `Finish`; without it nothing stays
/// behind.
class Mp4Writer {
 public:
  /// `rate`: pictures a second. Throws base::InputError where ffmpeg is missing or the folder cannot be written.
  Mp4Writer(const std::filesystem::path& file, int width, int height, int rate);
  ~Mp4Writer();
  Mp4Writer(const Mp4Writer&) = delete;
  Mp4Writer& operator=(const Mp4Writer&) = delete;

  /// One picture: width · height · 3 bytes, rows from the top. Throws base::FaultError where ffmpeg died.
  void Add(std::span<const std::uint8_t> rgb);
  /// Waits for the encoder and puts the file in place.
  void Finish();

 private:
  void Abandon() noexcept;

  std::filesystem::path file_;
  std::filesystem::path part_;
  std::size_t frame_bytes_;
  int pipe_ = -1;
  pid_t child_ = -1;
};

}  // namespace alula::scenarios

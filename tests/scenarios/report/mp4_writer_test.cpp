#include "scenarios/report/mp4_writer.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"

namespace alula::scenarios {
namespace {

namespace fs = std::filesystem;

std::string Output(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe.get()) != nullptr) text += buffer.data();
  return text;
}

fs::path FreshFolder(const std::string& name) {
  const fs::path folder = fs::temp_directory_path() / ("alula_mp4_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

TEST(Mp4Writer, WritesAllPicturesAtTheGivenRate) {
  const fs::path file = FreshFolder("whole") / "video.mp4";
  Mp4Writer writer(file, 64, 48, 30);
  for (int i = 0; i < 45; ++i) {
    writer.Add(std::vector<std::uint8_t>(64 * 48 * 3, static_cast<std::uint8_t>(5 * i)));
  }
  EXPECT_FALSE(fs::exists(file));  // not before it is whole
  writer.Finish();
  ASSERT_TRUE(fs::exists(file));
  EXPECT_EQ(Output("ffprobe -v error -count_frames -select_streams v:0 -show_entries "
                   "stream=codec_name,width,height,nb_read_frames,r_frame_rate -of csv=p=0 '" +
                   file.string() + "'"),
            "h264,64,48,30/1,45\n");
}

TEST(Mp4Writer, LeavesNothingBehindWhenNotFinished) {
  const fs::path folder = FreshFolder("abandoned");
  {
    Mp4Writer writer(folder / "video.mp4", 64, 48, 30);
    writer.Add(std::vector<std::uint8_t>(64 * 48 * 3, 7));
  }
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Mp4Writer, SaysWhenTheEncoderDied) {
  Mp4Writer writer("/nonexistent/folder/video.mp4", 64, 48, 30);
  EXPECT_THROW(
      {
        for (int i = 0; i < 500; ++i) writer.Add(std::vector<std::uint8_t>(64 * 48 * 3, 7));
        writer.Finish();
      },
      base::FaultError);
}

}  // namespace
}  // namespace alula::scenarios

#include "sim/run_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "base/error.h"

namespace alula::sim {
namespace {
namespace fs = std::filesystem;

class RunFolderTest : public ::testing::Test {
 protected:
  RunFolderTest() : root_(fs::temp_directory_path() / ("alula_run_folder_" + std::to_string(::getpid()))) {
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  ~RunFolderTest() override { fs::remove_all(root_); }
  static std::string Read(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  fs::path root_;
};

TEST_F(RunFolderTest, LeavesNothingWithoutCommit) {
  {
    RunFolder folder(root_ / "a" / "1");
    folder.Write("verdict.json", "{}");
    EXPECT_FALSE(fs::exists(root_ / "a" / "1" / "verdict.json"));
  }
  EXPECT_FALSE(fs::exists(root_ / "a"));
  EXPECT_TRUE(fs::exists(root_));
}

TEST_F(RunFolderTest, ReplacesAnEarlierRunAndKeepsWhatIsNotItsOwn) {
  {
    RunFolder folder(root_ / "run");
    folder.Write("verdict.json", "old");
    folder.Write("video.mp4", "of the old run");
    folder.Commit();
  }
  std::ofstream(root_ / "run" / "notes.txt") << "mine";
  RunFolder folder(root_ / "run");
  folder.Write("verdict.json", "new");
  EXPECT_EQ(Read(root_ / "run" / "verdict.json"), "old");
  folder.Commit({"video.mp4", "map.bt"});
  EXPECT_EQ(Read(root_ / "run" / "verdict.json"), "new");
  EXPECT_EQ(Read(root_ / "run" / "notes.txt"), "mine");
  int entries = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(root_ / "run")) ++entries;
  EXPECT_EQ(entries, 2);
}

TEST_F(RunFolderTest, SaysInOneLineWhereItCannotWrite) {
  std::ofstream(root_ / "file") << "x";
  try {
    RunFolder folder(root_ / "file" / "run");
    FAIL();
  } catch (const base::InputError& e) {
    const std::string message = e.what();
    EXPECT_NE(message.find("cannot write to"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace alula::sim

// The first mission end to end, in pairs: whatever may differ between two runs of one seed differs here.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/scenarios/command.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::testing {
namespace {

namespace fs = std::filesystem;

nlohmann::json Fly(const fs::path& out, const fs::path& directory, std::vector<std::string> more) {
  std::vector<std::string> arguments = {"run", "courtyard_gates", "--json", "-", "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const CommandResult run = Alula(arguments, {.directory = directory.string(), .environment = {}});
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  return run.exit_code <= 1 ? nlohmann::json::parse(run.out) : nlohmann::json();
}

TEST(CourtyardGates, PassesAndIsOneRunWithWorkersVideoAndFolder) {
  const TemporaryFolder folder("courtyard");
  const fs::path plain = folder.path() / "plain";
  const fs::path filmed = folder.path() / "filmed";
  const nlohmann::json first = Fly(plain, "", {"--workers", "1"});
  const nlohmann::json second = Fly(filmed, folder.path(), {"--workers", "2", "--video"});

  EXPECT_EQ(first["outcome"], "pass");
  for (const auto& check : first["checks"]) EXPECT_TRUE(check["passed"]) << check;
  EXPECT_EQ(first["digests"], second["digests"]);
  EXPECT_EQ(first["digest"], second["digest"]);
  EXPECT_FALSE(fs::exists(plain / "video.mp4"));
  EXPECT_GT(fs::file_size(filmed / "video.mp4"), 1'000'000U);
  EXPECT_GT(fs::file_size(plain / "map.bt"), 10'000U);
  EXPECT_EQ(ReadText(plain / "map.bt"), ReadText(filmed / "map.bt"));
  for (const auto& entry : fs::directory_iterator(filmed)) EXPECT_NE(entry.path().filename().string()[0], '.');
}

TEST(CourtyardGates, PassesWithGlAndIsOneRunWithBothMakers) {
  const TemporaryFolder folder("courtyard_gl");
  const nlohmann::json first = Fly(folder.path() / "osmesa", "", {"--render", "osmesa", "--workers", "1"});
  const nlohmann::json second = Fly(folder.path() / "egl", "", {"--render", "egl", "--workers", "2"});

  EXPECT_EQ(first["outcome"], "pass");
  EXPECT_EQ(first["digests"], second["digests"]);
  EXPECT_EQ(first["digest"], second["digest"]);
}

}  // namespace
}  // namespace alula::scenarios::testing

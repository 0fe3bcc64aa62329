// docs/examples/own_stack as its README builds and flies it: a copy elsewhere, the very command, nothing of ours but
// plugin.h.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include "scenarios/plugin/plugin_stack.h"
#include "tests/scenarios/command.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios {
namespace {

namespace fs = std::filesystem;
using testing::ReadText;
using testing::TemporaryFolder;

const fs::path kExample = fs::path(ALULA_SOURCE_DIR) / "docs" / "examples" / "own_stack";

/// The first line of the README's code that begins with `word`.
std::string ReadmeCommand(const std::string& word) {
  std::istringstream lines(ReadText(kExample / "README.md"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(word)) return line;
  }
  return {};
}

TEST(OwnStack, BuiltByTheCommandOfItsReadmeItFliesHover) {
  const TemporaryFolder folder("own_stack");
  fs::copy_file(kExample / "my_stack.cpp", folder.path() / "my_stack.cpp");
  const std::string command = ReadmeCommand("c++ ");
  ASSERT_FALSE(command.empty());
  // plugin.h lies alone in what stands for Alula's tree: another header of ours would not be found.
  fs::create_directories(folder.path() / "alula/stack/interface");
  fs::copy_file(fs::path(ALULA_SOURCE_DIR) / "stack/interface/plugin.h",
                folder.path() / "alula/stack/interface/plugin.h");
  const std::string shell = "cd '" + folder.path().string() + "' && export ALULA='" +
                            (folder.path() / "alula").string() + "' && " + command + " -Wall -Wextra -Werror";
  ASSERT_EQ(std::system(shell.c_str()), 0) << shell;

  const base::Override flies = StackOverride("./libmystack.so");
  const testing::CommandResult run = testing::Alula(
      {"run", "hover", "--set", flies.path + "=" + flies.value, "--out", "r"}, {.directory = folder.path()});
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_NE(run.out.find("hover: pass (landed)"), std::string::npos) << run.out;
  EXPECT_NE(ReadText(folder.path() / "r/events.jsonl").find("all waypoints visited"), std::string::npos);
}

TEST(OwnStack, RefusesAVehicleWithoutAPositionReference) {
  const TemporaryFolder folder("own_stack_refuses");
  const base::Override flies = StackOverride(MISBEHAVING_STACK);
  const testing::CommandResult run =
      testing::Alula({"run", "courtyard_gates", "--set", flies.path + "=" + flies.value, "--out", folder.path() / "r"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("stack: my_stack needs a position reference and waypoints"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace alula::scenarios

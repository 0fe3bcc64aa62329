// The alula command as a user meets it.
#include "tests/scenarios/command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::testing {
namespace {

namespace fs = std::filesystem;

bool IsEmpty(const fs::path& folder) { return fs::directory_iterator(folder) == fs::directory_iterator(); }

TEST(Command, HoverPassesEndToEnd) {
  const TemporaryFolder folder("hover");
  const CommandResult run = Alula({"run", "hover"}, {.directory = folder.path()});
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_NE(run.out.find("hover: pass (landed), seed 1"), std::string::npos) << run.out;
  const fs::path files = folder.path() / "runs" / "hover" / "1";
  for (const char* name : {"verdict.json", "timing.json", "scenario.yaml", "truth.tum", "estimate.tum", "events.jsonl",
                           "telemetry.csv", "world.json"}) {
    EXPECT_GT(fs::file_size(files / name), 50U) << name;
  }
  const auto verdict = nlohmann::json::parse(ReadText(files / "verdict.json"));
  EXPECT_EQ(verdict["outcome"], "pass");
  EXPECT_EQ(verdict["seed"], 1);
  EXPECT_EQ(verdict["digest"].get<std::string>().size(), 16U);
  for (const auto& check : verdict["checks"]) EXPECT_TRUE(check["passed"]) << check;
  EXPECT_LT(verdict["metrics"]["ate_online_m"], 0.05);
  EXPECT_TRUE(nlohmann::json::parse(ReadText(files / "timing.json"))["real_time_factor"].is_number());
  for (const auto& entry : fs::directory_iterator(files)) EXPECT_NE(entry.path().filename().string()[0], '.');
}

TEST(Command, TheDoorKnowsEveryVerb) {
  const std::string help = Alula({"--help"}).out, door = ReadText(fs::path(ALULA_SOURCE_DIR) / "alula");
  const std::size_t begin = door.find("verbs=\"") + 7;
  const std::string known = " " + door.substr(begin, door.find('"', begin) - begin) + " ";
  std::istringstream lines(help.substr(help.find("Subcommands:")));
  std::string line, verb;
  std::getline(lines, line);
  int verbs = 0;
  while (std::getline(lines, line)) {
    if (line.size() < 4 || line[2] == ' ') continue;  // an empty line, or the text of a verb goes on
    std::istringstream(line) >> verb;
    EXPECT_NE(known.find(" " + verb + " "), std::string::npos) << verb;
    EXPECT_NE(door.find("\n  " + verb + " "), std::string::npos) << verb << " is not in the door's help";
    ++verbs;
  }
  EXPECT_GE(verbs, 8);
}

TEST(Command, FailedCriterionExitsWithOne) {
  const TemporaryFolder folder("fail");
  const CommandResult run =
      Alula({"run", "hover", "--set", "criteria=[{type: time_limit, limit: 1 s}]", "--out", folder.path() / "r"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.out.find("FAIL  duration"), std::string::npos) << run.out;
}

TEST(Command, JsonIsAllThatIsPrinted) {
  const TemporaryFolder folder("json");
  const CommandResult run = Alula({"run", "hover", "--json", "-", "--out", folder.path() / "r"});
  EXPECT_EQ(nlohmann::json::parse(run.out)["outcome"], "pass");
  EXPECT_EQ(run.err, "");
  const CommandResult list = Alula({"list", "--json", "-"});
  EXPECT_GE(nlohmann::json::parse(list.out).size(), 3U);
}

struct BadInput {
  std::vector<std::string> arguments;
  std::string message;  // what the line on stderr contains
};

TEST(Command, BadInputIsOneLineAndExitsWithTwo) {
  const TemporaryFolder folder("bad");
  std::ofstream(folder.path() / "file") << "x";
  std::ofstream(folder.path() / "typo.yaml") << "extends: hover\nsensrs:\n  imu:\n    rate: 100 Hz\n";
  std::ofstream(folder.path() / "unit.yaml") << "extends: hover\nvehicle:\n  mass: 0.7\n";
  std::ofstream(folder.path() / "mesh.yaml") << "extends: courtyard_gates\nworld:\n  prop: nowhere.obj\n";
  const std::string out = folder.path() / "r";
  const std::vector<BadInput> table = {
      {{"run", "hoover"}, "did you mean `hover`?"},
      {{"run", folder.path() / "none.yaml"}, "no such file"},
      {{"run", folder.path() / "typo.yaml", "--out", out}, "typo.yaml:2:1: sensrs:"},
      {{"run", folder.path() / "unit.yaml", "--out", out}, "unit.yaml:3:9: vehicle.mass:"},
      {{"check", folder.path() / "mesh.yaml"}, "nowhere.obj"},
      {{"run", "hover", "--set", "vehicle.mas=1 kg", "--out", out}, "mas"},
      {{"run", "hover", "--set", "nonsense"}, "path.to.key=value"},
      {{"run", "hover", "--out", folder.path() / "file" / "r"}, "cannot write to"},
      {{"run", "hover", "--render", "vulkan"}, "--render"},
      {{"run", "hover", "--seed", "minus one"}, "--seed"},
      {{"fly"}, "alula --help"},
      {{}, "alula --help"},
      {{"bench", "nothing"}, "no benchmark is called"},
      {{"check"}, "files is required"},
      {{"check", "sensors"}, "scenario is required"},
      {{"check", "sensors", "hoover"}, "did you mean `hover`?"},
      {{"check", "hover", "sensors", "hover"}, "takes one scenario"},
  };
  for (const BadInput& bad : table) {
    const CommandResult run = Alula(bad.arguments, {.directory = folder.path()});
    EXPECT_EQ(run.exit_code, 2) << bad.message << '\n' << run.err;
    EXPECT_NE(run.err.find(bad.message), std::string::npos) << "wanted: " << bad.message << "\nsaid: " << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(run.out, "") << run.out;
  }
  EXPECT_FALSE(fs::exists(folder.path() / "r"));
  EXPECT_FALSE(fs::exists(folder.path() / "runs"));
}

/// A scenario whose world has one object with this shape and material.
std::string SceneOf(const std::string& shape, const std::string& material) {
  return "extends: hover\nworld:\n  type: scene\n  objects:\n    - shape: " + shape + "\n      material: " + material +
         "\n";
}

TEST(Command, BadMeshesAndTexturesAreOneLineAndExitWithTwo) {
  const TemporaryFolder folder("scene");
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder.path() / name, std::ios::binary) << text;
  };
  write("broken.gltf", "{\"asset\":");
  write("cut.glb", std::string("glTF\x02\0\0\0\xff\0\0\0", 12));
  write("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
  write("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
  write("far.obj", "v 0 0 0\nv 1e30 0 0\n");
  write("deep.gltf", std::string(1'000'000, '['));
  write("empty.obj", "");
  write("text.png", "no picture\n");
  write("broken.png", "\x89PNG\r\n\x1a\n and then nothing");
  const struct {
    std::string shape;
    std::string material;
    std::string message;
  } table[] = {
      {"{type: mesh, file: none.obj}", "{}", "world.objects.0.shape.file: "},
      {"{type: mesh, file: none.obj}", "{}", "none.obj: there is no such mesh file"},
      {"{type: mesh, file: broken.gltf}", "{}", "broken.gltf: is no JSON"},
      {"{type: mesh, file: cut.glb}", "{}", "cut.glb: is no GLB file"},
      {"{type: mesh, file: nan.obj}", "{}", "nan.obj:3:9: the vertex is not finite"},
      {"{type: mesh, file: range.obj}", "{}", "range.obj:4:7: there is no vertex 4"},
      {"{type: mesh, file: far.obj}", "{}", "far.obj:2:10: the vertex lies more than 10 km"},
      {"{type: mesh, file: deep.gltf}", "{}", "nested deeper than 64 levels"},
      {"{type: mesh, file: empty.obj}", "{}", "the mesh file is empty"},
      {"{type: mesh, file: /dev/zero}", "{}", "unknown mesh format"},
      {"{type: sphere}", "{texture: none.png}", "world.objects.0.material.texture: "},
      {"{type: sphere}", "{texture: none.png}", "none.png: there is no such texture file"},
      {"{type: sphere}", "{texture: text.png}", "text.png: is no PNG file"},
      {"{type: sphere}", "{texture: broken.png}", "broken.png: cannot be read as PNG"},
      {"{type: sphere}", "{texture: /dev/zero}", "is no regular file"},
  };
  for (const auto& bad : table) {
    write("s.yaml", SceneOf(bad.shape, bad.material));
    const CommandResult run = Alula({"run", folder.path() / "s.yaml"}, {.directory = folder.path()});
    EXPECT_EQ(run.exit_code, 2) << bad.message << '\n' << run.err;
    EXPECT_NE(run.err.find("s.yaml:" + std::string(bad.shape.starts_with("{type: mesh") ? "5:" : "6:")),
              std::string::npos)
        << run.err;
    EXPECT_NE(run.err.find(bad.message), std::string::npos) << "wanted: " << bad.message << "\nsaid: " << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  EXPECT_FALSE(fs::exists(folder.path() / "runs"));
}

TEST(Command, ASceneOfOnesOwnIsFlownAndItsRecordRunsAgain) {
  const TemporaryFolder folder("own_scene");
  const CommandResult run =
      Alula({"run", "docs/examples/own_scene/own_scene.yaml", "--json", "-", "--out", folder.path() / "r"});
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  const CommandResult again =
      Alula({"run", folder.path() / "r" / "scenario.yaml", "--json", "-", "--out", folder.path() / "s"},
            {.directory = folder.path()});
  ASSERT_EQ(again.exit_code, 0) << again.out << again.err;
  EXPECT_EQ(nlohmann::json::parse(again.out)["digest"], nlohmann::json::parse(run.out)["digest"]);
}

TEST(Command, HelpOfEveryVerb) {
  for (const char* verb : {"run", "export", "list", "check", "bench"}) {
    const CommandResult help = Alula({verb, "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.out.find("--help"), std::string::npos);
  }
  EXPECT_NE(Alula({"check", "sensors", "--help"}).out.find("--render"), std::string::npos);
  EXPECT_EQ(Alula({"--help"}).exit_code, 0);
}

TEST(Command, InterruptLeavesNothingBehind) {
  const TemporaryFolder folder("interrupt");
  // Ten simulated minutes, and the interrupt comes after the first ten seconds of them.
  const CommandResult run = Alula({"run", "hover", "--set", "stack.dwell=600 s", "--set",
                                   "criteria=[{type: time_limit, limit: 3600 s}]", "--out", folder.path() / "a" / "b"},
                                  {.interrupt_when_err_has_lines = 1});
  EXPECT_EQ(run.exit_code, 130) << run.err;
  EXPECT_NE(run.err.find("interrupted"), std::string::npos);
  EXPECT_TRUE(IsEmpty(folder.path()));
}

TEST(Command, CheckSensorsMeasuresAndFindsOut) {
  const CommandResult good = Alula({"check", "sensors", "hover", "--json", "-"});
  EXPECT_EQ(good.exit_code, 0) << good.out;
  const nlohmann::json json = nlohmann::json::parse(good.out);
  EXPECT_EQ(json.at("passed"), true);
  EXPECT_GT(json.at("rows").size(), 20U);
  // A gyro that saturates in its own noise does not have the noise density that is configured.
  const CommandResult bad = Alula({"check", "sensors", "hover", "--set", "sensors.imu.gyro_range=1e-3 rad/s"});
  EXPECT_EQ(bad.exit_code, 1) << bad.out << bad.err;
  EXPECT_NE(bad.out.find("FAIL  vehicle0/imu"), std::string::npos) << bad.out;
}

TEST(Command, CheckSaysGood) {
  const CommandResult check = Alula({"check", "hover", "prescribed_flight", "q250", "courtyard"});
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_NE(check.out.find("hover.yaml: good"), std::string::npos);
}

}  // namespace
}  // namespace alula::scenarios::testing

#include "tests/architecture/include_rules.h"

#include <gtest/gtest.h>

#include <fstream>

namespace alula::architecture {
namespace {

namespace fs = std::filesystem;

std::string All(const std::vector<Violation>& violations) {
  std::string text;
  for (const Violation& violation : violations) text += violation.text + "\n";
  return text;
}

TEST(Architecture, TheTreeKeepsToTheTable) {
  const fs::path root = fs::current_path();  // tests run in the repository root
  ASSERT_TRUE(fs::exists(root / "base/time.h")) << root;
  EXPECT_GT(CountFiles(root), 20u);
  EXPECT_EQ(All(CheckTree(root)), "");
}

TEST(Architecture, ForbiddenArrowsAreFound) {
  const struct {
    const char* path;
    const char* include;
    const char* wrong;
  } cases[] = {
      {"stack/pilot/pilot.cpp", "\"sim/truth.h\"", "stack/ may not"},
      {"stack/mapping/map.h", "\"geometry/mesh.h\"", "stack/ may not"},
      {"stack/interface/command.h", "\"stack/pilot/pilot.h\"", "stack/interface/ may not"},
      {"base/time.h", "\"geometry/mesh.h\"", "base/ may not"},
      {"sim/simulation.cpp", "\"stack/pilot/pilot.h\"", "sim/ may not"},
      {"sim/simulation.cpp", "\"vehicles/quadrotor.h\"", "sim/ may not"},
      {"vehicles/rotor.cpp", "\"worlds/world.h\"", "vehicles/ may not"},
      {"worlds/world.cpp", "\"vehicles/vehicle.h\"", "worlds/ may not"},
      {"render/raster.cpp", "\"sim/truth.h\"", "render/ may not"},
      {"vehicles/rotor.cpp", "<btBulletDynamicsCommon.h>", "vehicles/ may not use bullet"},
      {"stack/mapping/map.cpp", "<GL/gl.h>", "stack/ may not use gl"},
      {"geometry/material.h", "<png.h>", "png headers belong in .cpp files and internal/ headers"},
      {"sim/world.h", "<BulletDynamics/Dynamics/btRigidBody.h>",
       "bullet headers belong in .cpp files and internal/ headers"},
      {"stack/pilot/pilot.cpp", "\"stack/mapping/internal/rays.h\"", "internal/ headers belong to stack/mapping/"},
      {"scenarios/runner.cpp", "\"sim/internal/shapes.h\"", "internal/ headers belong to sim/"},
      {"base/time.cpp", "\"time.h\"", "the include root is the repository"},
  };
  for (const auto& c : cases) {
    const std::string text = std::string("#pragma once\n#  include ") + c.include + "  // planted\n";
    const std::string include = std::string(c.include).substr(1, std::string(c.include).size() - 2);
    EXPECT_EQ(All(CheckFile(c.path, text)), std::string(c.path) + ":2: includes " + include + "; " + c.wrong + "\n");
  }
}

TEST(Architecture, AllowedArrowsPass) {
  EXPECT_EQ(All(CheckFile("stack/mapping/internal/rays.h", "#include <octomap/OcTree.h>\n#include \"base/time.h\"\n")),
            "");
  EXPECT_EQ(All(CheckFile("stack/mapping/map.cpp", "#include \"stack/mapping/internal/rays.h\"\n#include <vector>\n")),
            "");
  EXPECT_EQ(All(CheckFile("tests/sim/a_test.cpp", "#include \"sim/internal/shapes.h\"\n")), "");
  EXPECT_EQ(All(CheckFile("bench/a_bench.cpp", "#include \"sim/internal/shapes.h\"\n")), "");
  EXPECT_EQ(All(CheckFile("sim/a.cpp", "#include \"stack/interface/command.h\"\n")), "");
}

TEST(Architecture, APlantedFileIsFoundInATree) {
  const fs::path root = fs::path(testing::TempDir()) / "alula_architecture";
  fs::remove_all(root);
  fs::create_directories(root / "stack/pilot");
  std::ofstream(root / "stack/pilot/spy.cpp") << "#include \"sim/truth.h\"\n";
  EXPECT_EQ(All(CheckTree(root)), "stack/pilot/spy.cpp:1: includes sim/truth.h; stack/ may not\n");
  fs::remove_all(root);
}

}  // namespace
}  // namespace alula::architecture

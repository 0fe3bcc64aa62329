#include "worlds/scene.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/config.h"
#include "base/error.h"

namespace alula::worlds {
namespace {

namespace fs = std::filesystem;

/// A folder with a mesh, a texture and the YAML of a scene.
class SceneTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("alula_scene_") + info->name());
    fs::create_directories(folder_);
    Write("wedge.obj", "v 0 0 0\nv 1000 0 0\nv 0 1000 0\nv 0 0 1000\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = image.height = 2;
    image.format = PNG_FORMAT_RGB;
    const std::uint8_t texels[12] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 9, 9, 9};
    ASSERT_NE(png_image_write_to_file(&image, (folder_ / "tiles.png").c_str(), 0, texels, 0, nullptr), 0);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  SceneConfig Read(const std::string& yaml) const {
    Write("scene.yaml", yaml);
    return base::ReadConfig<SceneConfig>(base::YamlDocument::Load(folder_ / "scene.yaml", {}), 1);
  }

  /// What is wrong, without the folder's name.
  std::string ErrorOf(const std::string& yaml) const {
    try {
      SceneConfig config = Read(yaml);
      config.texture_size = 32;  // quick
      MakeWorld(config, 1);
    } catch (const base::InputError& error) {
      std::string text = error.what();
      for (std::size_t at = 0; (at = text.find(folder_.string() + "/")) != std::string::npos;) {
        text.erase(at, folder_.string().size() + 1);
      }
      return text;
    }
    return "no error";
  }

  fs::path folder_;
};

constexpr const char* kScene = R"(texture_size: 32
ground: {size: 20 m, material: {colour: [0.5, 0.4, 0.3]}}
objects:
  - name: ramp
    shape: {type: mesh, file: wedge.obj, scale: 0.001}
    position: [3 m, 4 m, 0 m]
    yaw: 90 deg
    material: {texture: tiles.png, texture_scale: 0.5 m}
  - shape: {type: box, size: [1 m, 2 m, 3 m]}
    position: [0 m, 5 m, 1.5 m]
    material: {texture: ./tiles.png}
    collides: false
    class: glass
  - {shape: {type: capsule, radius: 0.25 m, height: 2 m}, material: {pattern: brick}}
gates:
  - {position: [5 m, 0 m, 2 m], yaw: 30 deg}
pad_position: [1 m, 2 m, 0.5 m]
start_yaw: 45 deg
target: [8 m, 8 m, 1 m]
sun_azimuth: 90 deg
sun_elevation: 30 deg
)";

TEST_F(SceneTest, IsBuiltAsDescribed) {
  const World world = MakeWorld(Read(kScene), 1);
  ASSERT_EQ(world.objects.size(), 11U);  // ground, three things, six parts of the gate, pad
  EXPECT_EQ(std::get<geometry::Box>(world.objects[0].shape).half_extents, base::Vec3(10.0, 10.0, 0.25));
  const Object& ramp = world.objects[1];
  EXPECT_EQ(ramp.name, "ramp");
  EXPECT_LT((ramp.X_WO * base::Vec3(1.0, 0.0, 0.0) - base::Vec3(3.0, 5.0, 0.0)).norm(), 1e-12);
  const geometry::Mesh& mesh = *std::get<geometry::MeshShape>(ramp.shape).mesh;
  EXPECT_EQ(mesh.triangles.size(), 4U);
  for (const auto& vertex : mesh.vertices) EXPECT_LE(vertex.position.maxCoeff(), 1.0F + 1e-6F);
  EXPECT_EQ(world.objects[2].name, "object1");
  EXPECT_EQ(std::get<geometry::Box>(world.objects[2].shape).half_extents, base::Vec3(0.5, 1.0, 1.5));
  EXPECT_FALSE(world.objects[2].collides);
  EXPECT_EQ(world.objects[0].semantic, SemanticClass::kGround);
  EXPECT_EQ(world.objects[1].semantic, SemanticClass::kObstacle);
  EXPECT_EQ(world.objects[2].semantic, SemanticClass::kGlass);
  EXPECT_EQ(std::get<geometry::Capsule>(world.objects[3].shape).half_height, 0.75);

  ASSERT_EQ(world.gates.size(), 1U);
  EXPECT_EQ(world.gates[0].X_WG.p, base::Vec3(5.0, 0.0, 2.0));
  EXPECT_EQ(world.pad_object, "pad");
  EXPECT_LT((world.X_WB_start.p - base::Vec3(1.0, 2.0, 0.54)).norm(), 1e-12);  // on the pad's surface
  EXPECT_NEAR(world.objects.back().X_WO.p.z(), 0.52, 1e-12);                   // the pad's middle
  EXPECT_EQ(world.target, base::Vec3(8.0, 8.0, 1.0));
  EXPECT_LT((world.light.to_sun_W - base::Vec3(0.0, std::sqrt(0.75), 0.5)).norm(), 1e-12);
  EXPECT_EQ(world.bounds_low, base::Vec3(-10.0, -10.0, 0.0));
}

TEST_F(SceneTest, EachFileIsReadOnceAndEachMaterialMadeOnce) {
  const World world = MakeWorld(Read(kScene), 1);
  EXPECT_EQ(world.objects[1].material, world.objects[2].material);
  EXPECT_EQ(world.materials.size(), 5U);  // ground, tiles, brick, the gate's signal, pad
  const auto& tiles = world.materials[static_cast<std::size_t>(world.objects[1].material)];
  ASSERT_TRUE(tiles.texture);
  EXPECT_EQ(tiles.texture->width, 2);
  EXPECT_EQ(world.materials[0].colour, Eigen::Vector3f(0.5F, 0.4F, 0.3F));
}

TEST_F(SceneTest, ADumpReadsBackFromAnotherFolder) {
  const SceneConfig config = Read(kScene);
  const std::string dump = base::DumpConfig(config);
  EXPECT_NE(dump.find((folder_ / "wedge.obj").string()), std::string::npos);
  const auto again = base::ReadConfig<SceneConfig>(base::YamlDocument::Parse(dump, "elsewhere/x.yaml"), 1);
  EXPECT_EQ(base::DumpConfig(again), dump);
  EXPECT_EQ(MakeWorld(again, 1).objects.size(), 11U);
}

std::string MeshScene(const std::string& file) {
  return "objects:\n  - name: a\n    shape:\n      type: mesh\n      file: " + file + "\n";
}
std::string TextureScene(const std::string& file) {
  return "objects:\n  - shape: {type: sphere}\n    material:\n      texture: " + file + "\n";
}

TEST_F(SceneTest, WhatIsWrongHasItsPlace) {
  Write("broken.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
  Write("nan.obj", "v 0 0 0\nv 1 0 nan\n");
  Write("text.png", "no picture\n");
  const std::string at_file = "scene.yaml:5:13: objects.0.shape.file: ";
  EXPECT_EQ(ErrorOf(MeshScene("none.obj")), at_file + "none.obj: there is no such mesh file");
  EXPECT_EQ(ErrorOf(MeshScene("tiles.png")),
            at_file + "tiles.png: unknown mesh format '.png'; use .gltf, .glb or .obj");
  EXPECT_EQ(ErrorOf(MeshScene("broken.obj")), at_file + "broken.obj:3:7: there is no vertex 3; 2 stand above");
  EXPECT_EQ(ErrorOf(MeshScene("nan.obj")), at_file + "nan.obj:2:7: the vertex is not finite");
  const std::string at_texture = "scene.yaml:4:16: objects.0.material.texture: ";
  EXPECT_EQ(ErrorOf(TextureScene("none.png")), at_texture + "none.png: there is no such texture file");
  EXPECT_EQ(ErrorOf(TextureScene("text.png")), at_texture + "text.png: is no PNG file; convert the texture to PNG");
  EXPECT_EQ(ErrorOf("objects:\n  - {shape: {type: box}, name: a}\n  - {shape: {type: box}, name: a}\n"),
            "scene.yaml:3:32: objects.1.name: `a` is taken; give each object a name of its own");
  EXPECT_EQ(ErrorOf("objects:\n  - {shape: {type: mesh}}\n"),
            "scene.yaml:2:13: objects.0.shape.file: is missing; add it (an .obj, .gltf or .glb file)");
  EXPECT_EQ(ErrorOf("gates: [{position: [0 m, 0 m, 0.5 m]}]\n").find("scene.yaml:1:20: gates.0.position: must lie"),
            0U);
  EXPECT_NE(ErrorOf("pad_position: [500 m, 0 m, 0 m]\n").find("outside the world's bounds"), std::string::npos);
}

TEST_F(SceneTest, ListsWhatMoves) {
  const World world = MakeWorld(Read(R"(texture_size: 32
actors:
  - {type: person, waypoints: [[3 m, 0 m, 0 m], [3 m, 4 m, 0 m]], speed: 1.1 m/s, height: 1.6 m}
  - {type: car, waypoints: [[-20 m, 9 m, 0 m], [20 m, 9 m, 0 m]]}
  - {type: drone, waypoints: [[0 m, -5 m, 3 m]]}
  - {type: people, count: 2, low: [5 m, -8 m, 0 m], high: [15 m, 8 m, 0 m]}
  - {type: grass, tufts: 12}
gates:
  - {position: [4 m, -4 m, 1.5 m], swing: {amplitude: 20 deg, period: 3 s}}
)"),
                                1);
  std::vector<std::string> names;
  for (const Actor& actor : world.actors) names.push_back(actor.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"gate0/frame", "person0", "car1", "drone2", "people3_0", "people3_1", "grass4"}));
  EXPECT_EQ(world.gates[0].actor, 0);
  EXPECT_EQ(std::get<Walk>(world.actors[1].motion).height, 1.6);
}

TEST_F(SceneTest, ActorsThatDoNotFitAreOneClearLine) {
  EXPECT_NE(ErrorOf("actors: [{type: car, waypoints: [[0 m, 0 m, 0 m], [5 m, 0 m, 0 m], [5 m, 5 m, 0 m]]}]")
                .find("actors.0.turn_radius: does not fit: its way: two waypoints lie too close together"),
            std::string::npos);
  EXPECT_NE(ErrorOf("actors: [{type: people, count: 50, low: [3 m, 0 m, 0 m], high: [4 m, 1 m, 0 m]}]")
                .find("people0_: no free room for 50 people"),
            std::string::npos);
}

}  // namespace
}  // namespace alula::worlds

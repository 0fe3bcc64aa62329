#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.h"
#include "geometry/mesh.h"
#include "geometry/shape.h"

namespace alula::geometry {
namespace {

/// A folder of its own for each test, removed afterwards.
class LoadMeshTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) / (std::string("alula_load_mesh_") + info->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  static std::string ErrorOf(const std::filesystem::path& file, std::size_t max_triangles = 1000) {
    try {
      LoadMesh(file, max_triangles);
    } catch (const base::InputError& error) {
      return error.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

const char* const kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST_F(LoadMeshTest, ObjIsTakenAsItStands) {
  const Mesh mesh = LoadMesh(Write("tetrahedron.obj", kTetrahedron));
  ASSERT_EQ(mesh.triangles.size(), 4U);
  const SolidProperties solid = Properties(MeshShape{std::make_shared<const Mesh>(mesh)});
  EXPECT_NEAR(solid.volume, 1.0 / 6.0, 1e-12);
  EXPECT_LT((solid.centre - base::Vec3::Constant(0.25)).norm(), 1e-12);
  for (const auto& v : mesh.vertices) EXPECT_NEAR(v.normal.norm(), 1.0, 1e-5);
}

TEST_F(LoadMeshTest, QuadsAreTriangulated) {
  EXPECT_EQ(LoadMesh(Write("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")).triangles.size(), 2U);
}

/// The tetrahedron as glTF with its buffer beside it: 4 float positions, 12 uint16 indices; y is up there.
std::string Gltf(float apex) {
  const float positions[12] = {0, 0, 0, 1, 0, 0, 0, apex, 0, 0, 0, -1};
  const std::uint16_t indices[12] = {0, 3, 1, 0, 1, 2, 0, 2, 3, 1, 3, 2};
  std::string bytes(sizeof(positions) + sizeof(indices), '\0');
  std::memcpy(bytes.data(), positions, sizeof(positions));
  std::memcpy(bytes.data() + sizeof(positions), indices, sizeof(indices));
  return bytes;
}

const char* const kGltf = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"buffers":[{"uri":"mesh.bin","byteLength":72}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,-1],"max":[1,2,0]},
{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}]})";

TEST_F(LoadMeshTest, GltfIsTurnedToZUp) {
  Write("mesh.bin", Gltf(2.0F));
  const Mesh mesh = LoadMesh(Write("mesh.gltf", kGltf));
  ASSERT_EQ(mesh.triangles.size(), 4U);
  const SolidProperties solid = Properties(MeshShape{std::make_shared<const Mesh>(mesh)});
  EXPECT_NEAR(solid.volume, 2.0 / 6.0, 1e-7);
  EXPECT_LT((solid.centre - base::Vec3(0.25, 0.25, 0.5)).norm(), 1e-7);  // the apex (glTF y = 2) is at z = 2
}

TEST_F(LoadMeshTest, MissingFile) {
  const auto file = folder_ / "nowhere.obj";
  EXPECT_EQ(ErrorOf(file), file.generic_string() + ": there is no such mesh file");
}

TEST_F(LoadMeshTest, UnknownFormat) {
  const auto file = Write("mesh.stl", "solid");
  EXPECT_EQ(ErrorOf(file), file.generic_string() + ": unknown mesh format '.stl'; use .gltf, .glb or .obj");
}

TEST_F(LoadMeshTest, BrokenFile) {
  const auto file = Write("broken.gltf", "{ this is not JSON");
  const std::string message = ErrorOf(file);
  EXPECT_EQ(message.rfind(file.generic_string() + ": cannot be read as a mesh: ", 0), 0U) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST_F(LoadMeshTest, MissingBuffer) {
  const auto file = Write("mesh.gltf", kGltf);
  const std::string message = ErrorOf(file);
  EXPECT_EQ(message.rfind(file.generic_string() + ": cannot be read as a mesh: ", 0), 0U) << message;
}

TEST_F(LoadMeshTest, EmptyFile) {
  const auto file = Write("empty.obj", "");
  const std::string message = ErrorOf(file);
  EXPECT_EQ(message.rfind(file.generic_string() + ": cannot be read as a mesh: ", 0), 0U) << message;
}

TEST_F(LoadMeshTest, NoTriangles) {
  const auto file = Write("points.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
  EXPECT_EQ(ErrorOf(file), file.generic_string() + ": the mesh has no triangles");
}

TEST_F(LoadMeshTest, NotFinite) {
  const auto file = Write("nan.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n");
  EXPECT_EQ(ErrorOf(file), file.generic_string() + ": vertex 2 is not finite");
}

TEST_F(LoadMeshTest, TooManyTriangles) {
  const auto file = Write("many.obj", kTetrahedron);
  EXPECT_EQ(ErrorOf(file, 3), file.generic_string() + ": 4 triangles are more than the 3 allowed");
}

}  // namespace
}  // namespace alula::geometry

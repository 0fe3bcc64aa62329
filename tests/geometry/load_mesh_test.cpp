#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
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

/// What is wrong with the file, without its name.
#define EXPECT_WRONG(file, what) EXPECT_EQ(ErrorOf(file), (file).generic_string() + (what))

TEST_F(LoadMeshTest, BrokenFiles) {
  EXPECT_WRONG(Write("broken.gltf", "{ this is not JSON"),
               ": is no JSON from byte 4 on; the file is broken or of another format");
  EXPECT_WRONG(Write("empty.obj", ""), ": the mesh file is empty");
  EXPECT_WRONG(Write("points.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), ": the mesh has no triangles");
  EXPECT_WRONG(Write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
               ": none of the mesh's 1 triangles has an area; lengths are metres");
  EXPECT_WRONG(Write("text.glb", "this is no mesh at all"), ": is no GLB file");
}

TEST_F(LoadMeshTest, WhatIsNoFile) {
  std::filesystem::create_directories(folder_ / "folder.obj");
  EXPECT_WRONG(folder_ / "folder.obj", ": is no regular file; name a mesh file");
  ASSERT_EQ(mkfifo((folder_ / "pipe.obj").c_str(), 0600), 0);
  EXPECT_WRONG(folder_ / "pipe.obj", ": is no regular file; name a mesh file");
  std::filesystem::create_symlink("/dev/zero", folder_ / "zero.obj");
  EXPECT_WRONG(folder_ / "zero.obj", ": is no regular file; name a mesh file");
  std::filesystem::resize_file(Write("vast.obj", "v"), 65UL << 20U);  // sparse: it takes no room
  EXPECT_WRONG(folder_ / "vast.obj", ": the mesh file has 68157440 bytes; at most 67108864 are read");
}

TEST_F(LoadMeshTest, BrokenObjSaysTheLine) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_WRONG(Write("a.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n"), ":3:9: the vertex is not finite");
  EXPECT_WRONG(Write("b.obj", "v 0 0 1e300\n"), ":1:7: the vertex is not finite");
  EXPECT_WRONG(Write("c.obj", "v 0 1e30 0\n"),
               ":1:10: the vertex lies more than 10 km from the origin; lengths are metres");
  EXPECT_WRONG(Write("d.obj", three + "f 1 2 4\n"), ":4:7: there is no vertex 4; 3 stand above");
  EXPECT_WRONG(Write("e.obj", three + "f 1/1 2 3\n"), ":4:3: there is no texture coordinate 1; 0 stand above");
  EXPECT_WRONG(Write("f.obj", three + "f -4 2 3\n"), ":4:3: there is no vertex -4; 3 stand above");
  EXPECT_WRONG(Write("g.obj", "v 0 zero 0\n"), ":1:5: `zero` is no number");
  EXPECT_WRONG(Write("h.obj", "v 0 0\n"), ":1:6: the line ends too soon; 3 numbers are wanted");
  EXPECT_WRONG(Write("i.obj", "\x01\x02pk\n"),
               ":1:1: `??pk` is no statement of a polygon mesh; export triangles as OBJ text");
  EXPECT_WRONG(Write("j.obj", three + "v 1 1 0\nf 1 2 3 4 1 3 2\n"),
               ":5:16: the face's outline crosses itself or is too long; export triangles");
}

TEST_F(LoadMeshTest, ConcavePolygonsKeepTheirArea) {
  // A square of 4 m without a notch of 4 m by 3 m: 16 − 6 m².
  const Mesh mesh = LoadMesh(Write("arrow.obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\n"));
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f a = mesh.vertices[t[1]].position - mesh.vertices[t[0]].position;
    const Eigen::Vector3f b = mesh.vertices[t[2]].position - mesh.vertices[t[0]].position;
    const double twice = static_cast<double>(a.x() * b.y() - a.y() * b.x());
    EXPECT_GT(twice, 0.0);
    area += 0.5 * twice;
  }
  EXPECT_EQ(area, 10.0);
  EXPECT_EQ(mesh.triangles.size(), 3U);
}

TEST_F(LoadMeshTest, ObjNormalsAndTextureCoordinates) {
  const Mesh mesh =
      LoadMesh(Write("uv.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 3 4\nf 1/1/1 2/2/1 3/3/1\n"));
  ASSERT_EQ(mesh.vertices.size(), 3U);
  EXPECT_EQ(mesh.vertices[1].uv, Eigen::Vector2f(1.0F, 0.0F));
  EXPECT_LT((mesh.vertices[2].normal - Eigen::Vector3f(0.0F, 0.6F, 0.8F)).norm(), 1e-6F);
}

TEST_F(LoadMeshTest, TooManyTriangles) {
  const auto file = Write("many.obj", kTetrahedron);
  EXPECT_EQ(ErrorOf(file, 3), file.generic_string() + ": has more than the 3 triangles allowed; use a coarser mesh");
  EXPECT_EQ(ErrorOf(file, 4), "no error");
}

/// The tetrahedron with one thing of its JSON changed.
std::string Changed(const std::string& from, const std::string& to) {
  std::string text = kGltf;
  const std::size_t at = text.find(from);
  return at == std::string::npos ? "not there: " + from : text.replace(at, from.size(), to);
}

TEST_F(LoadMeshTest, MissingBuffer) {
  Write("mesh.gltf", kGltf);
  const auto buffer = std::filesystem::canonical(folder_) / "mesh.bin";
  EXPECT_EQ(ErrorOf(folder_ / "mesh.gltf"), buffer.generic_string() + ": there is no such buffer file");
}

TEST_F(LoadMeshTest, HostileGltf) {
  Write("mesh.bin", Gltf(2.0F));
  const struct {
    const char* from;
    const char* to;
    const char* wrong;
  } cases[] = {
      {"\"mesh\":0", "\"mesh\":7", "meshes: has no element 7, which something refers to; there are 1"},
      {"{\"mesh\":0}", "{\"mesh\":0,\"children\":[0]}",
       "nodes.0: is reached twice; the nodes of a glTF scene are trees"},
      {"\"count\":4", "\"count\":4000000000", "accessors.0: reaches beyond its buffer view"},
      {"\"count\":4", "\"count\":9007199254740992", "accessors.0: reaches beyond its buffer view"},
      {"\"count\":4", "\"count\":-4", "accessors.0.count: is no whole number from 0 on"},
      {"\"count\":4", "\"count\":3", "meshes.0.primitives.0: has the index 3, but there are 3 vertices"},
      {"\"byteOffset\":48", "\"byteOffset\":49", "bufferViews.1: reaches beyond its buffer"},
      {"\"byteLength\":72", "\"byteLength\":73", "buffers.0: should have 73 bytes but has 72; the file is cut off"},
      {"\"byteLength\":72", "\"byteLength\":9000000000000", "buffers.0: makes the buffers larger than 134217728 bytes"},
      {"mesh.bin", "../mesh.bin",
       "buffers.0.uri: `../mesh.bin` is no file in the mesh's folder; buffers outside it are not read"},
      {"mesh.bin", "/etc/passwd",
       "buffers.0.uri: `/etc/passwd` is no file in the mesh's folder; buffers outside it are not read"},
      {"mesh.bin", "outside.bin",
       "buffers.0.uri: `outside.bin` is no file in the mesh's folder; buffers outside it are not read"},
      {"mesh.bin", "http://a/b",
       "buffers.0.uri: `http://a/b` is no file in the mesh's folder; buffers outside it are not read"},
      {"mesh.bin", "data:;base64,!", "buffers.0.uri: is no base64; the file is broken"},
      {"\"indices\":1", "\"indices\":0", "accessors.0: should be of type SCALAR"},
      {"{\"mesh\":0}", "{\"mesh\":0,\"scale\":[1e9,1,1]}",
       "meshes.0.primitives.0: vertex 1: the vertex lies more than 10 km from the origin; lengths are metres"},
      {"{\"mesh\":0}", "{\"mesh\":0,\"scale\":[0,0,0]}",
       "none of the mesh's 4 triangles has an area; lengths are metres"},
      {"\"version\":\"2.0\"", "\"version\":\"1.0\"", "is glTF 1.0; export glTF 2.0"},
      {"\"scene\":0", "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]",
       "extensionsRequired: names `KHR_draco_mesh_compression`, which is not read; export without compression"},
  };
  std::filesystem::create_symlink("/etc/passwd", folder_ / "outside.bin");
  for (const auto& c : cases) EXPECT_WRONG(Write("case.gltf", Changed(c.from, c.to)), std::string(": ") + c.wrong);
}

TEST_F(LoadMeshTest, DeepNestingAndLongChainsEndNormally) {
  EXPECT_WRONG(Write("deep.gltf", std::string(1'000'000, '[')), ": its JSON is nested deeper than 64 levels");
  Write("mesh.bin", Gltf(2.0F));
  std::string chain;  // of nodes, each the child of the one before
  for (int i = 1; i <= 50'000; ++i) chain += "{\"children\":[" + std::to_string(i) + "]},";
  EXPECT_EQ(LoadMesh(Write("chain.gltf", Changed("{\"mesh\":0}", chain + "{\"mesh\":0}"))).triangles.size(), 4U);
}

TEST_F(LoadMeshTest, MirroredNodesKeepTheOutsideOut) {
  Write("mesh.bin", Gltf(2.0F));
  const auto file = Write("mirror.gltf", Changed("{\"mesh\":0}", "{\"mesh\":0,\"scale\":[-1,1,1]}"));
  const auto mesh = std::make_shared<const Mesh>(LoadMesh(file));
  EXPECT_NEAR(Properties(MeshShape{mesh}).volume, 2.0 / 6.0, 1e-7);  // negative where triangles were inside out
  for (const auto& t : mesh->triangles) {                            // flat normals point out of the faces' corners
    const Eigen::Vector3f a = mesh->vertices[t[1]].position - mesh->vertices[t[0]].position;
    const Eigen::Vector3f b = mesh->vertices[t[2]].position - mesh->vertices[t[0]].position;
    EXPECT_GT(mesh->vertices[t[0]].normal.dot(a.cross(b)), 0.0F);
  }
}

TEST_F(LoadMeshTest, GlbIsCutOff) {
  std::ifstream stream("tests/fuzz/corpus/mesh/chunk.glb", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(LoadMesh(Write("whole.glb", whole)).triangles.size(), 4U);
  for (std::size_t size = 1; size < whole.size(); ++size) {
    EXPECT_NE(ErrorOf(Write("cut.glb", whole.substr(0, size))), "no error") << size;
  }
}

}  // namespace
}  // namespace alula::geometry

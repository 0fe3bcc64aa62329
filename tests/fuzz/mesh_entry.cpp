#include "tests/fuzz/mesh_entry.h"

#include <cmath>
#include <string_view>

#include "base/error.h"
#include "geometry/internal/parse_mesh.h"
#include "geometry/internal/raw_mesh.h"
#include "tests/fuzz/expect.h"

namespace alula::fuzz {

namespace {

constexpr std::size_t kMaxTriangles = 1000;

/// The name lies in the folder of the corpus, so that buffers beside it are found.
const char* NameFor(std::string_view bytes) {
  if (bytes.starts_with("glTF")) return "tests/fuzz/corpus/mesh/input.glb";
  return bytes.starts_with("{") ? "tests/fuzz/corpus/mesh/input.gltf" : "tests/fuzz/corpus/mesh/input.obj";
}

void ExpectSound(const geometry::Mesh& mesh) {
  Expect(!mesh.triangles.empty() && mesh.triangles.size() <= kMaxTriangles, "number of triangles");
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t i : triangle) Expect(i < mesh.vertices.size(), "index out of range");
  }
  for (const geometry::Mesh::Vertex& v : mesh.vertices) {
    Expect(v.position.cwiseAbs().maxCoeff() <= geometry::internal::kFarthest, "position");
    Expect(std::abs(v.normal.norm() - 1.0F) < 1e-5F, "normal");  // ten times what rounding leaves
    Expect(v.uv.allFinite(), "texture coordinate");
  }
}

}  // namespace

void ReadMesh(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    ExpectSound(geometry::internal::ParseMesh(bytes, NameFor(bytes), kMaxTriangles));
  } catch (const base::InputError& error) {
    ExpectOneLine(error.what());
  }
}

}  // namespace alula::fuzz

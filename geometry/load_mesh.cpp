#include "geometry/internal/file_bytes.h"
#include "geometry/internal/gltf_reader.h"
#include "geometry/internal/obj_reader.h"
#include "geometry/internal/parse_mesh.h"
#include "geometry/internal/raw_mesh.h"
#include "geometry/mesh.h"

namespace alula::geometry {
namespace {

constexpr std::size_t kMostBytes = 64UL << 20U;  // of a mesh file; 200 000 triangles as OBJ text take about 20 MB

void CheckFormat(const std::filesystem::path& file) {
  const std::string extension = internal::LowerExtension(file);
  if (extension == ".gltf" || extension == ".glb" || extension == ".obj") return;
  internal::FailIn(file, "unknown mesh format '" + internal::Shown(extension) + "'; use .gltf, .glb or .obj");
}

}  // namespace

Mesh internal::ParseMesh(std::string_view bytes, const std::filesystem::path& file, std::size_t max_triangles) {
  CheckFormat(file);
  const std::string extension = LowerExtension(file);
  if (extension == ".obj") return Finish(ReadObj(bytes, file, max_triangles), file);
  return Finish(ReadGltf(bytes, extension == ".glb", file, max_triangles), file);
}

Mesh LoadMesh(const std::filesystem::path& file, std::size_t max_triangles) {
  CheckFormat(file);
  return internal::ParseMesh(internal::ReadWhole(file, "mesh", kMostBytes), file, max_triangles);
}

}  // namespace alula::geometry

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <string>

#include "base/error.h"
#include "geometry/mesh.h"

namespace alula::geometry {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

[[noreturn]] void Fail(const std::filesystem::path& file, const std::string& what) {
  throw base::InputError(file.generic_string() + ": " + what);
}

std::string OneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::string Extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Coordinates in metres on the plane that the normal is most square to, for meshes without any.
Vector2f Projected(const Vector3f& p, const Vector3f& n) {
  const Vector3f a = n.cwiseAbs();
  if (a.z() >= a.x() && a.z() >= a.y()) return {p.x(), p.y()};
  return a.x() >= a.y() ? Vector2f(p.y(), p.z()) : Vector2f(p.x(), p.z());
}

void CheckFinite(const aiScene& scene, const std::filesystem::path& file) {
  const auto finite = [](const aiVector3D& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      if (!finite(part.mVertices[i])) Fail(file, "vertex " + std::to_string(i) + " is not finite");
      if (part.HasTextureCoords(0) && !finite(part.mTextureCoords[0][i])) {
        Fail(file, "texture coordinate " + std::to_string(i) + " is not finite");
      }
    }
  }
}

/// Appends one part. glTF stands y-up, our world z-up: (x, y, z) → (x, −z, y).
void Append(Mesh& mesh, const aiMesh& part, bool y_up) {
  const auto turned = [y_up](const aiVector3D& v) { return y_up ? Vector3f(v.x, -v.z, v.y) : Vector3f(v.x, v.y, v.z); };
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    Mesh::Vertex vertex;
    vertex.position = turned(part.mVertices[i]);
    vertex.normal = part.HasNormals() ? turned(part.mNormals[i]) : Vector3f(Vector3f::UnitZ());
    if (!vertex.normal.allFinite() || vertex.normal.norm() < 1e-6F) vertex.normal = Vector3f::UnitZ();
    vertex.normal.normalize();
    vertex.uv = part.HasTextureCoords(0) ? Vector2f(part.mTextureCoords[0][i].x, part.mTextureCoords[0][i].y)
                                         : Projected(vertex.position, vertex.normal);
    mesh.vertices.push_back(vertex);
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines bound nothing
    mesh.triangles.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
  }
}

}  // namespace

Mesh LoadMesh(const std::filesystem::path& file, std::size_t max_triangles) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) Fail(file, "there is no such mesh file");
  const std::string extension = Extension(file);
  if (extension != ".gltf" && extension != ".glb" && extension != ".obj") {
    Fail(file, "unknown mesh format '" + extension + "'; use .gltf, .glb or .obj");
  }
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_SortByPType);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    Fail(file, "cannot be read as a mesh: " + OneLine(importer.GetErrorString()));
  }
  CheckFinite(*scene, file);  // before vertices are joined: comparing NaN drops triangles silently
  scene = importer.ApplyPostProcessing(aiProcess_GenSmoothNormals | aiProcess_JoinIdenticalVertices);
  if (scene == nullptr) Fail(file, "cannot be read as a mesh: " + OneLine(importer.GetErrorString()));
  std::size_t triangles = 0;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) triangles += scene->mMeshes[i]->mNumFaces;
  if (triangles > max_triangles) {
    Fail(file,
         std::to_string(triangles) + " triangles are more than the " + std::to_string(max_triangles) + " allowed");
  }
  Mesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) Append(mesh, *scene->mMeshes[i], extension != ".obj");
  if (mesh.triangles.empty()) Fail(file, "the mesh has no triangles");
  return mesh;
}

}  // namespace alula::geometry

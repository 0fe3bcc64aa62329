#include "geometry/internal/raw_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "geometry/internal/file_bytes.h"

namespace alula::geometry::internal {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Triangle = std::array<std::uint32_t, 3>;

constexpr double kLeastArea = 1e-12;   // m²; below, a triangle's normal is noise and Bullet gets it as NaN
constexpr float kLeastNormal = 1e-6F;  // length of a normal that still points somewhere

/// Twice the area, along the normal; in double, as sides of 1e-4 m have products that floats cannot tell from zero.
Vector3d DoubleArea(const RawMesh& raw, const Triangle& t) {
  const Vector3d a = raw.vertices[t[0]].position.cast<double>();
  const Vector3d b = raw.vertices[t[1]].position.cast<double>();
  const Vector3d c = raw.vertices[t[2]].position.cast<double>();
  return (b - a).cross(c - a);
}

/// Coordinates in metres on the plane that the normal is most square to, for meshes without any.
Vector2f Projected(const Vector3f& p, const Vector3f& n) {
  const Vector3f a = n.cwiseAbs();
  if (a.z() >= a.x() && a.z() >= a.y()) return {p.x(), p.y()};
  return a.x() >= a.y() ? Vector2f(p.y(), p.z()) : Vector2f(p.x(), p.z());
}

/// For each vertex the number of its place: vertices at equal positions (seams of the texture) have the same.
std::vector<std::uint32_t> Places(const RawMesh& raw) {
  const auto before = [&raw](std::uint32_t i, std::uint32_t k) {
    const Vector3f& a = raw.vertices[i].position;
    const Vector3f& b = raw.vertices[k].position;
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::vector<std::uint32_t> order(raw.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), before);
  std::vector<std::uint32_t> places(order.size());
  for (std::size_t i = 1; i < order.size(); ++i) {
    places[order[i]] = places[order[i - 1]] + (before(order[i - 1], order[i]) ? 1U : 0U);
  }
  return places;
}

/// Unit normals of all vertices from the faces about them.
std::vector<Vector3f> NormalsOfFaces(const RawMesh& raw, const std::vector<Triangle>& triangles) {
  const std::vector<std::uint32_t> places = Places(raw);
  std::vector<Vector3d> sums(raw.vertices.size(), Vector3d::Zero());
  std::vector<Vector3f> normals(raw.vertices.size(), Vector3f::UnitZ());
  for (const Triangle& t : triangles) {
    const Vector3d normal = DoubleArea(raw, t).normalized();
    for (const std::uint32_t corner : t) {
      sums[places[corner]] += normal;
      normals[corner] = normal.cast<float>();
    }
  }
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vector3d& sum = sums[places[i]];
    if (sum.norm() > kLeastNormal) normals[i] = sum.normalized().cast<float>();  // else the two sides of a sheet
  }
  return normals;
}

}  // namespace

float ToFloat(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return std::abs(value) > kLargest ? std::numeric_limits<float>::infinity() : static_cast<float>(value);
}

std::string WhatIsWrong(const RawMesh::Vertex& vertex) {
  if (!vertex.position.allFinite()) return "the vertex is not finite";
  if (vertex.position.cwiseAbs().maxCoeff() > kFarthest) {
    return "the vertex lies more than 10 km from the origin; lengths are metres";
  }
  if (vertex.normal && !vertex.normal->allFinite()) return "the normal is not finite";
  if (!vertex.uv) return {};
  if (!vertex.uv->allFinite()) return "the texture coordinate is not finite";
  if (vertex.uv->cwiseAbs().maxCoeff() > kFarthestUv) return "the texture coordinate lies beyond 10000";
  return {};
}

void CheckTriangles(std::size_t triangles, std::size_t max_triangles, const std::filesystem::path& file) {
  if (triangles <= max_triangles) return;
  FailIn(file, "has more than the " + std::to_string(max_triangles) + " triangles allowed; use a coarser mesh");
}

Mesh Finish(const RawMesh& raw, const std::filesystem::path& file) {
  if (raw.triangles.empty()) FailIn(file, "the mesh has no triangles");
  Mesh mesh;
  mesh.triangles = raw.triangles;
  std::erase_if(mesh.triangles, [&raw](const Triangle& t) { return !(DoubleArea(raw, t).norm() > 2.0 * kLeastArea); });
  if (mesh.triangles.empty()) {
    FailIn(file,
           "none of the mesh's " + std::to_string(raw.triangles.size()) + " triangles has an area; lengths are metres");
  }
  const std::vector<Vector3f> of_faces = NormalsOfFaces(raw, mesh.triangles);
  mesh.vertices.reserve(raw.vertices.size());
  for (std::size_t i = 0; i < raw.vertices.size(); ++i) {
    const RawMesh::Vertex& from = raw.vertices[i];
    const bool given = from.normal && from.normal->stableNorm() > kLeastNormal;
    const Vector3f normal = given ? from.normal->stableNormalized() : of_faces[i];
    mesh.vertices.push_back({from.position, normal, from.uv ? *from.uv : Projected(from.position, normal)});
  }
  return mesh;
}

}  // namespace alula::geometry::internal

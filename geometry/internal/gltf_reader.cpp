#include "geometry/internal/gltf_reader.h"

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/internal/file_bytes.h"
#include "geometry/internal/gltf_accessor.h"
#include "geometry/internal/gltf_file.h"

namespace alula::geometry::internal {
namespace {

using Eigen::Vector3d;
using Affine = Eigen::Affine3d;

/// glTF stands y up, our world z up: (x, y, z) → (x, −z, y).
Affine TurnedUp() {
  Affine X = Affine::Identity();
  X.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return X;
}

template <int N>
Eigen::Matrix<double, N, 1> ReadNumbers(const JsonAt& list) {
  if (list.Size() != N) list.Fail("should have " + std::to_string(N) + " numbers");
  Eigen::Matrix<double, N, 1> numbers;
  for (int i = 0; i < N; ++i) numbers[i] = list.Element(static_cast<std::uint64_t>(i)).Number();
  return numbers;
}

/// Section 3.5.2: a matrix, column by column, or translation · rotation · scale.
Affine LocalTransform(const JsonAt& node) {
  Affine X = Affine::Identity();
  if (const auto matrix = node.Find("matrix")) {
    const auto m = ReadNumbers<16>(*matrix);
    X.matrix() = Eigen::Map<const Eigen::Matrix4d>(m.data());
    if (X.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1)) matrix->Fail("is not affine");
    return X;
  }
  if (const auto list = node.Find("translation")) X.translation() = ReadNumbers<3>(*list);
  if (const auto list = node.Find("rotation")) {
    const Eigen::Vector4d q = ReadNumbers<4>(*list);  // x, y, z, w
    if (!(std::abs(q.norm() - 1.0) < 0.1)) list->Fail("is no unit quaternion");
    X.linear() = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized().toRotationMatrix();
  }
  if (const auto list = node.Find("scale")) X.linear() = X.linear() * ReadNumbers<3>(*list).asDiagonal();
  return X;
}

/// Reads the primitives of one mesh at one place.
class PrimitiveReader {
 public:
  PrimitiveReader(GltfFile& file, const JsonAt& primitive, const Affine& X, RawMesh& raw)
      : primitive_(primitive),
        X_(X),
        raw_(raw),
        position_(file, primitive.Need("attributes").Need("POSITION").Natural(), 3) {
    const JsonAt attributes = primitive.Need("attributes");
    if (const auto at = attributes.Find("NORMAL")) normal_ = OfEachVertex(file, *at, 3);
    if (const auto at = attributes.Find("TEXCOORD_0")) uv_ = OfEachVertex(file, *at, 2);
    if (const auto at = primitive.Find("indices")) {
      indices_.emplace(file, at->Natural(), 1);
      if (!indices_->IsIndex()) at->Fail("should name whole numbers from 0 on");
    }
    // Normals turn with the matrix of cofactors; a mirror turns triangles inside out.
    const Eigen::Matrix3d& A = X.linear();
    normals_turn_ << A.col(1).cross(A.col(2)), A.col(2).cross(A.col(0)), A.col(0).cross(A.col(1));
    mirrored_ = A.determinant() < 0.0;
    if (mirrored_) normals_turn_ = -normals_turn_;
  }

  void Read(std::size_t max_triangles, const std::filesystem::path& file) {
    const std::uint64_t mode = primitive_.NaturalOr("mode", kTriangles);
    if (mode > kFan) primitive_.Fail("has no mode of glTF 2.0");
    if (mode < kTriangles) return;  // points and lines bound nothing
    const std::uint64_t corners = indices_ ? indices_->count() : position_.count();
    if (corners < 3) return;
    const std::uint64_t triangles = mode == kTriangles ? corners / 3 : corners - 2;
    // Of two large numbers the difference, as their sum might overflow.
    if (triangles > max_triangles - raw_.triangles.size()) CheckTriangles(max_triangles + 1, max_triangles, file);
    for (std::uint64_t i = 0; i < triangles; ++i) {
      if (mode == kTriangles) {
        AddTriangle(3 * i, 3 * i + 1, 3 * i + 2);
      } else if (mode == kStrip) {
        AddTriangle(i, i + 1 + i % 2, i + 2 - i % 2);
      } else {
        AddTriangle(i + 1, i + 2, 0);
      }
    }
  }

 private:
  static constexpr std::uint64_t kTriangles = 4;
  static constexpr std::uint64_t kStrip = 5;
  static constexpr std::uint64_t kFan = 6;

  GltfAccessor OfEachVertex(GltfFile& file, const JsonAt& at, int components) const {
    GltfAccessor accessor(file, at.Natural(), components);
    if (accessor.count() != position_.count()) at.Fail("has not as many elements as POSITION");
    return accessor;
  }

  std::uint64_t IndexAt(std::uint64_t corner) const {
    const std::uint64_t index = indices_ ? indices_->Index(corner) : corner;
    if (index >= position_.count()) {
      primitive_.Fail("has the index " + std::to_string(index) + ", but there are " +
                      std::to_string(position_.count()) + " vertices");
    }
    return index;
  }

  RawMesh::Vertex ReadVertex(std::uint64_t index) const {
    RawMesh::Vertex vertex;
    const auto vector = [index](const GltfAccessor& from) {
      return Vector3d(from.At(index, 0), from.At(index, 1), from.At(index, 2));
    };
    vertex.position = (X_ * vector(position_)).unaryExpr(&ToFloat);
    // A scale of millimetres makes the cofactors small; only the direction counts.
    if (normal_) vertex.normal = (normals_turn_ * vector(*normal_)).stableNormalized().unaryExpr(&ToFloat);
    // glTF counts v from the top of a picture, we from its foot.
    if (uv_) vertex.uv = {ToFloat(uv_->At(index, 0)), ToFloat(1.0 - uv_->At(index, 1))};
    const std::string wrong = WhatIsWrong(vertex);
    if (!wrong.empty()) primitive_.Fail("vertex " + std::to_string(index) + ": " + wrong);
    return vertex;
  }

  std::uint32_t Append(const RawMesh::Vertex& vertex) {
    raw_.vertices.push_back(vertex);
    return static_cast<std::uint32_t>(raw_.vertices.size() - 1);
  }

  /// Only what triangles use is taken: a short text can name one long buffer a thousand times.
  std::uint32_t Shared(std::uint64_t index) {
    const auto known = vertices_.find(index);
    if (known != vertices_.end()) return known->second;
    return vertices_.emplace(index, Append(ReadVertex(index))).first->second;
  }

  void AddTriangle(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    std::array<std::uint64_t, 3> corners{IndexAt(a), IndexAt(b), IndexAt(c)};
    if (mirrored_) std::swap(corners[1], corners[2]);
    if (normal_) {
      raw_.triangles.push_back({Shared(corners[0]), Shared(corners[1]), Shared(corners[2])});
      return;
    }
    std::array<RawMesh::Vertex, 3> flat{ReadVertex(corners[0]), ReadVertex(corners[1]), ReadVertex(corners[2])};
    const Vector3d side = (flat[1].position - flat[0].position).cast<double>();
    const Vector3d normal = side.cross((flat[2].position - flat[0].position).cast<double>()).stableNormalized();
    for (RawMesh::Vertex& vertex : flat) vertex.normal = normal.cast<float>();
    raw_.triangles.push_back({Append(flat[0]), Append(flat[1]), Append(flat[2])});
  }

  const JsonAt& primitive_;
  const Affine& X_;
  RawMesh& raw_;
  GltfAccessor position_;
  std::optional<GltfAccessor> normal_;
  std::optional<GltfAccessor> uv_;
  std::optional<GltfAccessor> indices_;
  Eigen::Matrix3d normals_turn_;
  bool mirrored_ = false;
  std::map<std::uint64_t, std::uint32_t> vertices_;  // of this primitive, by index
};

void CheckAsset(const JsonAt& root) {
  const std::string& version = root.Need("asset").Need("version").Text();
  if (!version.starts_with("2.")) root.Fail("is glTF " + Shown(version) + "; export glTF 2.0");
  const auto required = root.Find("extensionsRequired");
  for (std::size_t i = 0; required && i < required->Size(); ++i) {
    const std::string& name = required->Element(i).Text();
    if (name == "KHR_mesh_quantization" || name == "KHR_texture_transform" || name.starts_with("KHR_materials_")) {
      continue;
    }
    required->Fail("names `" + Shown(name) + "`, which is not read; export without compression");
  }
}

struct Placed {
  std::uint64_t node;
  Affine X;
};

/// The nodes of the scene that the file shows, with their transforms, in the order of the file. A node that is reached
/// twice would be a second parent or a circle; section 3.5.2 forbids both.
std::vector<Placed> SceneNodes(const JsonAt& root) {
  const JsonAt nodes = root.Need("nodes");
  const JsonAt roots = root.Need("scenes").Element(root.NaturalOr("scene", 0)).Need("nodes");
  std::vector<bool> seen(nodes.Size(), false);
  std::vector<Placed> found;
  std::vector<Placed> open;
  const auto push = [&open](const JsonAt& list, const Affine& X) {
    for (std::size_t i = list.Size(); i-- > 0;) open.push_back({list.Element(i).Natural(), X});
  };
  push(roots, TurnedUp());
  while (!open.empty()) {
    const Placed at = open.back();
    open.pop_back();
    const JsonAt node = nodes.Element(at.node);
    if (seen[at.node]) node.Fail("is reached twice; the nodes of a glTF scene are trees");
    seen[at.node] = true;
    found.push_back({at.node, at.X * LocalTransform(node)});
    if (!found.back().X.matrix().allFinite()) node.Fail("has a transform that is not finite");
    if (const auto children = node.Find("children")) push(*children, found.back().X);
  }
  return found;
}

}  // namespace

RawMesh ReadGltf(std::string_view bytes, bool is_glb, const std::filesystem::path& file, std::size_t max_triangles) {
  GltfFile gltf(bytes, is_glb, file);
  const JsonAt root = gltf.root();
  CheckAsset(root);
  RawMesh raw;
  std::size_t parts = 0;
  for (const Placed& placed : SceneNodes(root)) {
    const JsonAt node = root.Need("nodes").Element(placed.node);
    const auto index = node.Find("mesh");
    if (!index) continue;
    if (node.Find("skin")) node.Fail("has a skin, which is not read; export with the pose applied");
    const JsonAt primitives = root.Need("meshes").Element(index->Natural()).Need("primitives");
    // A short text can place many parts without a single triangle very many times.
    parts += primitives.Size();
    if (parts > max_triangles) FailIn(file, "has more parts than the triangles allowed; join them");
    for (std::size_t i = 0; i < primitives.Size(); ++i) {
      const JsonAt primitive = primitives.Element(i);
      PrimitiveReader(gltf, primitive, placed.X, raw).Read(max_triangles, file);
    }
  }
  return raw;
}

}  // namespace alula::geometry::internal

#include "render/internal/detail_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

namespace alula::render::internal {
namespace {

using geometry::Mesh;

/// A polygon of `segments` for a circle of 24 segments (both with corners at angle 0): `growth` of its radius at which
/// it lies as far outside as inside, and `error`, that distance over the radius; for surfaces that are round about one
/// axis, and for balls, whose meridians are polygons too (segments / 2 to the pole). From a scan over both surfaces;
/// tests/render measures them again.
struct RoundLevel {
  int segments;
  double growth_lathe, error_lathe;
  double growth_ball, error_ball;
};
constexpr std::array<RoundLevel, 2> kRoundLevels = {
    {{12, 1.0173, 0.0174, 1.0335, 0.0336}, {8, 1.0353, 0.0354, 1.0670, 0.0672}}};

template <typename Place>
void Move(Mesh& mesh, const Place& place) {
  for (Mesh::Vertex& v : mesh.vertices) v.position = place(v);
}

/// Outwards about z; texture coordinates stay those of the surface.
void GrowAboutZ(Mesh& mesh, double growth) {
  Move(mesh, [growth](const Mesh::Vertex& v) -> Eigen::Vector3f {
    return v.position.cwiseProduct(Eigen::Vector3d(growth, growth, 1.0).cast<float>());
  });
}

/// Outwards along the normal, for surfaces that are smooth everywhere.
void GrowAlongNormal(Mesh& mesh, double metres) {
  Move(mesh, [metres](const Mesh::Vertex& v) -> Eigen::Vector3f {
    return v.position + v.normal * static_cast<float>(metres);
  });
}

struct Grow {
  const RoundLevel& level;
  Mesh& mesh;

  double Ball(double radius) const {
    GrowAlongNormal(mesh, radius * (level.growth_ball - 1.0));
    return radius * level.error_ball;
  }
  double Lathe(double radius) const {
    GrowAboutZ(mesh, level.growth_lathe);
    return radius * level.error_lathe;
  }
  std::optional<double> operator()(const geometry::Sphere& s) const { return Ball(s.radius); }
  std::optional<double> operator()(const geometry::Capsule& c) const { return Ball(c.radius); }
  std::optional<double> operator()(const geometry::Cylinder& c) const { return Lathe(c.radius); }
  std::optional<double> operator()(const geometry::Cone& c) const { return Lathe(c.radius); }
  std::optional<double> operator()(const geometry::Box&) const { return std::nullopt; }
  std::optional<double> operator()(const geometry::MeshShape&) const { return std::nullopt; }
};

void AppendRoundLevels(const geometry::Shape& shape, double texture_scale, std::vector<DetailLevel>& levels) {
  for (const RoundLevel& round : kRoundLevels) {
    DetailLevel level;
    level.mesh = geometry::Tessellate(shape, texture_scale, round.segments);
    const std::optional<double> error = std::visit(Grow{round, level.mesh}, shape);
    if (!error) return;
    level.error = *error;
    levels.push_back(std::move(level));
  }
}

/// Clusters of a mesh of many triangles: cells of 1/48 and 1/16 of its size, where that saves a third of them.
void AppendClusteredLevels(std::vector<DetailLevel>& levels) {
  constexpr std::size_t kMany = 200;
  const Mesh& full = levels.front().mesh;
  if (full.triangles.size() < kMany) return;
  Eigen::Vector3f low = full.vertices.front().position;
  Eigen::Vector3f high = low;
  for (const Mesh::Vertex& v : full.vertices) {
    low = low.cwiseMin(v.position).eval();
    high = high.cwiseMax(v.position).eval();
  }
  const double size = static_cast<double>((high - low).norm());
  for (const double share : {48.0, 16.0}) {
    DetailLevel level = Clustered(levels.front().mesh, size / share);
    const bool saves = 3 * level.mesh.triangles.size() < 2 * levels.back().mesh.triangles.size();
    if (saves && level.error > levels.back().error) levels.push_back(std::move(level));
  }
}

using Cell = std::array<int, 3>;
/// What one cluster has in common: its cell, and roughly its normal and texture coordinates.
using Kind = std::tuple<Cell, Cell, std::array<int, 2>>;

Cell CellOf(const Eigen::Vector3f& p, double size) {
  Cell cell;
  for (int i = 0; i < 3; ++i) cell[static_cast<std::size_t>(i)] = static_cast<int>(std::floor(p[i] / size));
  return cell;
}

Kind KindOf(const Mesh::Vertex& v, double cell) {
  constexpr double kTurn = 0.8;     // of a unit normal's coordinates
  constexpr double kPeriods = 0.5;  // of the texture
  return {CellOf(v.position, cell),
          CellOf(v.normal + Eigen::Vector3f::Constant(0.41F), kTurn),
          {static_cast<int>(std::floor(v.uv.x() / kPeriods)), static_cast<int>(std::floor(v.uv.y() / kPeriods))}};
}

/// For each cell the vertex nearest to the mean of the cell's vertices.
std::map<Cell, std::uint32_t> MiddleVertices(const Mesh& mesh, double cell) {
  std::map<Cell, std::pair<Eigen::Vector3d, double>> sums;
  for (const Mesh::Vertex& v : mesh.vertices) {
    auto& [sum, count] = sums.try_emplace(CellOf(v.position, cell), Eigen::Vector3d::Zero(), 0.0).first->second;
    sum += v.position.cast<double>();
    count += 1.0;
  }
  std::map<Cell, std::uint32_t> middles;
  std::map<Cell, double> nearest;
  for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
    const Cell c = CellOf(mesh.vertices[i].position, cell);
    const auto& [sum, count] = sums.at(c);
    const double distance = (mesh.vertices[i].position.cast<double>() - sum / count).norm();
    const auto found = nearest.find(c);
    if (found != nearest.end() && found->second <= distance) continue;
    nearest[c] = distance;
    middles[c] = i;
  }
  return middles;
}

/// Wires, whose normals point away from their middle.
void AppendThickenedLevels(double radius, std::vector<DetailLevel>& levels) {
  constexpr double kStep = 1.6;
  double thick = radius;
  while (levels.size() < kMostLevels) {
    thick *= kStep;
    levels.push_back({levels.front().mesh, thick - radius});
    GrowAlongNormal(levels.back().mesh, thick - radius);
  }
}

}  // namespace

DetailLevel Clustered(const Mesh& mesh, double cell) {
  const std::map<Cell, std::uint32_t> middles = MiddleVertices(mesh, cell);
  DetailLevel level;
  std::map<Kind, std::uint32_t> number_of_kind;
  std::vector<std::uint32_t> moved_to;
  for (const Mesh::Vertex& v : mesh.vertices) {
    const Eigen::Vector3f& middle = mesh.vertices[middles.at(CellOf(v.position, cell))].position;
    level.error = std::max(level.error, static_cast<double>((middle - v.position).norm()));
    const auto [kind, is_new] =
        number_of_kind.try_emplace(KindOf(v, cell), static_cast<std::uint32_t>(level.mesh.vertices.size()));
    if (is_new) level.mesh.vertices.push_back({middle, v.normal, v.uv});
    moved_to.push_back(kind->second);
  }
  std::set<std::array<std::uint32_t, 3>> seen;  // one of several that fall together
  for (const auto& triangle : mesh.triangles) {
    std::array<std::uint32_t, 3> t{};
    for (std::size_t i = 0; i < 3; ++i) t[i] = moved_to[triangle[i]];
    const auto at = [&](std::size_t i) -> const Eigen::Vector3f& { return level.mesh.vertices[t[i]].position; };
    if (at(0) == at(1) || at(1) == at(2) || at(2) == at(0)) continue;
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    if (seen.insert(t).second) level.mesh.triangles.push_back(t);
  }
  return level;
}

std::vector<DetailLevel> DetailLevels(const geometry::Shape& shape, double texture_scale, double wire) {
  std::vector<DetailLevel> levels(1);
  levels.front().mesh = geometry::Tessellate(shape, texture_scale);
  if (wire > 0.0) {
    AppendThickenedLevels(wire, levels);
  } else if (std::holds_alternative<geometry::MeshShape>(shape)) {
    AppendClusteredLevels(levels);
  } else {
    AppendRoundLevels(shape, texture_scale, levels);
  }
  return levels;
}

}  // namespace alula::render::internal

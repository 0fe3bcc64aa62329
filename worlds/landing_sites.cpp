#include "worlds/landing_sites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace alula::worlds {
namespace {

using base::Vec2;
using base::Vec3;

/// Highest surfaces, cell by cell.
class TopMap {
 public:
  TopMap(const World& world, const LandingConfig& config, LandingSites& sites)
      : ceiling_(world.bounds_high.z()), sites_(sites) {
    const Vec2 size = (world.bounds_high - world.bounds_low).head<2>();
    if (size.minCoeff() < 2.0 * config.cell) throw base::InputError("landing: the world has no bounds to look within");
    sites.low = world.bounds_low.head<2>();
    sites.cell = config.cell;
    sites.columns = static_cast<int>(std::floor(size.x() / config.cell));
    sites.rows = static_cast<int>(std::floor(size.y() / config.cell));
    const std::size_t cells = static_cast<std::size_t>(sites.columns) * static_cast<std::size_t>(sites.rows);
    sites.top.assign(cells, -std::numeric_limits<float>::infinity());
    stands_.assign(cells, 0);
    for (const Object& object : world.objects) Add(object);
  }

  bool Stands(std::size_t cell) const { return stands_[cell] != 0; }

 private:
  void Add(const Object& object) {
    const geometry::Mesh mesh = geometry::Tessellate(object.shape);
    std::vector<Vec3> corners;
    corners.reserve(mesh.vertices.size());
    for (const auto& vertex : mesh.vertices) corners.push_back(object.X_WO * Vec3(vertex.position.cast<double>()));
    for (const auto& t : mesh.triangles) AddTriangle(corners[t[0]], corners[t[1]], corners[t[2]], object.collides);
  }

  void AddTriangle(const Vec3& a, const Vec3& b, const Vec3& c, bool collides) {
    const Vec2 low = a.head<2>().cwiseMin(b.head<2>()).cwiseMin(c.head<2>());
    const Vec2 high = a.head<2>().cwiseMax(b.head<2>()).cwiseMax(c.head<2>());
    const Vec2 first = (low - sites_.low) / sites_.cell;
    const Vec2 last = (high - sites_.low) / sites_.cell;
    if (last.minCoeff() < 0.0 || first.x() >= sites_.columns || first.y() >= sites_.rows) return;
    // Where the face can be stood on, a point of an edge says how high the face is in the cell's middle.
    const Vec3 normal = (b - a).cross(c - a);
    const bool gentle = std::abs(normal.z()) > 0.9 * normal.norm();
    const Vec2 slope = gentle ? Vec2(-normal.head<2>() / normal.z()) : Vec2(Vec2::Zero());
    AddEdge(a, b, slope, collides);
    AddEdge(b, c, slope, collides);
    AddEdge(c, a, slope, collides);
    const Vec2 ab = (b - a).head<2>();
    const Vec2 ac = (c - a).head<2>();
    const double area = ab.x() * ac.y() - ab.y() * ac.x();
    if (std::abs(area) < 1e-12) return;  // upright: its edges say all
    const int i1 = std::min(sites_.columns - 1, static_cast<int>(last.x()));
    const int j1 = std::min(sites_.rows - 1, static_cast<int>(last.y()));
    for (int j = std::max(0, static_cast<int>(first.y())); j <= j1; ++j) {
      for (int i = std::max(0, static_cast<int>(first.x())); i <= i1; ++i) {
        const Vec2 d = sites_.Middle(i, j) - a.head<2>();
        const double v = (d.x() * ac.y() - d.y() * ac.x()) / area;
        const double w = (ab.x() * d.y() - ab.y() * d.x()) / area;
        if (v < 0.0 || w < 0.0 || v + w > 1.0) continue;
        Raise(sites_.Index(i, j), a.z() + v * (b - a).z() + w * (c - a).z(), collides);
      }
    }
  }

  void AddEdge(const Vec3& a, const Vec3& b, const Vec2& slope, bool collides) {
    const int steps = 1 + static_cast<int>((b - a).head<2>().norm() / (0.5 * sites_.cell));
    for (int n = 0; n <= steps; ++n) {
      const Vec3 p = a + (b - a) * (static_cast<double>(n) / steps);
      const Vec2 at = (p.head<2>() - sites_.low) / sites_.cell;
      if (at.minCoeff() < 0.0 || at.x() >= sites_.columns || at.y() >= sites_.rows) continue;
      const int i = static_cast<int>(at.x());
      const int j = static_cast<int>(at.y());
      Raise(sites_.Index(i, j), p.z() + slope.dot(sites_.Middle(i, j) - p.head<2>()), collides);
    }
  }

  void Raise(std::size_t cell, double z, bool collides) {
    if (z > ceiling_ || static_cast<float>(z) <= sites_.top[cell]) return;
    sites_.top[cell] = static_cast<float>(z);
    stands_[cell] = collides ? 1 : 0;
  }

  double ceiling_;
  LandingSites& sites_;
  std::vector<std::uint8_t> stands_;
};

/// The cells whose middles lie within a radius of a cell's middle.
std::vector<std::array<int, 2>> Disc(double radius, double cell) {
  std::vector<std::array<int, 2>> cells;
  const int reach = static_cast<int>(std::ceil(radius / cell));
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      if (std::hypot(i, j) * cell <= radius + 1e-9) cells.push_back({i, j});
    }
  }
  return cells;
}

/// The disc is symmetric, so that the plane's normal equations are diagonal: c is the mean, the slopes are moments.
class PlaneFit {
 public:
  PlaneFit(const LandingConfig& config, const LandingSites& sites, const TopMap& tops)
      : config_(config), sites_(sites), tops_(tops), disc_(Disc(config.footprint, config.cell)) {
    for (const auto& [i, j] : disc_) squares_ += i * i;
    squares_ *= config.cell * config.cell;
  }

  bool IsGood(int i, int j) const {
    double sum = 0.0;
    Vec2 moment = Vec2::Zero();
    for (const auto& [di, dj] : disc_) {
      if (!Holds(i + di, j + dj)) return false;
      const double z = Top(i + di, j + dj);
      sum += z;
      moment += config_.cell * z * Vec2(di, dj);
    }
    const Vec2 slope = moment / squares_;
    if (slope.norm() > std::tan(config_.slope_max)) return false;
    const double mean = sum / static_cast<double>(disc_.size());
    return std::all_of(disc_.begin(), disc_.end(), [&](const auto& d) {
      const double plane = mean + config_.cell * slope.dot(Vec2(d[0], d[1]));
      return std::abs(Top(i + d[0], j + d[1]) - plane) <= config_.roughness_max;
    });
  }

 private:
  bool Holds(int i, int j) const {
    if (i < 0 || j < 0 || i >= sites_.columns || j >= sites_.rows) return false;
    const std::size_t cell = sites_.Index(i, j);
    return std::isfinite(sites_.top[cell]) && tops_.Stands(cell);
  }
  double Top(int i, int j) const { return static_cast<double>(sites_.top[sites_.Index(i, j)]); }

  const LandingConfig& config_;
  const LandingSites& sites_;
  const TopMap& tops_;
  std::vector<std::array<int, 2>> disc_;
  double squares_ = 0.0;  // sum of x² over the disc, m²
};

/// What is good everywhere within a radius; what lies beyond the grid is not.
std::vector<std::uint8_t> Eroded(const LandingSites& sites, double radius) {
  std::vector<std::uint8_t> safe = sites.good;
  const auto disc = Disc(radius, sites.cell);
  for (int j = 0; j < sites.rows; ++j) {
    for (int i = 0; i < sites.columns; ++i) {
      if (sites.good[sites.Index(i, j)] != 0) continue;
      for (const auto& [di, dj] : disc) {
        if (i + di < 0 || j + dj < 0 || i + di >= sites.columns || j + dj >= sites.rows) continue;
        safe[sites.Index(i + di, j + dj)] = 0;
      }
    }
  }
  const int rim = static_cast<int>(std::ceil(radius / sites.cell));
  for (int j = 0; j < sites.rows; ++j) {
    for (int i = 0; i < sites.columns; ++i) {
      const int to_rim = std::min({i, j, sites.columns - 1 - i, sites.rows - 1 - j});
      if (to_rim < rim) safe[sites.Index(i, j)] = 0;
    }
  }
  return safe;
}

}  // namespace

double LandingSites::SafeShare() const {
  const auto count = std::count(safe.begin(), safe.end(), std::uint8_t{1});
  return safe.empty() ? 0.0 : static_cast<double>(count) / static_cast<double>(safe.size());
}

LandingSites FindLandingSites(const World& world, const LandingConfig& config) {
  LandingSites sites;
  const TopMap tops(world, config, sites);
  const PlaneFit fit(config, sites, tops);
  sites.good.assign(sites.top.size(), 0);
  for (int j = 0; j < sites.rows; ++j) {
    for (int i = 0; i < sites.columns; ++i) sites.good[sites.Index(i, j)] = fit.IsGood(i, j) ? 1 : 0;
  }
  sites.safe = Eroded(sites, config.radius + config.margin);
  return sites;
}

}  // namespace alula::worlds

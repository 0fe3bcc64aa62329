#include "worlds/kit/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace alula::worlds {
namespace {

using base::Vec3;

/// Where along one axis a box is cut: bounds of cell i, and texture coordinates 0 in its middle, ±½ at its sides.
struct Cuts {
  int count = 1;
  double length = 1.0;
  double At(int i) const { return length * (static_cast<double>(i) / count - 0.5); }
};

Cuts CutsOf(double length, double period) {
  return {std::max(1, static_cast<int>(std::lround(length / period))), length};
}

/// Collects the faces of a cell that lie on the box's outside. `low`, `high`: the cell's corners in the box's axes.
class CellMesh {
 public:
  CellMesh(const Vec3& low, const Vec3& high, double period)
      : low_(low), high_(high), period_(period), mesh_(std::make_shared<geometry::Mesh>()) {}

  /// The face that looks along `axis` (0 to 2) to `side` (±1).
  void AddFace(int axis, double side) {
    Vec3 n = Vec3::Zero();
    n[axis] = side;
    const Vec3 up = axis == 2 ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitZ());
    const Vec3 right = up.cross(n);
    const Vec3 middle = 0.5 * (low_ + high_);
    const Vec3 half = 0.5 * (high_ - low_);
    const auto first = static_cast<std::uint32_t>(mesh_->vertices.size());
    constexpr std::array<std::array<double, 2>, 4> kCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    for (const auto& [x, y] : kCorners) {
      const Vec3 p = middle + (n + x * right + y * up).cwiseProduct(half);
      const double u = x * Share(half.cwiseProduct(right).norm());
      const double v = y * Share(half.cwiseProduct(up).norm());
      mesh_->vertices.push_back(
          {p.cast<float>(), n.cast<float>(), Eigen::Vector2f(static_cast<float>(u), static_cast<float>(v))});
    }
    mesh_->triangles.push_back({first, first + 1, first + 2});
    mesh_->triangles.push_back({first, first + 2, first + 3});
  }

  std::shared_ptr<const geometry::Mesh> Take() { return std::move(mesh_); }

 private:
  /// Texture coordinate at half a side: a cell about as large as the period is stretched to it, so that its rims meet.
  double Share(double half) const {
    const double share = half / period_;
    return share > 0.33 ? 0.5 : share;
  }

  Vec3 low_, high_;
  double period_;
  std::shared_ptr<geometry::Mesh> mesh_;
};

}  // namespace

Surface AddSurface(World& world, const std::string& name, const SurfaceConfig& config, std::uint64_t seed) {
  Surface surface;
  surface.period = config.period;
  const auto textures =
      MakeTextureVariants(config.pattern, config.palette, config.size, seed, name, config.variants, config.contrast);
  for (std::size_t i = 0; i < textures.size(); ++i) {
    surface.variants.push_back(static_cast<int>(world.materials.size()));
    world.materials.push_back({name + "/" + std::to_string(i), Eigen::Vector3f::Ones(), textures[i], config.infrared});
  }
  return surface;
}

int AddMaterial(World& world, const std::string& name, const SurfaceConfig& config, std::uint64_t seed) {
  world.materials.push_back({name, Eigen::Vector3f::Ones(),
                             MakeTexture(config.pattern, config.palette, config.size, seed, name, config.contrast),
                             config.infrared});
  return static_cast<int>(world.materials.size()) - 1;
}

int AddPlainMaterial(World& world, const std::string& name, const Eigen::Vector3f& colour) {
  world.materials.push_back({name, colour, nullptr});
  return static_cast<int>(world.materials.size()) - 1;
}

void AddTiledBox(World& world, const std::string& name, const Vec3& size, const base::Transform& X_WO,
                 const Surface& surface, SemanticClass semantic, base::RandomStream& random) {
  int thin = 0;
  size.minCoeff(&thin);
  const std::array<Cuts, 3> cuts{thin == 0 ? Cuts{1, size.x()} : CutsOf(size.x(), surface.period),
                                 thin == 1 ? Cuts{1, size.y()} : CutsOf(size.y(), surface.period),
                                 thin == 2 ? Cuts{1, size.z()} : CutsOf(size.z(), surface.period)};
  int number = 0;
  for (int k = 0; k < cuts[2].count; ++k) {
    for (int j = 0; j < cuts[1].count; ++j) {
      for (int i = 0; i < cuts[0].count; ++i) {
        const Vec3 low(cuts[0].At(i), cuts[1].At(j), cuts[2].At(k));
        const Vec3 high(cuts[0].At(i + 1), cuts[1].At(j + 1), cuts[2].At(k + 1));
        CellMesh cell(low, high, surface.period);
        const std::array<int, 3> at{i, j, k};
        for (int axis = 0; axis < 3; ++axis) {
          const auto a = static_cast<std::size_t>(axis);
          if (at[a] == 0) cell.AddFace(axis, -1.0);
          if (at[a] + 1 == cuts[a].count) cell.AddFace(axis, 1.0);
        }
        const int material = surface.variants[random.Index(surface.variants.size())];
        world.objects.push_back({name + "/" + std::to_string(number++), geometry::MeshShape{cell.Take()}, X_WO,
                                 material, 1.0, true, semantic});
      }
    }
  }
}

}  // namespace alula::worlds

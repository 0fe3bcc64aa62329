#include "worlds/scene.h"

#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "base/error.h"
#include "geometry/load_texture.h"
#include "worlds/actors/machines.h"
#include "worlds/furniture.h"
#include "worlds/textures.h"

namespace alula::worlds {
namespace {

using base::Vec3;
using geometry::Shape;

template <typename... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <typename... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

/// What a file holds. What is wrong with it is said with the place of the key that names it.
template <typename Load>
auto LoadNamed(const base::Origin& origin, const Load& load) {
  try {
    return load();
  } catch (const base::InputError& error) {
    throw base::InputError(origin.where, origin.path, error.what());
  }
}

/// What makes two pictures the same: the file, or else the pattern.
using Picture = std::pair<SceneMaterial::Coat, std::string>;
Picture PictureOf(const SceneMaterial& material) {
  return {material.texture.empty() ? material.pattern : SceneMaterial::Coat::kPlain, material.texture};
}

/// Builds one world; remembers files and materials that were met before.
class SceneBuilder {
 public:
  SceneBuilder(const SceneConfig& config, std::uint64_t seed) : config_(config), seed_(seed) { world_.name = "scene"; }

  World Build() {
    AddGround();
    for (std::size_t i = 0; i < config_.objects.size(); ++i) AddThing(config_.objects[i], i);
    for (std::size_t i = 0; i < config_.gates.size(); ++i) {
      const SceneGate& gate = config_.gates[i];
      const GatePlan plan{gate.position.head<2>(), gate.yaw, gate.position.z(), gate.opening, gate.frame};
      const std::string name = "gate" + std::to_string(i);
      if (gate.swing) {
        AddSwingingGate(world_, MaterialOf(gate.material), name, plan, {gate.swing->amplitude, gate.swing->period});
      } else {
        AddGate(world_, MaterialOf(gate.material), name, plan);
      }
    }
    AddStart();
    AddSurroundings();
    AddActors(world_, config_.actors, nullptr, seed_);
    return std::move(world_);
  }

 private:
  void AddGround() {
    const double half = 0.5 * config_.ground.size;
    AddObject(world_, "ground", geometry::Box{{half, half, 0.25}}, {base::Quat::Identity(), {0.0, 0.0, -0.25}},
              MaterialOf(config_.ground.material), config_.ground.material.texture_scale, SemanticClass::kGround);
  }

  void AddThing(const SceneObject& object, std::size_t index) {
    const std::string name = object.name.empty() ? "object" + std::to_string(index) : object.name;
    if (!names_.insert(name).second || name == "ground" || name == "pad" || name.starts_with("gate")) {
      throw base::InputError(object.name_origin.where, object.name_origin.path,
                             "`" + name + "` is taken; give each object a name of its own");
    }
    const base::Transform X_WO{base::FromYawPitchRoll(object.yaw, object.pitch, object.roll), object.position};
    const std::size_t at = AddObject(world_, name, ShapeOf(object), X_WO, MaterialOf(object.material),
                                     object.material.texture_scale, object.semantic);
    world_.objects[at].collides = object.collides;
  }

  void AddStart() {
    const Vec3& foot = config_.pad_position;
    const int material = MaterialOf({.pattern = SceneMaterial::Coat::kPad});
    AddPad(world_, material, foot.head<2>(), config_.pad_radius);
    world_.objects.back().X_WO.p.z() += foot.z();
    world_.X_WB_start = {base::FromYaw(config_.start_yaw), foot + Vec3(0.0, 0.0, kPadHeight)};
    world_.target = config_.target;
  }

  void AddSurroundings() {
    constexpr double kHeadroom = 20.0;  // m, above ground and pad, where no bounds are given
    const double half = 0.5 * config_.ground.size;
    world_.bounds_low = config_.bounds_low.value_or(Vec3(-half, -half, 0.0));
    world_.bounds_high =
        config_.bounds_high.value_or(Vec3(half, half, kHeadroom + std::max(0.0, config_.pad_position.z())));
    const Vec3& start = world_.X_WB_start.p;
    if ((start.array() < world_.bounds_low.array()).any() || (start.array() > world_.bounds_high.array()).any()) {
      throw base::InputError("world.pad_position lies outside the world's bounds; move it, or the bounds or ground");
    }
    world_.wind = {config_.wind_mean, config_.gust_sigma, config_.gust_time};
    if (config_.wind) world_.wind = DrawWind(*config_.wind, seed_);
    const double level = std::cos(config_.sun_elevation);
    world_.light.to_sun_W = {level * std::cos(config_.sun_azimuth), level * std::sin(config_.sun_azimuth),
                             std::sin(config_.sun_elevation)};
    world_.light.sun = static_cast<float>(config_.sun);
    world_.light.ambient = static_cast<float>(config_.ambient);
    world_.light.sky = config_.sky.cast<float>();
  }

  Shape ShapeOf(const SceneObject& object) {
    return std::visit(
        Overloaded{
            [](const SceneBox& s) -> Shape { return geometry::Box{0.5 * s.size}; },
            [](const SceneSphere& s) -> Shape { return geometry::Sphere{s.radius}; },
            [](const SceneCylinder& s) -> Shape {
              return geometry::Cylinder{s.radius, 0.5 * s.height};
            },
            [](const SceneCapsule& s) -> Shape {
              return geometry::Capsule{s.radius, 0.5 * s.height - s.radius};
            },
            [](const SceneCone& s) -> Shape {
              return geometry::Cone{s.radius, 0.5 * s.height};
            },
            [&](const SceneMesh& s) -> Shape { return geometry::MeshShape{MeshOf(s, object.material.texture_scale)}; },
        },
        object.shape);
  }

  std::shared_ptr<const geometry::Mesh> MeshOf(const SceneMesh& shape, double texture_scale) {
    std::shared_ptr<const geometry::Mesh>& as_read = files_[shape.file];
    if (as_read == nullptr) {
      as_read = LoadNamed(shape.file_origin,
                          [&] { return std::make_shared<const geometry::Mesh>(geometry::LoadMesh(shape.file)); });
    }
    std::shared_ptr<const geometry::Mesh>& scaled = meshes_[{as_read.get(), {shape.scale, texture_scale}}];
    if (scaled == nullptr) {
      auto mesh = std::make_shared<geometry::Mesh>(*as_read);
      for (geometry::Mesh::Vertex& vertex : mesh->vertices) {
        vertex.position *= static_cast<float>(shape.scale);
        vertex.uv /= static_cast<float>(texture_scale);
      }
      scaled = std::move(mesh);
    }
    return scaled;
  }

  /// Index of a material like this, made when there is none yet.
  int MaterialOf(const SceneMaterial& wanted) {
    const std::vector<double> colour(wanted.colour.data(), wanted.colour.data() + 3);
    const auto next = static_cast<int>(world_.materials.size());
    const auto [known, is_new] = materials_.try_emplace({colour, PictureOf(wanted)}, next);
    if (is_new) {
      world_.materials.push_back({"material" + std::to_string(next), wanted.colour.cast<float>(), TextureOf(wanted)});
    }
    return known->second;
  }

  std::shared_ptr<const geometry::Texture> TextureOf(const SceneMaterial& wanted) {
    const bool own = wanted.texture.empty();
    if (own && wanted.pattern == SceneMaterial::Coat::kPlain) return nullptr;
    std::shared_ptr<const geometry::Texture>& texture = textures_[PictureOf(wanted)];
    if (texture != nullptr) return texture;
    if (own) {
      const int pattern = static_cast<int>(wanted.pattern) - 1;
      texture = MakeTexture(static_cast<Pattern>(pattern), {}, config_.texture_size, seed_,
                            "scene" + std::to_string(pattern));
    } else {
      texture = LoadNamed(wanted.texture_origin, [&] {
        return std::make_shared<const geometry::Texture>(geometry::LoadTexture(wanted.texture));
      });
    }
    return texture;
  }

  const SceneConfig& config_;
  std::uint64_t seed_;
  World world_;
  std::set<std::string> names_;
  std::map<std::string, std::shared_ptr<const geometry::Mesh>> files_;
  std::map<std::pair<const geometry::Mesh*, std::pair<double, double>>, std::shared_ptr<const geometry::Mesh>> meshes_;
  std::map<std::pair<std::vector<double>, Picture>, int> materials_;
  std::map<Picture, std::shared_ptr<const geometry::Texture>> textures_;
};

}  // namespace

World MakeWorld(const SceneConfig& config, std::uint64_t seed) { return SceneBuilder(config, seed).Build(); }

}  // namespace alula::worlds

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/describe.h"
#include "worlds/actors/actor_config.h"
#include "worlds/wind_config.h"
#include "worlds/world.h"

namespace alula::worlds {

/// How a surface of a scene looks: colour times a picture of the user's or a pattern of ours.
struct SceneMaterial {
  /// kPlain, then the patterns of textures.h in their order.
  enum class Coat {
    kPlain,
    kBrick,
    kPlaster,
    kConcrete,
    kRubble,
    kPaving,
    kGravel,
    kWood,
    kBark,
    kFoliage,
    kSignal,
    kPad,
    kGrass,
    kAsphalt,
    kLitter,
    kSoil,
    kTiles,
    kMetal,
    kCarpet,
    kPaint
  };

  base::Vec3 colour = base::Vec3::Ones();  // red, green, blue from 0 to 1
  Coat pattern = Coat::kPlain;
  std::string texture{};       // PNG file in place of the pattern; empty: none
  double texture_scale = 2.0;  // m that one period covers; a mesh's own texture coordinates are divided by it
  base::Origin texture_origin{};
};

// Solids about their centre; round ones stand along z.
struct SceneBox {
  base::Vec3 size = base::Vec3::Ones();  // m
};
struct SceneSphere {
  double radius = 0.5;  // m
};
struct SceneCylinder {
  double radius = 0.5;
  double height = 1.0;
};
struct SceneCapsule {
  double radius = 0.5;
  double height = 2.0;  // with both caps
};
struct SceneCone {
  double radius = 0.5;
  double height = 1.0;
};
struct SceneMesh {
  std::string file;    // .obj, .gltf or .glb
  double scale = 1.0;  // of its lengths; 0.001 for a file in millimetres
  base::Origin file_origin;
};

struct SceneObject {
  std::string name;  // empty: "object<index>"
  std::variant<SceneBox, SceneSphere, SceneCylinder, SceneCapsule, SceneCone, SceneMesh> shape;
  base::Vec3 position = base::Vec3::Zero();  // of the centre, or of a mesh's origin, m
  double yaw = 0.0;                          // rad; the object is rolled, then pitched, then turned
  double pitch = 0.0;
  double roll = 0.0;
  SceneMaterial material;
  SemanticClass semantic = SemanticClass::kObstacle;
  bool collides = true;
  base::Origin name_origin;
};

/// A gate's frame that swings about a hinge at its left.
struct SceneSwing {
  double amplitude = 0.25;  // rad
  double period = 4.0;      // s
};

struct SceneGate {
  base::Vec3 position{0.0, 0.0, 1.5};  // of the opening's centre, m
  double yaw = 0.0;                    // of the direction of passage, rad
  double opening = 1.4;                // m
  double frame = 0.15;                 // m, of its bars
  SceneMaterial material{.pattern = SceneMaterial::Coat::kSignal};
  std::optional<SceneSwing> swing{};  // null: it stands
};

struct SceneGround {
  double size = 60.0;  // m, side of the square about the origin, at z = 0
  SceneMaterial material{.pattern = SceneMaterial::Coat::kGravel, .texture_scale = 7.0};
};

/// A world that its user describes thing by thing.
struct SceneConfig {
  static constexpr std::string_view kType = "scene";

  SceneGround ground;
  std::vector<SceneObject> objects;
  std::vector<SceneGate> gates;                  // in order of passage
  base::Vec3 pad_position = base::Vec3::Zero();  // of the foot of the pad, m; the vehicle starts in its middle
  double pad_radius = 1.2;                       // m
  double start_yaw = 0.0;                        // rad
  base::Vec3 target{0.0, 0.0, 1.5};              // m
  std::optional<base::Vec3> bounds_low{};        // m; absent: the ground's rim
  std::optional<base::Vec3> bounds_high{};       // m; absent: the ground's rim and 20 m above it
  double sun_azimuth = -0.9;                     // rad, from east to north
  double sun_elevation = 0.9;                    // rad
  double sun = 0.7;                              // strength of direct light
  double ambient = 0.35;
  base::Vec3 sky{0.62, 0.74, 0.90};           // its colour
  base::Vec3 wind_mean = base::Vec3::Zero();  // m/s, where the air moves to (world axes)
  double gust_sigma = 0.0;                    // m/s, per axis
  double gust_time = 2.0;                     // s
  std::optional<WindConfig> wind{};           // in place of the three
  std::vector<ActorConfig> actors;            // what moves
  int texture_size = 512;                     // texels a side of our own patterns
};

void Describe(base::Description& d, SceneConfig& c);

/// The scene with what its files hold; each file is read once, however many objects name it. Only our patterns draw
/// from `seed` (streams "world/texture/…"). Throws base::InputError, with the place of the key, for a mesh or texture
/// that cannot be used and for a name that stands twice.
World MakeWorld(const SceneConfig& config, std::uint64_t seed);

}  // namespace alula::worlds

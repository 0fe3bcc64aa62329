#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/frames.h"
#include "geometry/material.h"
#include "geometry/shape.h"
#include "worlds/actors/actor.h"
#include "worlds/lighting.h"
#include "worlds/semantic_class.h"

namespace alula::worlds {

/// One rigid thing of the world: a shape, where it stands, and how it looks.
struct Object {
  std::string name;
  geometry::Shape shape;
  base::Transform X_WO;
  int material = 0;            // index into World::materials
  double texture_scale = 1.0;  // metres per texture period
  bool collides = true;        // Bullet sees it (the renderer always does)
  SemanticClass semantic = SemanticClass::kObstacle;
  bool casts_shadow =
      true;  // false where the one broad light of `Light::sun` stands for lamps this side of it: ceilings
  double wire_radius = 0.0;  // m, of a wire: pictures show it from afar too, up to half a pixel too thick; 0: no wire
};

/// A square gate's opening: x along the direction of passage, z up, origin mid-opening; where it swings, as it rests.
struct Gate {
  std::string name;
  base::Transform X_WG;
  double opening = 0.0;  // side, m
  double frame = 0.0;    // width of the bars, m
  int actor = -1;        // index into World::actors of what swings it (a Swing); −1: it stands
};

/// Turbulence as dryden.h has it.
struct Dryden {
  double w20 = 0.0;             // mean wind 20 ft above the ground, m/s
  double airspeed_floor = 1.0;  // m/s
};
/// A gust that rises and falls once: (1 − cos) / 2.
struct CosineGust {
  double start = 0.0;                          // s
  double duration = 1.0;                       // s
  base::Vec3 velocity_W = base::Vec3::Zero();  // at its middle, m/s
};

/// A mean wind with first-order gusts on top (Gauss–Markov per axis), and more where it is asked for (wind.h).
struct Wind {
  base::Vec3 mean_W = base::Vec3::Zero();  // m/s, where the air moves to
  double gust_sigma = 0.0;                 // m/s
  double gust_time = 2.0;                  // correlation time, s
  std::optional<Dryden> dryden{};
  std::vector<CosineGust> gusts{};
  bool shelter = false;  // in the lee of what stands
};

struct Light {
  base::Vec3 to_sun_W = base::Vec3::UnitZ();  // unit
  float sun = 0.7F;                           // strength of direct light
  float ambient = 0.35F;
  Eigen::Vector3f sky{0.62F, 0.74F, 0.90F};  // colour of the sky
  float sky_brightness = 1.0F;               // factor on the sky as displayed: near 0 at night
  std::optional<Fog> fog{};
  std::vector<Lamp> lamps{};  // that stand in the world
};

/// What a world is: data from which Bullet, the renderer and the criteria are built. Nothing here moves.
struct World {
  std::string name;
  std::vector<geometry::Material> materials;
  std::vector<Object> objects;
  std::vector<Gate> gates;    // in order of passage
  std::vector<Actor> actors;  // what moves besides the vehicle
  Wind wind;
  Light light;
  base::Transform X_WB_start;  // of the ground point under the vehicle: z = height of the pad's surface
  double pad_radius = 0.0;     // the legs may touch `pad_object` only
  std::string pad_object;
  base::Vec3 target = base::Vec3::Zero();  // where the course ends
  base::Vec3 bounds_low = base::Vec3::Zero();
  base::Vec3 bounds_high = base::Vec3::Zero();
};

}  // namespace alula::worlds

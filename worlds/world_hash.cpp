#include "worlds/world_hash.h"

namespace alula::worlds {
namespace {

void Add(base::RollingHash& hash, const Eigen::Vector3f& v) { hash.Add(base::Vec3(v.cast<double>())); }

void Add(base::RollingHash& hash, const geometry::Material& material) {
  hash.Add(std::string_view(material.name));
  Add(hash, material.colour);
  hash.Add(static_cast<std::uint64_t>(material.texture ? material.texture->width : 0));
  if (material.texture) hash.AddBytes(material.texture->rgb);
}

void Add(base::RollingHash& hash, const geometry::Box& s) { hash.Add(s.half_extents); }
void Add(base::RollingHash& hash, const geometry::Sphere& s) { hash.Add(s.radius); }
template <typename Round>
void Add(base::RollingHash& hash, const Round& s) {
  hash.Add(s.radius);
  hash.Add(s.half_height);
}
void Add(base::RollingHash& hash, const geometry::MeshShape& s) {
  for (const auto& v : s.mesh->vertices) Add(hash, v.position);
  for (const auto& t : s.mesh->triangles) {
    for (const std::uint32_t i : t) hash.Add(static_cast<std::uint64_t>(i));
  }
}

void Add(base::RollingHash& hash, const Object& object) {
  hash.Add(std::string_view(object.name));
  hash.Add(static_cast<std::uint64_t>(object.shape.index()));
  std::visit([&hash](const auto& solid) { Add(hash, solid); }, object.shape);
  hash.Add(object.X_WO);
  hash.Add(static_cast<std::int64_t>(object.material));
  hash.Add(object.texture_scale);
  hash.Add(static_cast<std::uint64_t>(object.collides));
}

void Add(base::RollingHash& hash, const Lamp& lamp) {
  for (const base::Vec3& v : {lamp.position, lamp.direction, lamp.colour}) hash.Add(v);
  for (const double x : {lamp.cone, lamp.softness, lamp.intensity, lamp.range}) hash.Add(x);
}

void Add(base::RollingHash& hash, const std::vector<base::Vec3>& points) {
  for (const base::Vec3& p : points) hash.Add(p);
}
void Add(base::RollingHash& hash, const Walk& m) {
  Add(hash, m.route);
  for (const double x : {m.start, m.speed, m.height}) hash.Add(x);
  hash.Add(static_cast<std::uint64_t>(2 * m.closed + m.reactive));
}
void Add(base::RollingHash& hash, const Drive& m) {
  Add(hash, m.waypoints);
  for (const double x : {m.heading, m.start, m.speed, m.turn_radius, m.wheelbase, m.track, m.wheel_radius}) hash.Add(x);
  hash.Add(m.half_width);
  hash.Add(static_cast<std::uint64_t>(2 * m.closed + m.reactive));
}
void Add(base::RollingHash& hash, const Fly& m) {
  Add(hash, m.waypoints);
  for (const double x : {m.start, m.speed, m.turn_radius}) hash.Add(x);
  hash.Add(static_cast<std::uint64_t>(2 * m.closed + m.reactive));
}
void Add(base::RollingHash& hash, const Swing& m) {
  hash.Add(m.X_WH);
  for (const double x : {m.amplitude, m.period, m.phase}) hash.Add(x);
}
void Add(base::RollingHash& hash, const Sway& m) {
  for (const base::Transform& X_WR : m.X_WR) hash.Add(X_WR);
  for (const double x : {m.stiffness_speed, m.frequency, m.damping}) hash.Add(x);
}

void Add(base::RollingHash& hash, const Actor& actor) {
  hash.Add(std::string_view(actor.name));
  for (const ActorLink& link : actor.links) {
    hash.Add(std::string_view(link.name));
    hash.Add(static_cast<std::uint64_t>(link.shape.index()));
    std::visit([&hash](const auto& solid) { Add(hash, solid); }, link.shape);
    hash.Add(link.X_JL);
    for (const int i : {link.joint, link.material}) hash.Add(static_cast<std::int64_t>(i));
    hash.Add(link.texture_scale);
    hash.Add(static_cast<std::uint64_t>(2 * link.collides + link.casts_shadow));
  }
  hash.Add(static_cast<std::uint64_t>(actor.motion.index()));
  std::visit([&hash](const auto& motion) { Add(hash, motion); }, actor.motion);
}

/// What most worlds lack enters under its name where it is there. Semantic classes do not: they label truth and change
/// nothing that a vehicle meets.
void AddExtras(base::RollingHash& hash, const World& world) {
  if (world.light.sky_brightness != 1.0F) {
    hash.Add(std::string_view("sky_brightness"));
    hash.Add(static_cast<double>(world.light.sky_brightness));
  }
  if (world.light.fog) {
    hash.Add(std::string_view("fog"));
    hash.Add(world.light.fog->visibility);
    hash.Add(world.light.fog->height);
    hash.Add(world.light.fog->colour);
  }
  for (const Lamp& lamp : world.light.lamps) {
    hash.Add(std::string_view("lamp"));
    Add(hash, lamp);
  }
  if (world.wind.dryden) {
    hash.Add(std::string_view("dryden"));
    hash.Add(world.wind.dryden->w20);
    hash.Add(world.wind.dryden->airspeed_floor);
  }
  for (const CosineGust& gust : world.wind.gusts) {
    hash.Add(std::string_view("gust"));
    hash.Add(gust.start);
    hash.Add(gust.duration);
    hash.Add(gust.velocity_W);
  }
  if (world.wind.shelter) hash.Add(std::string_view("shelter"));
  for (const Actor& actor : world.actors) {
    hash.Add(std::string_view("actor"));
    Add(hash, actor);
  }
  for (const Object& object : world.objects) {
    if (object.casts_shadow) continue;
    hash.Add(std::string_view("no shadow"));
    hash.Add(std::string_view(object.name));
  }
  for (const geometry::Material& material : world.materials) {
    if (geometry::HasHoles(material)) hash.AddBytes(material.texture->alpha);
    if (material.infrared == 1.0F) continue;
    hash.Add(std::string_view("infrared"));
    hash.Add(std::string_view(material.name));
    hash.Add(static_cast<double>(material.infrared));
  }
}

}  // namespace

void AddTo(base::RollingHash& hash, const World& world) {
  hash.Add(std::string_view(world.name));
  for (const geometry::Material& material : world.materials) Add(hash, material);
  for (const Object& object : world.objects) Add(hash, object);
  for (const Gate& gate : world.gates) {
    hash.Add(std::string_view(gate.name));
    hash.Add(gate.X_WG);
    hash.Add(gate.opening);
    hash.Add(gate.frame);
  }
  hash.Add(world.wind.mean_W);
  hash.Add(world.wind.gust_sigma);
  hash.Add(world.wind.gust_time);
  hash.Add(world.light.to_sun_W);
  hash.Add(static_cast<double>(world.light.sun));
  hash.Add(static_cast<double>(world.light.ambient));
  Add(hash, world.light.sky);
  hash.Add(world.X_WB_start);
  hash.Add(world.pad_radius);
  hash.Add(std::string_view(world.pad_object));
  for (const base::Vec3& v : {world.target, world.bounds_low, world.bounds_high}) hash.Add(v);
  AddExtras(hash, world);
}

}  // namespace alula::worlds

#include "scenarios/world_json.h"

#include <nlohmann/json.hpp>

namespace alula::scenarios {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(const base::Vec3& v) { return {v.x(), v.y(), v.z()}; }
Json ToJson(const base::Transform& X) {
  return {{"position_m", ToJson(X.p)}, {"quaternion_wxyz", {X.q.w(), X.q.x(), X.q.y(), X.q.z()}}};
}

Json Shape(const geometry::Box& s) { return {{"type", "box"}, {"half_extents_m", ToJson(s.half_extents)}}; }
Json Shape(const geometry::Sphere& s) { return {{"type", "sphere"}, {"radius_m", s.radius}}; }
template <typename Round>
Json RoundShape(const char* type, const Round& s) {
  return {{"type", type}, {"radius_m", s.radius}, {"half_height_m", s.half_height}};
}
Json Shape(const geometry::Cylinder& s) { return RoundShape("cylinder", s); }
Json Shape(const geometry::Capsule& s) { return RoundShape("capsule", s); }
Json Shape(const geometry::Cone& s) { return RoundShape("cone", s); }
Json Shape(const geometry::MeshShape& s) {
  Json vertices = Json::array();
  for (const auto& v : s.mesh->vertices) vertices.push_back({v.position.x(), v.position.y(), v.position.z()});
  return {{"type", "mesh"}, {"vertices_m", vertices}, {"triangles", s.mesh->triangles}};
}

Json ToJson(const worlds::Wind& wind) {
  Json json = {{"mean_m_s", ToJson(wind.mean_W)},
               {"gust_sigma_m_s", wind.gust_sigma},
               {"gust_time_s", wind.gust_time},
               {"shelter", wind.shelter}};
  if (wind.dryden) {
    json["dryden"] = {{"w20_m_s", wind.dryden->w20}, {"airspeed_floor_m_s", wind.dryden->airspeed_floor}};
  }
  for (const worlds::CosineGust& gust : wind.gusts) {
    json["gusts"].push_back(
        {{"start_s", gust.start}, {"duration_s", gust.duration}, {"velocity_m_s", ToJson(gust.velocity_W)}});
  }
  return json;
}

}  // namespace

std::string WorldToJson(const worlds::World& world) {
  Json json;
  json["name"] = world.name;
  json["start"] = ToJson(world.X_WB_start);
  json["pad"] = {{"object", world.pad_object}, {"radius_m", world.pad_radius}};
  json["target_m"] = ToJson(world.target);
  json["bounds_low_m"] = ToJson(world.bounds_low);
  json["bounds_high_m"] = ToJson(world.bounds_high);
  json["wind"] = ToJson(world.wind);
  json["gates"] = Json::array();
  for (const worlds::Gate& gate : world.gates) {
    json["gates"].push_back(
        {{"name", gate.name}, {"pose", ToJson(gate.X_WG)}, {"opening_m", gate.opening}, {"frame_m", gate.frame}});
  }
  json["objects"] = Json::array();
  for (const worlds::Object& object : world.objects) {
    json["objects"].push_back({{"name", object.name},
                               {"pose", ToJson(object.X_WO)},
                               {"collides", object.collides},
                               {"shape", std::visit([](const auto& s) { return Shape(s); }, object.shape)}});
  }
  if (world.actors.empty()) return json.dump(1) + "\n";
  json["actors"] = Json::array();
  for (const worlds::Actor& actor : world.actors) {
    Json links = Json::array();
    for (const worlds::ActorLink& link : actor.links) {
      if (!link.collides) continue;
      links.push_back({{"name", actor.name + "/" + link.name},
                       {"shape", std::visit([](const auto& s) { return Shape(s); }, link.shape)}});
    }
    json["actors"].push_back({{"name", actor.name}, {"class", worlds::NameOf(actor.semantic)}, {"links", links}});
  }
  return json.dump(1) + "\n";
}

}  // namespace alula::scenarios

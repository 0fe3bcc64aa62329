#include "scenarios/check/landing_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.h"
#include "base/random.h"
#include "sim/physics_world.h"

namespace alula::scenarios::check {
namespace {

using base::Vec2;
using base::Vec3;

constexpr double kNear = 1.5;  // m about a drop, of what can be touched

worlds::World Neighbourhood(const worlds::World& world, const std::vector<Extent>& extents, const Vec2& p) {
  worlds::World near;
  near.materials.resize(world.materials.size());
  for (std::size_t i = 0; i < world.objects.size(); ++i) {
    const bool is_near = (extents[i].low - p).maxCoeff() < kNear && (p - extents[i].high).maxCoeff() < kNear;
    if (is_near && world.objects[i].collides) near.objects.push_back(world.objects[i]);
  }
  return near;
}

/// Highest surface under the hull.
double GroundUnder(const worlds::LandingSites& sites, const Vec2& p, double radius) {
  const int reach = static_cast<int>(std::ceil(radius / sites.cell));
  const Vec2 at = (p - sites.low) / sites.cell;
  double highest = -1e9;
  for (int j = static_cast<int>(at.y()) - reach; j <= static_cast<int>(at.y()) + reach; ++j) {
    for (int i = static_cast<int>(at.x()) - reach; i <= static_cast<int>(at.x()) + reach; ++i) {
      if (i < 0 || j < 0 || i >= sites.columns || j >= sites.rows || (sites.Middle(i, j) - p).norm() > radius) continue;
      highest = std::max(highest, static_cast<double>(sites.top[sites.Index(i, j)]));
    }
  }
  return highest;
}

/// Places on cells that are safe, or are not; drawn with replacement.
std::vector<Vec2> Sample(const worlds::LandingSites& sites, bool safe, int count, base::RandomStream& random) {
  std::vector<Vec2> places;
  std::vector<Vec2> all;
  for (int j = 0; j < sites.rows; ++j) {
    for (int i = 0; i < sites.columns; ++i) {
      const std::size_t cell = sites.Index(i, j);
      if ((sites.safe[cell] != 0) == safe && std::isfinite(sites.top[cell])) all.push_back(sites.Middle(i, j));
    }
  }
  if (all.empty()) return places;
  for (int n = 0; n < count; ++n) {
    const Vec2 jitter(random.Uniform(-0.5, 0.5), random.Uniform(-0.5, 0.5));
    places.push_back(all[random.Index(all.size())] + sites.cell * jitter);
  }
  return places;
}

}  // namespace

int LandingReport::Count(bool safe) const {
  return static_cast<int>(std::count_if(drops.begin(), drops.end(), [safe](const Drop& d) { return d.safe == safe; }));
}

double LandingReport::StoodShare(bool safe) const {
  const int count = Count(safe);
  const auto stood =
      std::count_if(drops.begin(), drops.end(), [safe](const Drop& d) { return d.safe == safe && d.stood; });
  return count == 0 ? 1.0 : static_cast<double>(stood) / count;
}

std::vector<Extent> ExtentsOf(const worlds::World& world) {
  std::vector<Extent> extents;
  for (const worlds::Object& object : world.objects) {
    const geometry::Mesh mesh = geometry::Tessellate(object.shape);
    Extent extent{Vec2::Constant(1e9), Vec2::Constant(-1e9)};
    for (const auto& vertex : mesh.vertices) {
      const Vec2 q = (object.X_WO * Vec3(vertex.position.cast<double>())).head<2>();
      extent.low = extent.low.cwiseMin(q);
      extent.high = extent.high.cwiseMax(q);
    }
    extents.push_back(extent);
  }
  return extents;
}

Drop DropAt(const worlds::World& world, const std::vector<Extent>& extents, const vehicles::VehicleBody& body,
            const worlds::LandingSites& sites, const DropStart& start, const DropConfig& config) {
  Drop drop;
  drop.at = start.p;
  const double ground = GroundUnder(sites, start.p, body.hull_radius);
  vehicles::BodyState state;
  state.X_WB = {base::FromYaw(start.yaw), {start.p.x(), start.p.y(), ground + body.standing_height + start.above}};
  const worlds::World near = Neighbourhood(world, extents, start.p);
  sim::PhysicsWorld physics(near, body, state);
  const base::Duration dt = base::Milliseconds(1);
  const int steps = static_cast<int>(std::lround(config.seconds / dt.Seconds()));
  Vec2 half_way = start.p;
  for (int n = 0; n < steps; ++n) {
    physics.Step({}, dt);
    if (n == steps / 2) half_way = physics.state().X_WB.p.head<2>();
    for (const sim::Contact& contact : physics.contacts()) {
      if (!contact.may_touch && drop.touched.empty())
        drop.touched = fmt::format("{} on {}", contact.part, contact.object);
    }
  }
  const vehicles::BodyState& end = physics.state();
  drop.tilt = std::acos(std::clamp((end.X_WB.q * Vec3::UnitZ()).z(), -1.0, 1.0));
  drop.slide = (end.X_WB.p.head<2>() - half_way).norm();
  drop.speed = end.v_WB.norm();
  drop.stood = drop.touched.empty() && drop.tilt <= config.tilt_max && drop.slide <= config.slide_max &&
               drop.speed <= config.speed_max;
  return drop;
}

LandingReport CheckLandingSites(const worlds::World& world, const vehicles::VehicleBody& body, int drops,
                                std::uint64_t seed, const DropConfig& config) {
  worlds::LandingConfig landing;
  landing.radius = body.hull_radius;
  landing.footprint = body.hull_radius;
  LandingReport report;
  report.sites = worlds::FindLandingSites(world, landing);
  const std::vector<Extent> extents = ExtentsOf(world);
  base::RandomStream random(seed, "check/landing");
  for (const bool safe : {true, false}) {
    for (const Vec2& p : Sample(report.sites, safe, safe ? drops : drops / 2, random)) {
      const double yaw = random.Uniform(-std::numbers::pi, std::numbers::pi);
      const double above = random.Uniform(config.low, config.high);
      report.drops.push_back(DropAt(world, extents, body, report.sites, {p, yaw, above}, config));
      report.drops.back().safe = safe;
    }
  }
  return report;
}

bool Passed(const LandingReport& report) {
  const double share = report.sites.SafeShare();
  return share > 0.0 && share < 1.0 && report.StoodShare(true) >= kStoodShareMin;
}

std::string ToTable(const LandingReport& report) {
  std::string text = fmt::format("  safe                {:6.2f} % of the area\n", 100.0 * report.sites.SafeShare());
  text += fmt::format("  stood on safe cells {:6.2f} % of {} drops   >= {:g} %\n", 100.0 * report.StoodShare(true),
                      report.Count(true), 100.0 * kStoodShareMin);
  text += fmt::format("  fell on others      {:6.2f} % of {} drops\n", 100.0 * (1.0 - report.StoodShare(false)),
                      report.Count(false));
  for (const Drop& drop : report.drops) {
    if (!drop.safe || drop.stood) continue;
    text += fmt::format("  fell at ({:.2f}, {:.2f}) m: tilt {:.1f} deg, slid {:.3f} m, speed {:.3f} m/s{}{}\n",
                        drop.at.x(), drop.at.y(), drop.tilt * 180.0 / std::numbers::pi, drop.slide, drop.speed,
                        drop.touched.empty() ? "" : ", ", drop.touched);
  }
  return text;
}

std::string ToJson(const LandingReport& report, const std::string& world) {
  nlohmann::ordered_json json;
  json["world"] = world;
  json["safe_share"] = report.sites.SafeShare();
  json["safe_drops"] = report.Count(true);
  json["safe_stood_share"] = report.StoodShare(true);
  json["other_drops"] = report.Count(false);
  json["other_stood_share"] = report.StoodShare(false);
  json["passed"] = Passed(report);
  return json.dump(2) + "\n";
}

std::string ToPgm(const worlds::LandingSites& sites) {
  std::string text = fmt::format("P5\n{} {}\n255\n", sites.columns, sites.rows);
  for (int j = sites.rows - 1; j >= 0; --j) {
    for (int i = 0; i < sites.columns; ++i) text.push_back(sites.safe[sites.Index(i, j)] != 0 ? '\xfe' : '\0');
  }
  return text;
}

std::string ToMapYaml(const worlds::LandingSites& sites) {
  return fmt::format(
      "image: grid.pgm\nresolution: {}\norigin: [{}, {}, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
      sites.cell, sites.low.x(), sites.low.y());
}

}  // namespace alula::scenarios::check

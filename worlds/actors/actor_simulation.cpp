#include "worlds/actors/actor_simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "worlds/actors/drive.h"
#include "worlds/actors/fly.h"
#include "worlds/actors/sway.h"
#include "worlds/actors/swing.h"
#include "worlds/actors/walk.h"

namespace alula::worlds {
namespace {

using base::Transform;
using base::Vec3;

/// States in the order of Motion.
using MotionState = std::variant<WalkState, DriveState, FlyState, SwingState, SwayState>;

template <typename M>
using StateOf = decltype(Begin(std::declval<const M&>(), std::declval<base::RandomStream&>()));

/// Radius of the ball about a solid's own origin that holds it.
double BallOf(const geometry::Box& s) { return s.half_extents.norm(); }
double BallOf(const geometry::Sphere& s) { return s.radius; }
double BallOf(const geometry::Cylinder& s) { return std::hypot(s.radius, s.half_height); }
double BallOf(const geometry::Capsule& s) { return s.radius + s.half_height; }
double BallOf(const geometry::Cone& s) { return std::hypot(s.radius, s.half_height); }
double BallOf(const geometry::MeshShape& s) {
  double radius = 0.0;
  for (const auto& v : s.mesh->vertices) radius = std::max(radius, v.position.cast<double>().norm());
  return radius;
}

}  // namespace

struct ActorSimulation::Player {
  Player(const Actor& of, std::uint64_t seed)
      : actor(&of),
        random(seed, "world/actors/" + of.name),
        state(std::visit([this](const auto& motion) -> MotionState { return Begin(motion, random); }, of.motion)) {}

  /// Calls f(motion, state) with what they are.
  template <typename F>
  auto Visit(const F& f) {
    return std::visit([&](const auto& m) { return f(m, std::get<StateOf<std::decay_t<decltype(m)>>>(state)); },
                      actor->motion);
  }

  const Actor* actor;
  base::RandomStream random;
  MotionState state;
  std::vector<double> q;        // for poses
  std::vector<Transform> X_WJ;  // likewise
  double top_speed = 0.0;       // m/s, of its fastest part
};

ActorSimulation::ActorSimulation(const World& world, std::uint64_t seed) : world_(&world), first_link_{0}, first_q_{0} {
  for (const Actor& actor : world.actors) {
    players_.push_back(std::make_unique<Player>(actor, seed));
    Player& player = *players_.back();
    player.Visit([&](const auto& motion, auto&) {
      player.q.resize(CoordinateCount(motion));
      player.X_WJ.resize(JointCount(motion));
    });
    first_link_.push_back(first_link_.back() + actor.links.size());
    first_q_.push_back(first_q_.back() + player.q.size());
    for (const ActorLink& link : actor.links) {
      if (link.joint < 0 || static_cast<std::size_t>(link.joint) >= player.X_WJ.size()) {
        throw base::FaultError("actors", "link \"" + actor.name + "/" + link.name + "\" sits on joint " +
                                             std::to_string(link.joint) + " of " + std::to_string(player.X_WJ.size()));
      }
    }
  }
  if (empty()) return;
  outlines_ = OutlinesOf(world);
  neighbours_.resize(players_.size());
  Note({0});
  for (std::size_t i = 0; i < players_.size(); ++i) reach_.push_back(FindReach(i));
}

ActorSimulation::~ActorSimulation() = default;
ActorSimulation::ActorSimulation(ActorSimulation&&) noexcept = default;

double ActorSimulation::FindReach(std::size_t actor) const {
  constexpr double kLimbs = 0.25;  // m that a walker reaches farther than as it stands at the begin
  const std::vector<ActorLink>& links = players_[actor]->actor->links;
  std::vector<Transform> X_WL(links.size());
  PlaceLinks(actor, {0}, X_WL);
  const Vec3 root = RootPose(actor, {0}).p;
  double reach = 0.0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (!links[i].collides) continue;
    const double ball = std::visit([](const auto& shape) { return BallOf(shape); }, links[i].shape);
    reach = std::max(reach, (X_WL[i].p - root).norm() + ball);
  }
  const bool walks = std::holds_alternative<Walk>(players_[actor]->actor->motion);
  return reach > 0.0 && walks ? reach + kLimbs : reach;
}

void ActorSimulation::Note(base::Time time) {
  constexpr std::size_t kMemory = 40;  // ticks
  Tick tick{time, {}};
  if (ticks_.size() >= kMemory) {
    tick.q = std::move(ticks_.front().q);
    ticks_.pop_front();
  }
  tick.q.resize(first_q_.back());
  for (std::size_t i = 0; i < players_.size(); ++i) {
    Player& player = *players_[i];
    player.Visit([&](const auto& motion, auto& state) {
      Coordinates(motion, state, tick.q.data() + first_q_[i]);
      neighbours_[i] = AsNeighbour(motion, state);
      player.top_speed = TopSpeed(motion, state, reach_.size() > i ? reach_[i] : 1.0);
    });
  }
  ticks_.push_back(std::move(tick));
}

void ActorSimulation::Advance(base::Time t, const ActorStimulus& now) {
  while (!empty() && ticks_.back().time < t) {
    const base::Time begin = ticks_.back().time;
    for (std::size_t i = 0; i < players_.size(); ++i) {
      Player& player = *players_[i];
      const ActorSurroundings around{begin, kTick.Seconds(), now, neighbours_, i, outlines_, player.random};
      player.Visit([&](const auto& motion, auto& state) { worlds::Advance(motion, state, around); });
    }
    Note(begin + kTick);
  }
}

void ActorSimulation::Interpolate(std::size_t actor, base::Time t, std::span<double> q) const {
  const std::int64_t back = (ticks_.back().time - t).ns / kTick.ns;  // whole ticks before the last one
  const std::size_t last = ticks_.size() - 1;
  const std::size_t later =
      last - static_cast<std::size_t>(std::clamp<std::int64_t>(back, 0, static_cast<std::int64_t>(last)));
  const std::size_t earlier = later == 0 ? 0 : later - 1;
  const Tick& a = ticks_[earlier];
  const Tick& b = ticks_[later];
  const double span = (b.time - a.time).Seconds();
  const double share = span > 0.0 ? std::clamp((t - a.time).Seconds() / span, 0.0, 1.0) : 0.0;
  const std::size_t first = first_q_[actor];
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = a.q[first + i] + share * (b.q[first + i] - a.q[first + i]);
}

const std::vector<Transform>& ActorSimulation::Joints(std::size_t actor, base::Time t) const {
  Player& player = *players_[actor];
  Interpolate(actor, t, player.q);
  player.Visit([&](const auto& motion, auto&) { PlaceJoints(motion, player.q.data(), player.X_WJ.data()); });
  return player.X_WJ;
}

void ActorSimulation::PlaceLinks(std::size_t actor, base::Time t, std::span<Transform> X_WL) const {
  const std::vector<Transform>& X_WJ = Joints(actor, t);
  const std::vector<ActorLink>& links = players_[actor]->actor->links;
  for (std::size_t i = 0; i < links.size(); ++i) {
    X_WL[i] = X_WJ[static_cast<std::size_t>(links[i].joint)] * links[i].X_JL;
  }
}

std::vector<Transform> ActorSimulation::LinkPoses(base::Time t) const {
  std::vector<Transform> X_WL(links());
  for (std::size_t i = 0; i < players_.size(); ++i) {
    PlaceLinks(i, t, std::span(X_WL).subspan(first_link_[i], first_link_[i + 1] - first_link_[i]));
  }
  return X_WL;
}

Transform ActorSimulation::RootPose(std::size_t actor, base::Time t) const {
  return players_[actor]->Visit([&](const auto& motion, auto&) {
    std::array<double, kRootCoordinates> q{};
    Interpolate(actor, t, std::span(q).first(std::min(kRootCoordinates, CoordinateCount(motion))));
    return PlaceRoot(motion, q.data());
  });
}

Transform ActorSimulation::GatePose(const Gate& gate, base::Time t) const {
  if (gate.actor < 0) return gate.X_WG;
  const auto& swing = std::get<Swing>(world_->actors[static_cast<std::size_t>(gate.actor)].motion);
  return RootPose(static_cast<std::size_t>(gate.actor), t) * swing.X_WH.Inverse() * gate.X_WG;
}

double ActorSimulation::AngularSpeed(const Vec3& p_W) const {
  constexpr double kNear = 1.5;  // m, as near as the shutter's own steps are made for
  double fastest = 0.0;
  for (std::size_t i = 0; i < players_.size(); ++i) {
    const double distance = (RootPose(i, ticks_.back().time).p - p_W).norm() - reach_[i];
    fastest = std::max(fastest, players_[i]->top_speed / std::max(distance, kNear));
  }
  return fastest;
}

std::vector<Transform> ActorSimulation::RootsOfTick(base::Time from, base::Time to) const {
  std::vector<Transform> roots;
  const base::Time tick{to.ns - to.ns % kTick.ns};
  if (empty() || tick <= from) return roots;
  for (std::size_t i = 0; i < players_.size(); ++i) roots.push_back(RootPose(i, tick));
  return roots;
}

}  // namespace alula::worlds

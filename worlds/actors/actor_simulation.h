#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/time.h"
#include "worlds/world.h"

namespace alula::worlds {

/// The true vehicle, as actors meet it, and the air about it.
struct ActorStimulus {
  base::Vec3 p_WB = base::Vec3::Zero();
  base::Vec3 v_WB = base::Vec3::Zero();
  double radius = 0.2;                     // m, of its hull
  double thrust = 0.0;                     // N, that presses air down
  base::Vec3 wind_W = base::Vec3::Zero();  // at the vehicle, m/s
};

struct Neighbour;
struct Outline;

/// The actors of a world in motion. Their generalised coordinates q are stepped every kTick from what is true at the
/// tick's begin, and run linearly between ticks: a pose at any instant of the last quarter of a second is a function
/// of the run so far, whoever asks and how often. Everything draws from named streams of the seed.
class ActorSimulation {
 public:
  static constexpr base::Duration kTick = base::Milliseconds(10);

  /// The world must outlive it.
  ActorSimulation(const World& world, std::uint64_t seed);
  ~ActorSimulation();
  ActorSimulation(ActorSimulation&&) noexcept;

  bool empty() const { return world_->actors.empty(); }
  std::size_t links() const { return first_link_.back(); }  // of all actors
  /// Makes poses known up to t; `now` is what is true at the begin of the step.
  void Advance(base::Time t, const ActorStimulus& now);

  /// Poses of one actor's links, in their order. Before the memory, or after what is known, the pose there.
  void PlaceLinks(std::size_t actor, base::Time t, std::span<base::Transform> X_WL) const;
  /// Of all actors' links, one actor after the other.
  std::vector<base::Transform> LinkPoses(base::Time t) const;
  /// Joint 0: the pelvis of a person, the chassis of a car.
  base::Transform RootPose(std::size_t actor, base::Time t) const;
  /// Ball about joint 0 that holds an actor's links that collide, m; 0 where none does.
  double Reach(std::size_t actor) const { return reach_[actor]; }
  /// A gate's pose: where it stands, or where its actor has swung it.
  base::Transform GatePose(const Gate& gate, base::Time t) const;
  /// Of the fastest actor as seen from p_W, over the last tick: speed / distance (1.5 m at least), rad/s.
  double AngularSpeed(const base::Vec3& p_W) const;

  /// Root poses of all actors at the tick that lies in (from, to], for records; empty where none does.
  std::vector<base::Transform> RootsOfTick(base::Time from, base::Time to) const;

 private:
  struct Player;  // one actor with its state
  struct Tick {
    base::Time time;
    std::vector<double> q;
  };
  void Note(base::Time time);
  double FindReach(std::size_t actor) const;
  void Interpolate(std::size_t actor, base::Time t, std::span<double> q) const;
  const std::vector<base::Transform>& Joints(std::size_t actor, base::Time t) const;

  const World* world_;
  std::vector<std::unique_ptr<Player>> players_;
  std::vector<std::size_t> first_link_;  // by actor, and the number of all
  std::vector<std::size_t> first_q_;     // likewise
  std::vector<double> reach_;
  std::vector<Outline> outlines_;  // of what stands
  std::vector<Neighbour> neighbours_;
  std::deque<Tick> ticks_;
};

}  // namespace alula::worlds

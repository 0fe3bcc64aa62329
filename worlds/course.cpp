#include "worlds/course.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Vec2;

constexpr double kDegree = 0.017453292519943295;

// The nominal course: counter-clockwise from the corner at (−, −). Mirrored in x and y it starts in any corner.
const Vec2 kPad(-10.5, -6.0);
const Vec2 kTarget(-9.0, -2.9);
const std::array<Vec2, 5> kGates{Vec2(-4.0, -6.2), Vec2(3.4, -5.4), Vec2(9.8, -1.2), Vec2(5.8, 5.0), Vec2(-2.2, 5.4)};

Vec2 Direction(double yaw) { return {std::cos(yaw), std::sin(yaw)}; }
double Heading(const Vec2& v) { return std::atan2(v.y(), v.x()); }
double AngleBetween(double a, double b) { return std::abs(base::WrapAngle(a - b)); }

struct Spread {
  Vec2 place;
  double yaw;
};

CoursePlan Draw(const CourtyardConfig& config, const Vec2& mirror, const Spread& spread, RandomStream& random) {
  const auto around = [&](const Vec2& nominal) {
    const double dx = random.Uniform(-spread.place.x(), spread.place.x());
    const double dy = random.Uniform(-spread.place.y(), spread.place.y());
    return Vec2((nominal + Vec2(dx, dy)).cwiseProduct(mirror));
  };
  CoursePlan course;
  course.pad = around(kPad);
  course.target = around(kTarget);
  course.target_height = 1.2;
  for (std::size_t i = 0; i < kGates.size(); ++i) course.gates[i].p = around(kGates[i]);
  const std::vector<Vec2> points = CoursePoints(course);
  for (std::size_t i = 0; i < kGates.size(); ++i) {
    GatePlan& gate = course.gates[i];
    const Vec2 in = (points[i + 1] - points[i]).normalized();
    const Vec2 out = (points[i + 2] - points[i + 1]).normalized();
    gate.yaw = base::WrapAngle(Heading(in + out) + random.Uniform(-spread.yaw, spread.yaw));
    gate.opening = random.Uniform(config.opening_min, config.opening_max);
    gate.frame = random.Uniform(config.frame_min, config.frame_max);
    const double lowest = 0.5 * gate.opening + gate.frame + 0.05;  // the bottom bar stays above the ground
    gate.height = std::max(random.Uniform(config.gate_height_min, config.gate_height_max), lowest);
  }
  return course;
}

bool InsideWalls(const Vec2& p, double margin) {
  return std::abs(p.x()) <= kCourtyardHalfLength - margin && std::abs(p.y()) <= kCourtyardHalfWidth - margin;
}

/// The gate is met at a moderate angle, left toward what comes next, and has room before and after.
bool GateIsFlyable(const GatePlan& gate, const Vec2& before, const Vec2& after) {
  const Vec2 d = Direction(gate.yaw);
  const Vec2 exit = gate.p + 1.5 * d;
  return AngleBetween(gate.yaw, Heading(gate.p - before)) <= 50 * kDegree &&
         AngleBetween(gate.yaw, Heading(after - exit)) <= 70 * kDegree && InsideWalls(gate.p + 2.2 * d, 1.2) &&
         InsideWalls(gate.p - 2.2 * d, 1.2);
}

}  // namespace

double DistanceToSegment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / std::max(ab.squaredNorm(), 1e-12), 0.0, 1.0);
  return (p - a - t * ab).norm();
}

std::vector<Vec2> CoursePoints(const CoursePlan& course) {
  std::vector<Vec2> points{course.pad};
  for (const GatePlan& gate : course.gates) points.push_back(gate.p);
  points.push_back(course.target);
  return points;
}

double CourseLength(const CoursePlan& course) {
  const std::vector<Vec2> points = CoursePoints(course);
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

bool IsFlyable(const CoursePlan& course) {
  const std::vector<Vec2> points = CoursePoints(course);
  for (std::size_t i = 0; i < course.gates.size(); ++i) {
    const double leg = (points[i + 1] - points[i]).norm();  // to this gate
    if (leg < 5.0 || leg > 9.0) return false;
    if (!GateIsFlyable(course.gates[i], points[i], points[i + 2])) return false;
    if (i > 0 && AngleBetween(course.gates[i].yaw, course.gates[i - 1].yaw) > 100 * kDegree) return false;
    // Other gates keep out of this leg and of the free room.
    for (std::size_t j = 0; j < course.gates.size(); ++j) {
      if (j == i) continue;
      if ((course.gates[j].p - course.gates[i].p).norm() < 4.5) return false;
      if (j + 1 != i && DistanceToSegment(course.gates[j].p, points[i], points[i + 1]) < 2.5) return false;
    }
  }
  const double home = (course.target - course.pad).norm();
  const double length = CourseLength(course);
  return home >= 2.2 && home <= 4.0 && length >= 35.0 && length <= 55.0 && InsideWalls(course.pad, 2.5);
}

CoursePlan DrawCourse(const CourtyardConfig& config, std::uint64_t seed) {
  RandomStream random(seed, "world/course");
  const Vec2 mirror(random.Index(2) == 0 ? 1.0 : -1.0, random.Index(2) == 0 ? 1.0 : -1.0);
  const Spread spread{{1.6, 1.3}, config.gate_heading_spread};
  for (int i = 0; i < config.placement_tries; ++i) {
    const CoursePlan course = Draw(config, mirror, spread, random);
    if (IsFlyable(course)) return course;
  }
  return Draw(config, mirror, {{0.0, 0.0}, 0.0}, random);
}

}  // namespace alula::worlds

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "worlds/courtyard.h"

namespace alula::worlds {

inline constexpr double kCourtyardHalfLength = 15.0;  // m, along x
inline constexpr double kCourtyardHalfWidth = 10.0;   // m, along y
inline constexpr double kGateFreeLength = 2.0;        // m, before and after each opening, along its axis
inline constexpr double kGateFreeRadius = 0.9;        // m, about that axis
inline constexpr double kPassableWidth = 1.3;         // m, between any two obstacles

/// Where the course runs, in the world's horizontal plane.
struct GatePlan {
  base::Vec2 p{0.0, 0.0};
  double yaw = 0.0;      // of the direction of passage
  double height = 1.5;   // of the opening's centre, m
  double opening = 1.4;  // m
  double frame = 0.15;   // m
};
struct CoursePlan {
  base::Vec2 pad{0.0, 0.0};
  base::Vec2 target{0.0, 0.0};
  double target_height = 1.2;  // m
  std::array<GatePlan, 5> gates;
};

/// Draws courses around the courtyard (starting corner and sense of rotation too) until one keeps the promises of
/// courtyard.h; after `config.placement_tries` draws it takes the nominal course, which keeps them for sure.
CoursePlan DrawCourse(const CourtyardConfig& config, std::uint64_t seed);

/// Whether a course keeps those promises that concern pad, gates and target alone.
bool IsFlyable(const CoursePlan& course);

/// Distance of p from the segment a–b, m.
double DistanceToSegment(const base::Vec2& p, const base::Vec2& a, const base::Vec2& b);

/// Pad, gates, target: the points of the course in order, and its length along straight legs, m.
std::vector<base::Vec2> CoursePoints(const CoursePlan& course);
double CourseLength(const CoursePlan& course);

}  // namespace alula::worlds

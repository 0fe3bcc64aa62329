#pragma once

#include <vector>

#include "worlds/world.h"

namespace alula::worlds {

/// A thing as seen from above: a rectangle, turned and grown by a radius all round (a circle where it has no sides),
/// and the heights between which it stands.
struct Outline {
  base::Vec2 centre{0.0, 0.0};
  base::Vec2 along{1.0, 0.0};  // unit, of the first side
  base::Vec2 half{0.0, 0.0};   // m
  double radius = 0.0;         // m
  double low = 0.0;            // m, world z
  double high = 0.0;
};

/// Outlines of the objects that collide: exact for spheres, boxes turned about z, upright cylinders, cones and
/// capsules; else of the box in world axes. Ground (kGround) and pads are left out.
std::vector<Outline> OutlinesOf(const World& world);

/// Vector from the nearest point of the outline to p, m, and its length less the radius: the distance, negative inside.
struct Gap {
  base::Vec2 away{0.0, 0.0};  // unit, from the outline to p
  double distance = 0.0;      // m
};
Gap GapTo(const Outline& outline, const base::Vec2& p);

/// Whether the segment from a to b keeps `room` m from the outline.
bool IsClear(const Outline& outline, const base::Vec2& a, const base::Vec2& b, double room);

}  // namespace alula::worlds

#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "geometry/material.h"
#include "geometry/shape.h"

namespace alula::worlds {

/// A ring of a body turned about z: how high, and how wide (m).
struct Ring {
  double z = 0.0;
  double radius = 0.0;
};

/// A closed body of elliptic rings from below to above (the first and the last of radius 0), `x` and `y` times the
/// radius wide; smooth normals; one texture period covers `period` m. Where the profile is convex, so is the body:
/// Bullet's hull is then what one sees. Ten corners a ring: 80 triangles a limb.
geometry::MeshShape TurnedBody(const std::vector<Ring>& rings, double x, double y, double period);

/// A limb that hangs from the origin down to −length, round at both ends.
geometry::MeshShape Limb(double length, double radius_above, double radius_below, double period);
/// An ellipsoid about the origin.
geometry::MeshShape Ellipsoid(const base::Vec3& radii, double period);
/// A prism about the origin whose top is smaller than its bottom: half extents below and above, half its height; the
/// top is moved by `back` along x.
geometry::MeshShape Frustum(const base::Vec2& below, const base::Vec2& above, double half_height, double back);

/// Cloth of two colours, `size` texels a side, from the stream "world/texture/<name>" of the seed.
enum class Cloth { kPlain, kStripes, kChecks, kSpeckled };
std::shared_ptr<const geometry::Texture> MakeCloth(Cloth cloth, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                                   int size, std::uint64_t seed, std::string_view name);

}  // namespace alula::worlds

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "base/frames.h"
#include "base/random.h"
#include "geometry/mesh.h"

namespace alula::worlds {

// Pieces that meshes are put together from. All append to `mesh`, in its own frame, metres; triangles turn
// counter-clockwise as seen from outside. `texture_scale`: metres that one texture period covers.

/// A flat quadrilateral, corners counter-clockwise from the lower left; texture coordinates by side lengths.
void AddQuad(geometry::Mesh& mesh, const std::array<base::Vec3, 4>& corners, double texture_scale);

/// A box of full size `size` about the origin of X.
void AddBoxPart(geometry::Mesh& mesh, const base::Vec3& size, const base::Transform& X, double texture_scale);

/// A straight member from a to b of rectangular section, `width` level and `depth` upright as far as it can be.
void AddBeam(geometry::Mesh& mesh, const base::Vec3& a, const base::Vec3& b, double width, double depth,
             double texture_scale);

/// A rectangle with half sides `right` and `up` about `middle`, seen from both sides, that shows the texture once.
/// `normals`: of its corners, from lower left on, for both sides: foliage is lit as the crown's surface is, not as the
/// card that stands for it.
void AddCard(geometry::Mesh& mesh, const base::Vec3& middle, const base::Vec3& right, const base::Vec3& up,
             const std::array<base::Vec3, 4>& normals);
/// The same with each side's own normal.
void AddSheet(geometry::Mesh& mesh, const base::Vec3& middle, const base::Vec3& right, const base::Vec3& up);

/// One point of a tube's middle line, and its radius there.
struct TubePoint {
  base::Vec3 p;
  double radius = 0.0;
};
/// A tube of `sides` faces along a line of at least two points, closed at both ends.
void AddTube(geometry::Mesh& mesh, std::span<const TubePoint> line, int sides, double texture_scale);

/// A profile of (radius, z), from bottom to top, turned about the z axis of X; where it begins or ends off the axis it
/// is open.
void AddLathe(geometry::Mesh& mesh, std::span<const base::Vec2> profile, int segments, const base::Transform& X,
              double texture_scale);

/// A convex outline in the x–z plane, counter-clockwise as seen from −y, drawn out along y to `length` about the origin
/// of X.
void AddPrism(geometry::Mesh& mesh, std::span<const base::Vec2> outline, double length, const base::Transform& X,
              double texture_scale);

/// A sector of a ring about the z axis of X: radii [r0, r1], angles [a0, a1] (rad), heights [z0, z1]. A whole turn has
/// no ends.
struct RingSector {
  double r0 = 0.0, r1 = 1.0;
  double a0 = 0.0, a1 = 6.283185307179586;
  double z0 = 0.0, z1 = 0.1;
};
void AddRingSector(geometry::Mesh& mesh, const RingSector& sector, const base::Transform& X, double texture_scale);

/// A stone: a ball of half axes `size` whose radius is roughened by `rough` (a share, 1σ), flattened faces and all;
/// texture by longitude and latitude.
std::shared_ptr<const geometry::Mesh> MakeBoulder(const base::Vec3& size, double rough, double texture_scale,
                                                  base::RandomStream& random);

}  // namespace alula::worlds

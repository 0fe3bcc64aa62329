#pragma once

#include <btBulletCollisionCommon.h>

#include <memory>
#include <vector>

#include "base/frames.h"
#include "geometry/shape.h"

namespace alula::sim::internal {

inline btVector3 ToBullet(const base::Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline base::Vec3 FromBullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
btTransform ToBullet(const base::Transform& X);
base::Transform FromBullet(const btTransform& X);

/// Owns the Bullet shapes built from geometry::Shape, and the triangle arrays that they refer to.
class ShapeStore {
 public:
  /// `solid`: the shape moves; a mesh then becomes its convex hull. Otherwise meshes keep their triangles.
  btCollisionShape* Make(const geometry::Shape& shape, bool solid);
  btCompoundShape* MakeCompound();

 private:
  std::vector<std::unique_ptr<btTriangleMesh>> triangles_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
};

/// Signed GJK/EPA distance of two shapes (the second may be a triangle mesh), not beyond `reach`, m.
double Distance(const btConvexShape& a, const btTransform& X_WA, const btCollisionShape& b, const btTransform& X_WB,
                double reach);

}  // namespace alula::sim::internal

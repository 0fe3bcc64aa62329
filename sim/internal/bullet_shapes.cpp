#include "sim/internal/bullet_shapes.h"

#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <algorithm>

#include "base/error.h"

namespace alula::sim::internal {
namespace {

/// Bullet rounds convex shapes by a margin of 4 cm unless told otherwise; a propeller disc is millimetres thin.
constexpr double kMargin = 2e-4;  // m

template <typename... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <typename... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

btVector3 Point(const Eigen::Vector3f& p) {
  const Eigen::Vector3d d = p.cast<double>();
  return {d.x(), d.y(), d.z()};
}

/// Smallest distance of a convex body to the triangles whose boxes are within reach.
class TriangleDistance : public btTriangleCallback {
 public:
  TriangleDistance(const btConvexShape& a, const btTransform& X_WA, const btTransform& X_WB, double reach)
      : a_(a), X_WA_(X_WA), X_WB_(X_WB), best_(reach) {}

  void processTriangle(btVector3* corner, int, int) override {
    btTriangleShape triangle(corner[0], corner[1], corner[2]);
    triangle.setMargin(0.0);
    best_ = std::min(best_, Distance(a_, X_WA_, triangle, X_WB_, best_));
  }
  double best() const { return best_; }

 private:
  const btConvexShape& a_;
  const btTransform& X_WA_;
  const btTransform& X_WB_;
  double best_;
};

}  // namespace

btTransform ToBullet(const base::Transform& X) {
  return btTransform(btQuaternion(X.q.x(), X.q.y(), X.q.z(), X.q.w()), ToBullet(X.p));
}

base::Transform FromBullet(const btTransform& X) {
  const btQuaternion q = X.getRotation();
  return {base::Quat(q.w(), q.x(), q.y(), q.z()).normalized(), FromBullet(X.getOrigin())};
}

btCollisionShape* ShapeStore::Make(const geometry::Shape& shape, bool solid) {
  const auto keep = [this](auto made) -> btCollisionShape* {
    shapes_.push_back(std::move(made));
    return shapes_.back().get();
  };
  return std::visit(Overloaded{
                        [&](const geometry::Box& s) {
                          auto made = std::make_unique<btBoxShape>(ToBullet(s.half_extents));
                          made->setMargin(std::min(kMargin, 0.1 * s.half_extents.minCoeff()));
                          return keep(std::move(made));
                        },
                        [&](const geometry::Sphere& s) { return keep(std::make_unique<btSphereShape>(s.radius)); },
                        [&](const geometry::Cylinder& s) {
                          auto made = std::make_unique<btCylinderShapeZ>(btVector3(s.radius, s.radius, s.half_height));
                          made->setMargin(std::min(kMargin, 0.1 * std::min(s.radius, s.half_height)));
                          return keep(std::move(made));
                        },
                        [&](const geometry::Capsule& s) {
                          return keep(std::make_unique<btCapsuleShapeZ>(s.radius, 2.0 * s.half_height));
                        },
                        [&](const geometry::Cone& s) {
                          auto made = std::make_unique<btConeShapeZ>(s.radius, 2.0 * s.half_height);
                          made->setMargin(0.0);  // a cone's margin lies outside of it
                          return keep(std::move(made));
                        },
                        [&](const geometry::MeshShape& s) {
                          if (!s.mesh || s.mesh->triangles.empty())
                            throw base::FaultError("physics_setup", "a mesh has no triangles");
                          if (solid) {
                            auto made = std::make_unique<btConvexHullShape>();
                            for (const auto& v : s.mesh->vertices) made->addPoint(Point(v.position), false);
                            made->setMargin(0.0);
                            made->recalcLocalAabb();
                            return keep(std::move(made));
                          }
                          auto triangles = std::make_unique<btTriangleMesh>();
                          for (const auto& t : s.mesh->triangles) {
                            triangles->addTriangle(Point(s.mesh->vertices[t[0]].position),
                                                   Point(s.mesh->vertices[t[1]].position),
                                                   Point(s.mesh->vertices[t[2]].position));
                          }
                          auto made = std::make_unique<btBvhTriangleMeshShape>(triangles.get(), true);
                          made->setMargin(0.0);
                          triangles_.push_back(std::move(triangles));
                          return keep(std::move(made));
                        },
                    },
                    shape);
}

btCompoundShape* ShapeStore::MakeCompound() {
  auto made = std::make_unique<btCompoundShape>();
  btCompoundShape* raw = made.get();
  shapes_.push_back(std::move(made));
  return raw;
}

double Distance(const btConvexShape& a, const btTransform& X_WA, const btCollisionShape& b, const btTransform& X_WB,
                double reach) {
  if (b.isConcave()) {
    TriangleDistance nearest(a, X_WA, X_WB, reach);
    btVector3 low, high;
    a.getAabb(X_WB.inverse() * X_WA, low, high);
    const btVector3 grow(reach, reach, reach);
    static_cast<const btConcaveShape&>(b).processAllTriangles(&nearest, low - grow, high + grow);
    return nearest.best();
  }
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver penetration;
  btGjkPairDetector gjk(&a, static_cast<const btConvexShape*>(&b), &simplex, &penetration);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = X_WA;
  input.m_transformB = X_WB;
  const double limit = reach + a.getMargin() + b.getMargin();
  input.m_maximumDistanceSquared = limit * limit;
  btPointCollector nearest;
  gjk.getClosestPoints(input, nearest, nullptr);
  return nearest.m_hasResult ? std::min(reach, nearest.m_distance) : reach;
}

}  // namespace alula::sim::internal

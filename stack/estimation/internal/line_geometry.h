#pragma once

#include <optional>

#include "base/frames.h"

namespace alula::stack::estimation {

/// A line in space with a direction, Plücker coordinates: n = p × v for any point p on it (m), v along it. Any common
/// factor is the same line.
struct PluckerLine {
  base::Vec3 n = base::Vec3::Zero(), v = base::Vec3::UnitX();
};

/// From `a` to `b`, which differ.
PluckerLine LineThrough(const base::Vec3& a, const base::Vec3& b);

/// Orthonormal representation (Bartoli and Sturm 2005; P4, eq. of its line parameters) as a block of parameters:
///   q_U (x y z w), φ:  n = cos φ U e₁,  v = sin φ U e₂;   tangent 4: U Exp(δ), φ + δφ.
/// Four numbers move it, as a line has four degrees of freedom; no line is singular but those through the origin and
/// at infinity, where φ reaches its ends.
inline constexpr int kLineSize = 5, kLineTangent = 4;
void SetLine(const PluckerLine& line, double* x);
PluckerLine LineAt(const double* x);
void LinePlus(const double* x, const double* delta, double* out);

/// Derivatives of n and v by the tangent.
using Mat34 = Eigen::Matrix<double, 3, 4>;
void LineJacobians(const double* x, Mat34& n_by, Mat34& v_by);

/// The line's point that is nearest to `p`.
base::Vec3 NearestOn(const PluckerLine& line, const base::Vec3& p);
/// Along the line, the place that is seen along a ray from `origin`: where the two are nearest. None where they are
/// parallel.
std::optional<base::Vec3> SeenAlong(const PluckerLine& line, const base::Vec3& origin, const base::Vec3& ray);

/// How well a line is known: 1σ of its direction (rad) and of its place across itself near a point (m), the worse way.
struct LineSpread {
  double direction = 0.0, place = 0.0;
};
/// From the information on its tangent, near p; none where that is singular.
std::optional<LineSpread> SpreadOf(const double* x, const Eigen::Matrix4d& information, const base::Vec3& p);

}  // namespace alula::stack::estimation

#include "sim/truth.h"

#include <algorithm>

namespace alula::sim {

vehicles::BodyState TruthWindow::At(base::Time t) const {
  const double h = (end - begin).Seconds();
  if (t >= end || h <= 0.0) return at_end;
  if (t <= begin) return at_begin;
  const double s = (t - begin).Seconds() / h;
  const double s2 = s * s, s3 = s2 * s;
  const base::Quat& q0 = at_begin.X_WB.q;
  vehicles::BodyState state;
  state.X_WB.p = (2 * s3 - 3 * s2 + 1) * at_begin.X_WB.p + (s3 - 2 * s2 + s) * h * at_begin.v_WB +
                 (3 * s2 - 2 * s3) * at_end.X_WB.p + (s3 - s2) * h * at_end.v_WB;
  state.X_WB.q = (q0 * base::Exp(s * base::Log(q0.conjugate() * at_end.X_WB.q))).normalized();
  state.v_WB = (1 - s) * at_begin.v_WB + s * at_end.v_WB;
  state.w_B = (1 - s) * at_begin.w_B + s * at_end.w_B;
  return state;
}

}  // namespace alula::sim

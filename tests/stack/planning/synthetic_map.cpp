#include "tests/stack/planning/synthetic_map.h"

#include <algorithm>
#include <cmath>

namespace alula::tests {

using base::Vec3;
using stack::mapping::CellState;
namespace mapping = stack::mapping;

namespace {

mapping::GridShape Shape(const Vec3& low_O, const Vec3& high_O, double cell) {
  mapping::GridShape shape;
  shape.low_O = low_O;
  shape.cell = cell;
  for (int a = 0; a < 3; ++a) {
    shape.size[static_cast<std::size_t>(a)] = static_cast<int>(std::lround((high_O[a] - low_O[a]) / cell));
  }
  return shape;
}

}  // namespace

SyntheticMap::SyntheticMap(const Vec3& low_O, const Vec3& high_O, double cell)
    : shape_(Shape(low_O, high_O, cell)),
      occupied_(shape_.count(), false),
      state_(shape_.count(), CellState::kUnknown),
      transform_(shape_, mapping::ClearanceField{}.max_clearance) {
  field_.shape = shape_;
  field_.to_occupied.assign(shape_.count(), 255);
  field_.to_not_free.assign(shape_.count(), 0);
}

void SyntheticMap::Reveal(int i, int j, int k) {
  const std::size_t index = shape_.Index(i, j, k);
  const CellState state = occupied_[index] ? CellState::kOccupied : CellState::kFree;
  if (state_[index] == state) return;
  state_[index] = state;
  changed_.Add(i, j, k);
}

void SyntheticMap::AddBox(const base::Transform& X_OA, const Vec3& half_extents) {
  const base::Transform X_AO = X_OA.Inverse();
  for (int i = 0; i < shape_.size[0]; ++i) {
    for (int j = 0; j < shape_.size[1]; ++j) {
      for (int k = 0; k < shape_.size[2]; ++k) {
        const Vec3 p = X_AO * shape_.Centre(i, j, k);
        if ((p.cwiseAbs().array() <= half_extents.array()).all()) occupied_[shape_.Index(i, j, k)] = true;
      }
    }
  }
}

void SyntheticMap::AddGate(const base::Transform& X_OG, double opening, double bar) {
  const double middle = 0.5 * (opening + bar);
  const double long_half = 0.5 * opening + bar;
  for (const double side : {-1.0, 1.0}) {
    AddBox(X_OG * base::Transform{base::Quat::Identity(), {0, side * middle, 0}}, {0.5 * bar, 0.5 * bar, long_half});
    AddBox(X_OG * base::Transform{base::Quat::Identity(), {0, 0, side * middle}}, {0.5 * bar, long_half, 0.5 * bar});
  }
}

void SyntheticMap::RevealAll() { RevealBox(shape_.low_O, shape_.high_O()); }

void SyntheticMap::RevealBox(const Vec3& low_O, const Vec3& high_O) {
  for (int i = 0; i < shape_.size[0]; ++i) {
    for (int j = 0; j < shape_.size[1]; ++j) {
      for (int k = 0; k < shape_.size[2]; ++k) {
        const Vec3 p = shape_.Centre(i, j, k);
        if ((p.array() < low_O.array()).any() || (p.array() > high_O.array()).any()) continue;
        Reveal(i, j, k);
      }
    }
  }
}

void SyntheticMap::Look(const base::Transform& X_OB, double range) {
  constexpr double kRayStep = 0.021;  // rad: 9 cm at 4.5 m
  for (double azimuth = -0.69; azimuth <= 0.69; azimuth += kRayStep) {
    for (double elevation = -0.55; elevation <= 0.55; elevation += kRayStep) {
      const Vec3 ray = X_OB.q * Vec3(1.0, std::tan(azimuth), std::tan(elevation)).normalized();
      for (double s = 0.0; s < range; s += 0.5 * shape_.cell) {
        const auto cell = shape_.CellOf(X_OB.p + s * ray);
        if (!shape_.Contains(cell[0], cell[1], cell[2])) break;
        Reveal(cell[0], cell[1], cell[2]);
        if (occupied_[shape_.Index(cell[0], cell[1], cell[2])]) break;
      }
    }
  }
}

std::shared_ptr<const mapping::ClearanceField> SyntheticMap::Snapshot() {
  const auto occupied = [](CellState s) { return s == CellState::kOccupied; };
  transform_.Update(state_, changed_, occupied, field_.to_occupied);
  transform_.Update(
      state_, changed_, [](CellState s) { return s != CellState::kFree; }, field_.to_not_free);
  changed_ = {};
  field_.revision = ++revision_;
  return std::make_shared<const mapping::ClearanceField>(field_);
}

bool SyntheticMap::Occupied(const Vec3& p_O) const {
  const auto cell = shape_.CellOf(p_O);
  return shape_.Contains(cell[0], cell[1], cell[2]) && occupied_[shape_.Index(cell[0], cell[1], cell[2])];
}

double SyntheticMap::TrueDistance(const Vec3& p_O, double limit) const {
  const auto centre = shape_.CellOf(p_O);
  const int reach = static_cast<int>(std::ceil(limit / shape_.cell)) + 1;
  double best = limit;
  for (int i = centre[0] - reach; i <= centre[0] + reach; ++i) {
    for (int j = centre[1] - reach; j <= centre[1] + reach; ++j) {
      for (int k = centre[2] - reach; k <= centre[2] + reach; ++k) {
        if (!shape_.Contains(i, j, k) || !occupied_[shape_.Index(i, j, k)]) continue;
        const Vec3 d = ((p_O - shape_.Centre(i, j, k)).cwiseAbs().array() - 0.5 * shape_.cell).max(0.0);
        best = std::min(best, d.norm());
      }
    }
  }
  return best;
}

}  // namespace alula::tests

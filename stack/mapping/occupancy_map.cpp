#include "stack/mapping/occupancy_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "stack/mapping/internal/distance_transform.h"
#include "stack/mapping/internal/frame_evidence.h"

namespace alula::stack::mapping {

namespace {

constexpr double kUnit = 1.0 / 1000;  // of the stored log-odds
constexpr std::int16_t kUnseen = std::numeric_limits<std::int16_t>::min();
constexpr double kCertain = 30.0;  // log-odds beyond any clamp
constexpr double kMaxCells = 64e6;

GridShape MakeShape(double cell, const base::Vec3& low_O, const base::Vec3& high_O) {
  GridShape shape;
  shape.cell = cell;
  double count = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    // Faces at whole multiples of the cell, as OctoMap has them; a hair's breadth is not another cell.
    const double low = std::floor(low_O[axis] / cell + 1e-6);
    const double high = std::ceil(high_O[axis] / cell - 1e-6);
    count *= std::max(0.0, high - low);
    if (!(high > low) || !(count <= kMaxCells)) {
      throw base::InputError("occupancy map: the box must be larger than a cell and hold at most 64 million cells");
    }
    shape.low_O[axis] = low * cell;
    shape.size[axis] = static_cast<int>(high - low);
  }
  return shape;
}

std::int16_t Stored(double log_odds) { return static_cast<std::int16_t>(std::lround(log_odds / kUnit)); }

}  // namespace

void Describe(base::Description& d, OccupancyMapConfig& c) {
  d.Field("cell", c.cell, {.unit = "m", .meaning = "side of a cell", .min = 0.01, .max = 2});
  d.Field("max_range", c.max_range, {.unit = "m", .meaning = "depth up to which is mapped", .min = 0.1, .max = 100});
  d.Field("disparity_sigma", c.disparity_sigma,
          {.meaning = "1σ of a disparity, px of the depth map", .min = 0.01, .max = 10});
  d.Field("free_sigmas", c.free_sigmas, {.meaning = "rays are free to z − this·σ_z", .min = 0, .max = 10});
  d.Field("free_share_min", c.free_share_min, {.meaning = "… but at least to this share of z", .min = 0, .max = 1});
  d.Field("hit", c.hit, {.meaning = "log-odds of a near hit", .min = 0.01, .max = 10});
  d.Field("miss", c.miss, {.meaning = "log-odds taken by a crossing ray", .min = 0.01, .max = 10});
  d.Field("max_log_odds", c.max_log_odds, {.meaning = "clamp of occupied cells", .min = 0.1, .max = 12});
  d.Field("min_log_odds", c.min_log_odds, {.meaning = "clamp of free cells", .min = -12, .max = -0.1});
  d.Field("occupied_from", c.occupied_from, {.meaning = "log-odds from which a cell is occupied", .min = 0, .max = 10});
  d.Field("free_below", c.free_below, {.meaning = "log-odds up to which a cell is free", .min = -10, .max = 0});
  d.Field("guard_sigmas", c.guard_sigmas,
          {.meaning = "nothing is carved within this·σ_z of a hit along its ray", .min = 0, .max = 10});
  d.Field("min_hit_share", c.min_hit_share,
          {.meaning = "share of a facing cell's pixels that a hit needs", .min = 0, .max = 1});
  d.Field("doubt", c.doubt,
          {.meaning = "log-odds taken where a near look finds nothing to match", .min = 0, .max = 10});
  d.Field("doubt_range", c.doubt_range, {.unit = "m", .meaning = "what counts as near there", .min = 0, .max = 100});
  d.Field("doubt_below", c.doubt_below,
          {.meaning = "log-odds above which a cell is not doubted so", .min = 0, .max = 12});
  d.Field("max_clearance", c.max_clearance,
          {.unit = "m", .meaning = "where distances to obstacles are cut", .min = 0.05, .max = 10});
  d.Check("max_clearance",
          [&c] { return c.max_clearance <= 34 * c.cell ? "" : "must be at most 34 cells; raise cell or lower this"; });
}

struct OccupancyMap::Impl {
  Impl(const OccupancyMapConfig& c, const GridShape& shape)
      : config(c), log_odds(shape.count(), kUnseen), evidence(shape), transform(shape, c.max_clearance) {
    field.shape = shape;
    field.max_clearance = c.max_clearance;
    state.assign(shape.count(), CellState::kUnknown);
    field.to_occupied.assign(shape.count(), 255);
    field.to_not_free.assign(shape.count(), 0);
    occupied_from = Stored(c.occupied_from);
    free_below = Stored(c.free_below);
  }

  void Raise(std::size_t cell, double by, double limit);
  void Lower(std::size_t cell, double by, double limit);
  void Doubt(std::size_t cell);
  void Classify(std::size_t cell);
  void Changed();
  const ClearanceField& UpToDate();

  OccupancyMapConfig config;
  std::vector<std::int16_t> log_odds;  // kUnit
  std::vector<CellState> state;
  internal::FrameEvidence evidence;
  internal::DistanceTransform transform;
  ClearanceField field;
  std::int16_t occupied_from = 0;
  std::int16_t free_below = 0;
  internal::CellBox occupied_changed;
  internal::CellBox free_changed;
  mutable std::shared_ptr<const ClearanceField> snapshot;
};

void OccupancyMap::Impl::Raise(std::size_t cell, double by, double limit) {
  const int now = log_odds[cell] == kUnseen ? 0 : log_odds[cell];
  // Weak evidence may lift a cell up to its own limit, and never pulls down what stands above it.
  const int raised = std::min<int>(now + Stored(by), std::max<int>(now, Stored(limit)));
  log_odds[cell] = static_cast<std::int16_t>(raised);
  Classify(cell);
}

void OccupancyMap::Impl::Lower(std::size_t cell, double by, double limit) {
  const int now = log_odds[cell] == kUnseen ? 0 : log_odds[cell];
  const int lowered = std::max<int>(now - Stored(by), std::min<int>(now, Stored(limit)));
  log_odds[cell] = static_cast<std::int16_t>(lowered);
  Classify(cell);
}

/// Stereo invents surfaces in a plain sky between two edges. One that only far views have shown goes back to unknown
/// when near views, which would match a real surface, keep finding nothing there.
void OccupancyMap::Impl::Doubt(std::size_t cell) {
  const std::int16_t value = log_odds[cell];
  if (value > 0 && value <= Stored(config.doubt_below)) Lower(cell, config.doubt, 0.0);
}

void OccupancyMap::Impl::Classify(std::size_t cell) {
  const std::int16_t value = log_odds[cell];
  CellState now = CellState::kUnknown;
  if (value != kUnseen && value >= occupied_from) now = CellState::kOccupied;
  if (value != kUnseen && value <= free_below) now = CellState::kFree;
  const CellState before = state[cell];
  if (now == before) return;
  state[cell] = now;
  const auto& size = field.shape.size;
  const int k = static_cast<int>(cell % size[2]);
  const int j = static_cast<int>(cell / size[2] % size[1]);
  const int i = static_cast<int>(cell / size[2] / size[1]);
  if ((now == CellState::kOccupied) != (before == CellState::kOccupied)) occupied_changed.Add(i, j, k);
  if ((now == CellState::kFree) != (before == CellState::kFree)) free_changed.Add(i, j, k);
}

void OccupancyMap::Impl::Changed() {
  ++field.revision;
  snapshot.reset();
}

/// The distances are computed when they are asked for, once for all changes since.
const ClearanceField& OccupancyMap::Impl::UpToDate() {
  transform.Update(
      state, occupied_changed, [](CellState s) { return s == CellState::kOccupied; }, field.to_occupied);
  transform.Update(
      state, free_changed, [](CellState s) { return s != CellState::kFree; }, field.to_not_free);
  occupied_changed = {};
  free_changed = {};
  return field;
}

OccupancyMap::OccupancyMap(const OccupancyMapConfig& config, const base::Vec3& low_O, const base::Vec3& high_O)
    : impl_(std::make_unique<Impl>(config, MakeShape(config.cell, low_O, high_O))) {}
OccupancyMap::~OccupancyMap() = default;
OccupancyMap::OccupancyMap(OccupancyMap&&) noexcept = default;
OccupancyMap& OccupancyMap::operator=(OccupancyMap&&) noexcept = default;

void OccupancyMap::Insert(const DepthMap& depth, const base::Transform& X_OC) {
  const OccupancyMapConfig& c = impl_->config;
  impl_->evidence.Collect(c, depth, X_OC);
  for (const std::size_t cell : impl_->evidence.crossed()) impl_->Lower(cell, c.miss, c.min_log_odds);
  for (const std::size_t cell : impl_->evidence.doubted()) impl_->Doubt(cell);
  for (const auto& hit : impl_->evidence.hits()) {
    const double sharpness = internal::FrameEvidence::Sharpness(c, depth, hit.depth);
    // A far hit reaches just above the threshold, so that one near ray through the cell clears it.
    const double limit = std::max(c.max_log_odds * sharpness, c.occupied_from + 0.1);
    impl_->Raise(hit.cell, c.hit * sharpness, limit);
  }
  impl_->Changed();
}

void OccupancyMap::DeclareFree(const base::Vec3& base_O, double radius, double height) {
  const GridShape& shape = impl_->field.shape;
  for (int i = 0; i < shape.size[0]; ++i) {
    for (int j = 0; j < shape.size[1]; ++j) {
      const base::Vec3 foot_O = shape.Centre(i, j, 0);
      if ((foot_O - base_O).head<2>().norm() > radius) continue;
      for (int k = 0; k < shape.size[2]; ++k) {
        const double z = shape.Centre(i, j, k).z();
        const std::size_t cell = shape.Index(i, j, k);
        if (z < base_O.z() || z > base_O.z() + height || impl_->state[cell] == CellState::kOccupied) continue;
        impl_->Lower(cell, kCertain, impl_->config.min_log_odds);
      }
    }
  }
  impl_->Changed();
}

void OccupancyMap::DeclareFreeBox(const base::Transform& X_OG, const base::Vec3& half_extents) {
  const GridShape& shape = impl_->field.shape;
  const base::Transform X_GO = X_OG.Inverse();
  const base::Vec3 reach = base::Vec3::Constant(half_extents.norm());
  const auto low = shape.CellOf(X_OG.p - reach);
  const auto high = shape.CellOf(X_OG.p + reach);
  for (int i = std::max(0, low[0]); i <= std::min(high[0], shape.size[0] - 1); ++i) {
    for (int j = std::max(0, low[1]); j <= std::min(high[1], shape.size[1] - 1); ++j) {
      for (int k = std::max(0, low[2]); k <= std::min(high[2], shape.size[2] - 1); ++k) {
        const base::Vec3 p_G = X_GO * shape.Centre(i, j, k);
        const std::size_t cell = shape.Index(i, j, k);
        if ((p_G.cwiseAbs().array() > half_extents.array()).any()) continue;
        if (impl_->state[cell] == CellState::kUnknown) impl_->Lower(cell, kCertain, impl_->config.free_below);
      }
    }
  }
  impl_->Changed();
}

CellState OccupancyMap::State(const base::Vec3& p_O) const { return impl_->UpToDate().State(p_O); }
double OccupancyMap::Clearance(const base::Vec3& p_O) const { return impl_->UpToDate().Clearance(p_O); }
double OccupancyMap::KnownFreeClearance(const base::Vec3& p_O) const {
  return impl_->UpToDate().KnownFreeClearance(p_O);
}

double OccupancyMap::LogOdds(const base::Vec3& p_O) const {
  const auto [i, j, k] = shape().CellOf(p_O);
  if (!shape().Contains(i, j, k)) return 0.0;
  const std::int16_t value = impl_->log_odds[shape().Index(i, j, k)];
  return value == kUnseen ? 0.0 : value * kUnit;
}

std::shared_ptr<const ClearanceField> OccupancyMap::Snapshot() const {
  if (!impl_->snapshot) impl_->snapshot = std::make_shared<const ClearanceField>(impl_->UpToDate());
  return impl_->snapshot;
}

std::vector<Eigen::Vector3f> OccupancyMap::OccupiedCells() const {
  std::vector<Eigen::Vector3f> cells;
  const GridShape& grid = shape();
  const std::size_t column = static_cast<std::size_t>(grid.size[2]);
  const CellState* cell = impl_->state.data();
  for (int i = 0; i < grid.size[0]; ++i) {
    for (int j = 0; j < grid.size[1]; ++j, cell += column) {
      // Most columns hold none, and memchr looks at many cells at once.
      const void* found = std::memchr(cell, static_cast<int>(CellState::kOccupied), column);
      while (found != nullptr) {
        const std::ptrdiff_t k = static_cast<const CellState*>(found) - cell;
        cells.push_back(grid.Centre(i, j, static_cast<int>(k)).cast<float>());
        found =
            std::memchr(cell + k + 1, static_cast<int>(CellState::kOccupied), column - static_cast<std::size_t>(k) - 1);
      }
    }
  }
  return cells;
}

std::uint64_t OccupancyMap::revision() const { return impl_->field.revision; }
const GridShape& OccupancyMap::shape() const { return impl_->field.shape; }
const OccupancyMapConfig& OccupancyMap::config() const { return impl_->config; }

}  // namespace alula::stack::mapping

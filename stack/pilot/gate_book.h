#pragma once

#include <optional>
#include <vector>

#include "base/frames.h"
#include "stack/interface/mission.h"
#include "stack/perception/gate_finder.h"
#include "stack/pilot/gate_mission_config.h"
#include "stack/pilot/map_alignment.h"

namespace alula::stack::pilot {

/// Where each gate is believed to be, and how well that is known: the list at first, then what was measured.
class GateBook {
 public:
  GateBook(const Mission& mission, const GateMissionConfig& config, const MapAlignmentConfig& alignment);

  /// Takes the newest fits (one entry a gate); frozen gates keep theirs. Aligns the map frame anew.
  void Update(const std::vector<std::optional<perception::GateObservation>>& fits);
  /// The frame leaves the view: what is known now is kept.
  void Freeze(int gate) { entries_[static_cast<std::size_t>(gate)].frozen = true; }
  /// A look in vain: from now on a coarse fit is enough.
  void AcceptCoarse(int gate) { entries_[static_cast<std::size_t>(gate)].coarse_will_do = true; }
  /// The last resort: the listed place counts as measured.
  void TrustList(int gate) { entries_[static_cast<std::size_t>(gate)].from_list = true; }

  int size() const { return static_cast<int>(entries_.size()); }
  /// Measured where it was, else as listed and aligned.
  base::Transform X_OG(int gate) const;
  double opening(int gate) const { return mission_.gates[static_cast<std::size_t>(gate)].opening; }
  /// Known well enough to be entered.
  bool Good(int gate) const;
  bool Measured(int gate) const { return entries_[static_cast<std::size_t>(gate)].fit.has_value(); }
  bool Frozen(int gate) const { return entries_[static_cast<std::size_t>(gate)].frozen; }
  const std::optional<perception::GateObservation>& Fit(int gate) const {
    return entries_[static_cast<std::size_t>(gate)].fit;
  }
  const base::Transform& X_MO() const { return X_MO_; }

 private:
  struct Entry {
    std::optional<perception::GateObservation> fit;
    bool good = false;  // stays so
    bool frozen = false;
    bool coarse_will_do = false;
    bool from_list = false;
  };
  void Align();

  Mission mission_;
  GateMissionConfig config_;
  MapAlignmentConfig alignment_;
  std::vector<Entry> entries_;
  base::Transform X_MO_;
};

}  // namespace alula::stack::pilot

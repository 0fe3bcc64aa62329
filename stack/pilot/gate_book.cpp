#include "stack/pilot/gate_book.h"

namespace alula::stack::pilot {

GateBook::GateBook(const Mission& mission, const GateMissionConfig& config, const MapAlignmentConfig& alignment)
    : mission_(mission), config_(config), alignment_(alignment), entries_(mission.gates.size()) {}

void GateBook::Update(const std::vector<std::optional<perception::GateObservation>>& fits) {
  if (config_.trust_gate_list) return;
  for (std::size_t i = 0; i < entries_.size() && i < fits.size(); ++i) {
    Entry& entry = entries_[i];
    if (entry.frozen || !fits[i]) continue;
    entry.fit = fits[i];
    const bool fine = fits[i]->position_sigma <= config_.good_sigma && fits[i]->nearest <= config_.good_range;
    const bool coarse = entry.coarse_will_do && fits[i]->position_sigma <= config_.coarse_sigma;
    entry.good = entry.good || fine || coarse;
  }
  Align();
}

void GateBook::Align() {
  std::vector<AlignmentPair> pairs;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (!entries_[i].good || !entries_[i].fit) continue;
    pairs.push_back({mission_.gates[i].X_WG.p, entries_[i].fit->X_OG.p, entries_[i].fit->position_sigma});
  }
  const double position_sigma =
      mission_.start_position_sigma > 0.0 ? mission_.start_position_sigma : alignment_.start_position_sigma;
  const double yaw_sigma = mission_.start_yaw_sigma > 0.0 ? mission_.start_yaw_sigma : alignment_.start_yaw_sigma;
  X_MO_ = AlignMap(pairs, mission_.X_WB_start.p, position_sigma, yaw_sigma, alignment_);
}

base::Transform GateBook::X_OG(int gate) const {
  const Entry& entry = entries_[static_cast<std::size_t>(gate)];
  if (entry.fit) return entry.fit->X_OG;
  return X_MO_.Inverse() * mission_.gates[static_cast<std::size_t>(gate)].X_WG;
}

bool GateBook::Good(int gate) const {
  const Entry& entry = entries_[static_cast<std::size_t>(gate)];
  return config_.trust_gate_list || entry.good || entry.from_list;
}

}  // namespace alula::stack::pilot

#include "stack/features/descriptor.h"

#include <limits>

#include "stack/features/internal/orb_kernels.h"

namespace alula::stack::features {

void HammingDistances(const Descriptor& query, std::span<const Descriptor> table, std::span<std::uint16_t> distances) {
  internal::ChooseOrbKernels().distances(query.data(), table.empty() ? nullptr : table.data()->data(), table.size(),
                                         distances.data());
}

std::vector<DescriptorMatch> MatchDescriptors(std::span<const Descriptor> a, std::span<const Descriptor> b,
                                              const MatchConfig& config) {
  constexpr int kNone = std::numeric_limits<int>::max();
  struct Nearest {
    int distance = kNone;
    std::size_t of = 0;
  };
  std::vector<Nearest> of_b(b.size());
  std::vector<DescriptorMatch> matches;
  std::vector<std::uint16_t> distances(b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    HammingDistances(a[i], b, distances);
    int best = kNone, second = kNone;
    std::size_t at = 0;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int d = distances[j];
      if (d < of_b[j].distance) of_b[j] = {d, i};
      if (d < best) {
        second = best;
        best = d;
        at = j;
      } else if (d < second) {
        second = d;
      }
    }
    if (best > config.max_distance) continue;
    if (second != kNone && best >= config.ratio * second && config.ratio < 1.0) continue;
    matches.push_back({static_cast<int>(i), static_cast<int>(at), best});
  }
  if (config.mutual) {
    std::erase_if(matches, [&](const DescriptorMatch& m) {
      return of_b[static_cast<std::size_t>(m.b)].of != static_cast<std::size_t>(m.a);
    });
  }
  return matches;
}

}  // namespace alula::stack::features

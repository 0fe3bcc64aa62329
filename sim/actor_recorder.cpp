#include "sim/actor_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace alula::sim {

ActorRecorder::ActorRecorder(base::Rate rate, const worlds::World& world, const RunFolder& folder)
    : rate_(rate), world_(world), file_(folder.PathOf("actors.csv")) {
  file_.Write("time_s,link,x_m,y_m,z_m,qw,qx,qy,qz\n");
}

std::optional<std::string> ActorRecorder::Observe(const StepView& step) {
  if (rate_.SampleTime(n_) > step.time) return std::nullopt;
  while (rate_.SampleTime(n_) <= step.time) ++n_;
  lines_.clear();
  auto out = std::back_inserter(lines_);
  for (std::size_t i = 0; i < world_.actors.size(); ++i) {
    const std::vector<worlds::ActorLink>& links = world_.actors[i].links;
    const auto collides = [](const worlds::ActorLink& link) { return link.collides; };
    if (std::none_of(links.begin(), links.end(), collides)) continue;
    X_WL_.resize(links.size());
    step.actors.PlaceLinks(i, step.time, X_WL_);
    for (std::size_t k = 0; k < links.size(); ++k) {
      if (!links[k].collides) continue;
      const base::Transform& X = X_WL_[k];
      fmt::format_to(out, "{:.6f},{}/{},{:.4f},{:.4f},{:.4f},{:.6f},{:.6f},{:.6f},{:.6f}\n", step.time.Seconds(),
                     world_.actors[i].name, links[k].name, X.p.x(), X.p.y(), X.p.z(), X.q.w(), X.q.x(), X.q.y(),
                     X.q.z());
    }
  }
  file_.Write(lines_);
  return std::nullopt;
}

}  // namespace alula::sim

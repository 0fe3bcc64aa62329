#include "scenarios/slam/slam_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "scenarios/criteria/ate.h"
#include "sim/run_folder.h"

namespace alula::scenarios::slam {
namespace fs = std::filesystem;
namespace {

using nlohmann::ordered_json;
using stack::slam::StampedPose;

/// The truth at a time, between its neighbours; none outside.
std::optional<base::Transform> TruthAt(const std::vector<StampedPose>& truth, base::Time time) {
  const auto it = std::lower_bound(truth.begin(), truth.end(), time,
                                   [](const StampedPose& pose, base::Time t) { return pose.stamp < t; });
  if (it == truth.end() || (it == truth.begin() && it->stamp != time)) return std::nullopt;
  if (it->stamp == time) return it->X_MB;
  const StampedPose& before = *(it - 1);
  const double share = (time - before.stamp).Seconds() / (it->stamp - before.stamp).Seconds();
  return base::Transform{before.X_MB.q.slerp(share, it->X_MB.q), before.X_MB.p + share * (it->X_MB.p - before.X_MB.p)};
}

ordered_json FiguresOf(const std::vector<StampedPose>& estimate, const std::vector<StampedPose>& truth) {
  FourDofAlignment pairs;
  for (const StampedPose& pose : estimate) {
    if (const auto at = TruthAt(truth, pose.stamp)) pairs.Add(pose.X_MB.p, at->p);
  }
  ordered_json out;
  out["poses"] = estimate.size();
  if (pairs.count() > 0) {
    out["ate_4dof_m"] = pairs.AlignedRmse();
    out["ate_unaligned_m"] = pairs.UnalignedRmse();
  }
  return out;
}

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::string Tum(const std::vector<StampedPose>& poses) {
  std::string text;
  for (const StampedPose& pose : poses) {
    const base::Transform& X = pose.X_MB;
    text += fmt::format("{:.9f} {:.6f} {:.6f} {:.6f} {:.8f} {:.8f} {:.8f} {:.8f}\n", pose.stamp.Seconds(), X.p.x(),
                        X.p.y(), X.p.z(), X.q.x(), X.q.y(), X.q.z(), X.q.w());
  }
  return text;
}

}  // namespace

SlamReport Judge(const std::string& name, std::uint64_t seed, std::vector<EstimatorResult> results,
                 std::vector<StampedPose> truth) {
  return {name, seed, std::move(results), std::move(truth)};
}

void WriteFiles(const SlamReport& report, const fs::path& folder) {
  sim::RunFolder out(folder);
  if (!report.truth.empty()) out.Write("truth.tum", Tum(report.truth));
  for (const EstimatorResult& result : report.results) {
    fs::create_directories(out.PathOf(result.name));
    out.Write(result.name + "/estimate.tum", Tum(result.online));
    out.Write(result.name + "/estimate_final.tum", Tum(result.finished));
  }
  out.Write("slam.json", ToJson(report).dump(2) + "\n");
  out.Commit();
}

ordered_json ToJson(const SlamReport& report) {
  ordered_json json;
  json["name"] = report.name;
  json["seed"] = report.seed;
  ordered_json& all = json["estimators"] = ordered_json::array();
  for (const EstimatorResult& result : report.results) {
    ordered_json one;
    one["name"] = result.name;
    one["frames"] = result.frames.size();
    one["online"] = FiguresOf(result.online, report.truth);
    one["final"] = FiguresOf(result.finished, report.truth);
    one["frame_median_ms"] = Quantile(result.frame_ms, 0.5);
    one["frame_p99_ms"] = Quantile(result.frame_ms, 0.99);
    one["finish_ms"] = result.finish_ms;
    one["resets"] = result.resets;
    one["notes"] = result.notes;
    all.push_back(std::move(one));
  }
  return json;
}

std::string ToTable(const ordered_json& report) {
  std::string text = fmt::format("{} (seed {})\n", report["name"].get<std::string>(), report["seed"].get<std::uint64_t>());
  for (const ordered_json& one : report["estimators"]) {
    const auto number = [&one](const char* which, const char* key) {
      return one[which].contains(key) ? fmt::format("{:.3f}", one[which][key].get<double>()) : std::string("-");
    };
    text += fmt::format("  {:12} ATE online {} final {} m; unaligned {} / {}; poses {} of {}; {:.1f} ms, p99 {:.1f}; resets {}\n",
                        one["name"].get<std::string>(), number("online", "ate_4dof_m"), number("final", "ate_4dof_m"),
                        number("online", "ate_unaligned_m"), number("final", "ate_unaligned_m"),
                        one["online"]["poses"].get<std::size_t>(), one["frames"].get<std::size_t>(),
                        one["frame_median_ms"].get<double>(), one["frame_p99_ms"].get<double>(),
                        one["resets"].get<int>());
    for (const auto& note : one["notes"]) text += fmt::format("    {}\n", note.get<std::string>());
  }
  return text;
}

}  // namespace alula::scenarios::slam

#include "scenarios/slam/slam_report.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "scenarios/trajectory/trajectory_report.h"
#include "sim/run_folder.h"

namespace alula::scenarios::slam {
namespace fs = std::filesystem;
namespace {

using nlohmann::ordered_json;

/// All figures of an estimator, as numbers with names.
ordered_json FiguresOf(const EstimatorResult& result, const SlamReport& report) {
  const trajectory::ReportRequest request{result.frames, false};
  ordered_json figures;
  for (const auto& [name, poses] : {std::pair{"online", &result.online}, std::pair{"final", &result.finished}}) {
    const trajectory::NamedReport named{name, trajectory::Judge(*poses, report.truth, request)};
    for (const auto& [key, value] : trajectory::MetricsOf(named)) figures[key] = value;
  }
  return figures;
}

void AddTimes(const std::string& name, const std::vector<double>& ms, ordered_json& figures) {
  if (ms.empty()) return;
  const trajectory::Statistics times = trajectory::StatisticsOf(ms);
  figures[name + "_mean_ms"] = times.mean;
  figures[name + "_median_ms"] = times.median;
  figures[name + "_p99_ms"] = times.p99;
}

std::string Tum(const std::vector<base::StampedPose>& poses) {
  std::string text;
  for (const base::StampedPose& pose : poses) text += base::TumRow(pose);
  return text;
}

}  // namespace

SlamReport Judge(const std::string& name, std::uint64_t seed, std::vector<EstimatorResult> results,
                 std::vector<base::StampedPose> truth) {
  return {name, seed, std::move(results), std::move(truth)};
}

void WriteFiles(const SlamReport& report, const fs::path& folder) {
  sim::RunFolder out(folder);
  if (!report.truth.empty()) out.Write("truth.tum", Tum(report.truth));
  for (const EstimatorResult& result : report.results) {
    fs::create_directories(out.PathOf(result.name));
    out.Write(result.name + "/estimate.tum", Tum(result.online));
    out.Write(result.name + "/estimate_final.tum", Tum(result.finished));
    if (!result.map.empty()) out.Write(result.name + "/map.alula", std::string(result.map.begin(), result.map.end()));
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
    ordered_json figures = FiguresOf(result, report);
    figures["images"] = result.frames.size();
    figures["resets"] = result.resets;
    figures["loops"] = result.loops;
    figures["joins"] = result.joins;
    AddTimes("frame", result.frame_ms, figures);
    AddTimes("keyframe", result.keyframe_ms, figures);
    figures["finish_ms"] = result.finish_ms;
    all.push_back({{"name", result.name}, {"figures", std::move(figures)}, {"notes", result.notes}});
  }
  return json;
}

std::string ToTable(const ordered_json& report) {
  constexpr std::array<std::array<const char*, 3>, 13> kColumns{{{"ATE online", "ate_online_m", "m"},
                                                                 {"final", "ate_final_m", "m"},
                                                                 {"SE(3) onl.", "ate_se3_online_m", "m"},
                                                                 {"final", "ate_se3_final_m", "m"},
                                                                 {"as is onl.", "ate_unaligned_online_m", "m"},
                                                                 {"final", "ate_unaligned_final_m", "m"},
                                                                 {"complete", "completeness_online", ""},
                                                                 {"resets", "resets", ""},
                                                                 {"loops", "loops", ""},
                                                                 {"joins", "joins", ""},
                                                                 {"frame", "frame_median_ms", "ms"},
                                                                 {"p99", "frame_p99_ms", "ms"},
                                                                 {"mean", "frame_mean_ms", "ms"}}};
  std::string text =
      fmt::format("{}, seed {}\n  {:16}", report["name"].get<std::string>(), report["seed"].get<std::uint64_t>(), "");
  for (const auto& [title, key, unit] : kColumns) text += fmt::format(" {:>10}", title);
  text += fmt::format("\n  {:16}", "");
  for (const auto& [title, key, unit] : kColumns) text += fmt::format(" {:>10}", unit);
  text += "\n";
  for (const ordered_json& one : report["estimators"]) {
    text += fmt::format("  {:16}", one["name"].get<std::string>());
    const ordered_json& figures = one["figures"];
    for (const auto& [title, key, unit] : kColumns) {
      if (!figures.contains(key)) {
        text += fmt::format(" {:>10}", "-");
      } else if (figures[key].is_number_integer()) {
        text += fmt::format(" {:>10}", figures[key].get<std::int64_t>());
      } else {
        text += fmt::format(" {:>10.3f}", figures[key].get<double>());
      }
    }
    text += "\n";
    for (const auto& note : one["notes"]) text += fmt::format("    said: {}\n", note.get<std::string>());
  }
  return text;
}

}  // namespace alula::scenarios::slam

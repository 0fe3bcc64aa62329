#include "scenarios/trajectory/trajectory_report.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

namespace alula::scenarios::trajectory {
namespace {

/// One figure: what a table calls it, what a metric is called (with {} for the trajectory's name), its unit and digits.
struct Figure {
  std::string_view label;
  std::string_view metric;
  std::string_view unit;
  int digits;
  std::function<double(const TrajectoryReport&)> value;
};

constexpr double kNotMeasured = std::numeric_limits<double>::infinity();

std::vector<Figure> CompletenessFigures() {
  using Report = TrajectoryReport;
  return {
      {"completeness", "completeness_{}", "", 4, [](const Report& r) { return r.completeness.share(); }},
      {"  until the first pose", "until_first_pose_{}_s", "s", 2,
       [](const Report& r) { return r.completeness.until_first.Seconds(); }},
      {"  longest gap", "longest_gap_{}_s", "s", 2,
       [](const Report& r) { return r.completeness.longest_gap.Seconds(); }},
  };
}

void AddAte(std::vector<Figure>& figures, std::string_view label, std::string_view metric,
            const std::function<const AbsoluteError*(const TrajectoryReport&)>& of) {
  const auto add = [&](std::string_view name, std::string_view key, double Statistics::*member) {
    figures.push_back({name, key, "m", 4, [of, member](const TrajectoryReport& r) {
                         const AbsoluteError* error = of(r);
                         return error == nullptr ? kNotMeasured : error->position.*member;
                       }});
  };
  add(label, metric, &Statistics::rmse);
  add("  mean", "", &Statistics::mean);
  add("  median", "", &Statistics::median);
  add("  largest", "", &Statistics::max);
}

void AddRpe(std::vector<Figure>& figures, std::string_view label, std::string_view metres, std::string_view degrees,
            std::string_view percent, RelativeError TrajectoryReport::*member) {
  figures.push_back({label, metres, "m", 4, [member](const auto& r) { return (r.*member).translation.rmse; }});
  figures.push_back({"  rotation", degrees, "deg", 3, [member](const auto& r) { return (r.*member).rotation.rmse; }});
  if (percent.empty()) return;
  figures.push_back(
      {"  of the way, mean", percent, "%", 3, [member](const auto& r) { return (r.*member).percent.mean; }});
}

std::vector<Figure> ErrorFigures() {
  using Report = TrajectoryReport;
  std::vector<Figure> figures = {
      {"path", "path_{}_m", "m", 2, [](const Report& r) { return r.path; }},
  };
  AddAte(figures, "ATE, 4-DoF aligned", "ate_{}_m", [](const Report& r) { return &r.yaw_aligned; });
  AddAte(figures, "ATE, SE(3) aligned", "ate_se3_{}_m", [](const Report& r) { return &r.rigidly_aligned; });
  AddAte(figures, "ATE, unaligned", "ate_unaligned_{}_m", [](const Report& r) { return &r.unaligned; });
  AddAte(figures, "ATE, Sim(3) aligned", "ate_sim3_{}_m",
         [](const Report& r) { return r.scaled ? &*r.scaled : nullptr; });
  AddRpe(figures, "RPE over 1 s", "rpe_1s_{}_m", "rpe_1s_{}_deg", "", &Report::second);
  AddRpe(figures, "RPE over 1 m", "rpe_1m_{}_m", "rpe_1m_{}_deg", "rpe_1m_{}_percent", &Report::metre);
  AddRpe(figures, "RPE over 10 m", "rpe_10m_{}_m", "rpe_10m_{}_deg", "rpe_10m_{}_percent", &Report::ten_metres);
  figures.push_back({"drift as KITTI counts it", "drift_{}_percent", "%", 3,
                     [](const Report& r) { return r.drift.ways > 0 ? r.drift.percent : kNotMeasured; }});
  figures.push_back({"  rotation", "drift_{}_deg_per_m", "deg/m", 5,
                     [](const Report& r) { return r.drift.ways > 0 ? r.drift.degrees_per_metre : kNotMeasured; }});
  figures.push_back(
      {"  ways from", "", "m", 0, [](const Report& r) { return r.drift.ways > 0 ? r.drift.unit : kNotMeasured; }});
  figures.push_back({"end error", "end_error_{}_m", "m", 3, [](const Report& r) { return r.end.metres; }});
  figures.push_back({"  of the path", "end_error_{}_percent", "%", 3, [](const Report& r) { return r.end.percent; }});
  return figures;
}

void AddRows(std::string& text, const std::vector<Figure>& figures, const std::vector<NamedReport>& reports) {
  bool shown = true;
  for (const Figure& figure : figures) {
    std::string row;
    bool measured = false;
    for (const NamedReport& named : reports) {
      const double value = figure.value(named.report);
      measured = measured || std::isfinite(value);
      row += std::isfinite(value) ? fmt::format("  {:>12.{}f}", value, figure.digits) : fmt::format("  {:>12}", "-");
    }
    // A figure that none has goes, and what stands below it.
    if (!figure.label.starts_with(' ')) shown = measured;
    if (shown && measured) text += fmt::format("  {:<26}{} {}\n", figure.label, row, figure.unit);
  }
}

}  // namespace

TrajectoryReport Judge(const std::vector<base::StampedPose>& estimate, const std::vector<base::StampedPose>& truth,
                       const ReportRequest& request) {
  TrajectoryReport report;
  report.completeness = CompletenessOf(request.images, estimate, truth);
  std::vector<PosePair> pairs = Associate(estimate, truth);
  report.pairs = static_cast<std::int64_t>(pairs.size());
  report.path = pairs.empty() ? 0.0 : PathOf(pairs).back();
  report.yaw_aligned = AbsoluteErrorOf(pairs, Freedom::kYaw);
  report.rigidly_aligned = AbsoluteErrorOf(pairs, Freedom::kRigid);
  report.unaligned = AbsoluteErrorOf(pairs, Freedom::kNone);
  if (request.scale_is_free) {
    report.scaled = AbsoluteErrorOf(pairs, Freedom::kSimilarity);
    pairs = Aligned(std::move(pairs), report.scaled->alignment);
  }
  report.second = RelativeErrorOverTime(pairs, base::Seconds(1.0));
  report.metre = RelativeErrorOverPath(pairs, 1.0);
  report.ten_metres = RelativeErrorOverPath(pairs, 10.0);
  report.drift = PathDriftOf(pairs);
  report.end = EndErrorOf(pairs);
  return report;
}

std::map<std::string, double> MetricsOf(const NamedReport& named) {
  std::map<std::string, double> metrics;
  const auto add = [&](const std::vector<Figure>& figures) {
    for (const Figure& figure : figures) {
      const double value = figure.value(named.report);
      if (figure.metric.empty() || !std::isfinite(value)) continue;
      metrics[fmt::format(fmt::runtime(figure.metric), named.name)] = value;
    }
  };
  add(CompletenessFigures());
  if (named.report.pairs > 0) add(ErrorFigures());
  return metrics;
}

std::string ToTable(const std::vector<NamedReport>& reports) {
  std::string text = fmt::format("  {:<26}", "");
  bool any = false;
  for (const NamedReport& named : reports) {
    text += fmt::format("  {:>12}", named.name);
    any = any || named.report.pairs > 0;
  }
  text += '\n';
  AddRows(text, CompletenessFigures(), reports);
  if (any) AddRows(text, ErrorFigures(), reports);
  return text;
}

}  // namespace alula::scenarios::trajectory

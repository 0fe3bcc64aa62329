#include "scenarios/check/row.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

namespace alula::scenarios::check {
namespace {

std::string Shown(double value) { return std::isfinite(value) ? fmt::format("{:.5g}", value) : "not measured"; }

nlohmann::ordered_json Number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace

Row Compare(std::string sensor, std::string quantity, double configured, double measured, double tolerance,
            std::string unit) {
  const bool passed = std::abs(measured - configured) <= tolerance;  // false for NaN
  return {std::move(sensor), std::move(quantity), configured, measured, tolerance, std::move(unit), passed};
}

void Report::Add(std::vector<Row> more) {
  rows.insert(rows.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

void Report::Note(const std::string& text) {
  if (std::find(notes.begin(), notes.end(), text) == notes.end()) notes.push_back(text);
}

bool Report::passed() const {
  return std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.passed; });
}

std::string ToTable(const Report& report) {
  std::string text = fmt::format("  {:<6}{:<31}{:<45}{:>13}{:>13}{:>13}  {}\n", "", "sensor", "quantity", "configured",
                                 "measured", "tolerance", "unit");
  for (const Row& row : report.rows) {
    text += fmt::format("  {:<6}{:<31}{:<45}{:>13}{:>13}{:>13}  {}\n", row.passed ? "ok" : "FAIL", row.sensor,
                        row.quantity, Shown(row.configured), Shown(row.measured), Shown(row.tolerance), row.unit);
  }
  for (const std::string& note : report.notes) text += "  note: " + note + "\n";
  const auto failed = std::count_if(report.rows.begin(), report.rows.end(), [](const Row& row) { return !row.passed; });
  text += failed == 0 ? fmt::format("{} quantities: all as configured\n", report.rows.size())
                      : fmt::format("{} of {} quantities differ from the configuration\n", failed, report.rows.size());
  return text;
}

std::string ToJson(const Report& report, const std::string& scenario) {
  nlohmann::ordered_json json;
  json["scenario"] = scenario;
  json["passed"] = report.passed();
  json["rows"] = nlohmann::ordered_json::array();
  for (const Row& row : report.rows) {
    json["rows"].push_back({{"sensor", row.sensor},
                            {"quantity", row.quantity},
                            {"configured", Number(row.configured)},
                            {"measured", Number(row.measured)},
                            {"tolerance", Number(row.tolerance)},
                            {"unit", row.unit},
                            {"passed", row.passed}});
  }
  json["notes"] = report.notes;
  return json.dump(2) + "\n";
}

}  // namespace alula::scenarios::check

#pragma once

#include <string>
#include <vector>

namespace alula::scenarios::check {

/// One quantity of one sensor: what the configuration says beside what its measurements say.
struct Row {
  std::string sensor;    // "vehicle0/camera.left"
  std::string quantity;  // "row delay"
  double configured = 0.0;
  double measured = 0.0;  // NaN: could not be measured, which fails
  double tolerance = 0.0;
  std::string unit;  // "1" for pure numbers
  bool passed = false;
};

/// Passes where |measured − configured| ≤ tolerance.
Row Compare(std::string sensor, std::string quantity, double configured, double measured, double tolerance,
            std::string unit);

/// All rows of a scenario's sensors, and what was left out or switched off for measuring.
struct Report {
  std::vector<Row> rows;
  std::vector<std::string> notes;

  void Add(Row row) { rows.push_back(std::move(row)); }
  void Add(std::vector<Row> more);
  /// Says a thing once.
  void Note(const std::string& text);
  bool passed() const;
};

std::string ToTable(const Report& report);
std::string ToJson(const Report& report, const std::string& scenario);

}  // namespace alula::scenarios::check

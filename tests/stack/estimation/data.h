#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "stack/estimation/odometry.h"

namespace alula::stack::estimation::test {

/// A folder of the recordings in ALULA_DATA, where it is there.
inline std::optional<std::filesystem::path> DataFolder(const std::string& name) {
  const char* root = std::getenv("ALULA_DATA");
  if (root == nullptr || *root == '\0') return std::nullopt;
  const std::filesystem::path folder = std::filesystem::path(root) / name;
  if (!std::filesystem::exists(folder)) return std::nullopt;
  return folder;
}

/// Rows of a CSV of numbers; the first column, a stamp in ns, apart so that no digit is lost.
struct CsvRow {
  std::int64_t stamp = 0;
  std::vector<double> values;
};
inline std::vector<CsvRow> ReadCsv(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<CsvRow> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    std::string cell;
    CsvRow row;
    for (int i = 0; std::getline(cells, cell, ','); ++i) {
      if (i == 0) {
        row.stamp = std::stoll(cell);
      } else {
        row.values.push_back(std::strtod(cell.c_str(), nullptr));
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

inline std::vector<TimedImu> ReadImu(const std::filesystem::path& file, std::int64_t origin) {
  std::vector<TimedImu> samples;
  for (const CsvRow& r : ReadCsv(file)) {
    samples.push_back({base::Time{r.stamp - origin},
                       {r.values[0], r.values[1], r.values[2]},
                       {r.values[3], r.values[4], r.values[5]}});
  }
  return samples;
}

}  // namespace alula::stack::estimation::test

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "sim/observer.h"
#include "sim/run_fields.h"
#include "stack/interface/calibration.h"

namespace alula::scenarios::replay {

/// All of one step that a digest covers, kept beyond the step (images share their bytes).
struct KeptStep {
  std::int64_t number = 0;
  base::Time begin, end;
  vehicles::BodyState truth;
  std::vector<stack::Measurement> measurements;
  std::optional<stack::StackOutput> output{};  // without what it shows of itself
  std::vector<stack::StackEvent> fault_events{};
  std::vector<base::Transform> X_WR{};  // as sim::StepRecords has them
};
KeptStep Keep(const sim::StepView& step, std::int64_t number);

/// An image's values, shared with the step that it comes from.
struct Pixels {
  std::variant<std::span<const std::uint8_t>, std::span<const std::uint16_t>> values;
  sim::PixelGrid grid;
};

/// A field in words: equal texts are equal hashes and the other way about (−0 reads 0, every NaN reads nan).
struct Field {
  std::string name;
  std::variant<std::string, Pixels> value;
};

struct Record {
  sim::Stream stream{};
  std::string name;
  std::vector<Field> fields;
};

using SensorNames = std::map<stack::SensorId, std::string>;
SensorNames NamesOf(const stack::Calibration& calibration);

/// A step's records in the order of sim::VisitRun. They point into the step's images.
std::vector<Record> NameRecords(const KeptStep& step, const SensorNames& sensors);

}  // namespace alula::scenarios::replay

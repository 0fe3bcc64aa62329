#include "scenarios/replay/compare_steps.h"

#include <fmt/format.h>

#include <algorithm>

namespace alula::scenarios::replay {
namespace {

constexpr std::string_view kSensorNumber = "sensor";

/// What to compare: what was sensed and done, or also how the sensors are numbered.
enum class Strictness { kByName, kByNumber };

/// The values of one pixel: "120", of colour "(12, 40, 7)".
template <typename Value>
std::string PixelText(std::span<const Value> pixel) {
  if (pixel.size() == 1) return std::to_string(pixel[0]);
  std::string text;
  for (const Value value : pixel) text += (text.empty() ? "(" : ", ") + std::to_string(value);
  return text + ")";
}

/// Two images of equal size: the first pixel that differs, rows from the top, and how many do.
template <typename Value>
std::optional<Difference> ComparePixels(std::span<const Value> a, std::span<const Value> b,
                                        const sim::PixelGrid& grid) {
  std::size_t pixels = 0, different = 0;
  Difference found;
  const auto stride = static_cast<std::size_t>(grid.stride), channels = static_cast<std::size_t>(grid.channels);
  for (std::size_t row = 0; row < a.size(); row += stride) {
    for (std::size_t at = row; at < std::min(row + stride, a.size()); at += channels, ++pixels) {
      const std::size_t n = std::min(channels, a.size() - at);
      const auto pixel_a = a.subspan(at, n), pixel_b = b.subspan(at, n);
      if (std::equal(pixel_a.begin(), pixel_a.end(), pixel_b.begin())) continue;
      if (different++ > 0) continue;
      found.field = fmt::format("pixel ({}, {})", (at - row) / channels, row / stride);
      found.a = PixelText(pixel_a);
      found.b = PixelText(pixel_b);
    }
  }
  if (different == 0) return std::nullopt;
  found.note = fmt::format("{} of {} pixels differ", different, pixels);
  return found;
}

std::optional<Difference> CompareImages(const Pixels& a, const Pixels& b) {
  return std::visit(
      [&]<typename A, typename B>(const A& values_a, const B& values_b) -> std::optional<Difference> {
        if constexpr (std::is_same_v<A, B>) {
          if (values_a.size() == values_b.size()) return ComparePixels(values_a, values_b, a.grid);
        }
        Difference found;
        found.field = "bytes";
        found.a = std::to_string(values_a.size_bytes());
        found.b = std::to_string(values_b.size_bytes());
        return found;
      },
      a.values, b.values);
}

std::optional<Difference> CompareFields(const Field& a, const Field& b) {
  const auto* image_a = std::get_if<Pixels>(&a.value);
  const auto* image_b = std::get_if<Pixels>(&b.value);
  if (image_a != nullptr && image_b != nullptr) return CompareImages(*image_a, *image_b);
  const auto text = [](const Field& f) {
    const auto* words = std::get_if<std::string>(&f.value);
    return words != nullptr ? *words : std::string("an image");
  };
  Difference found;
  found.field = a.name == b.name ? a.name : a.name + " / " + b.name;
  found.a = text(a);
  found.b = text(b);
  if (a.name == b.name && found.a == found.b) return std::nullopt;
  return found;
}

/// Records of the same name. Sensors of one name may be of two kinds: then their fields differ in number too.
std::optional<Difference> CompareRecords(const Record& a, const Record& b, Strictness strictness) {
  for (std::size_t i = 0; i < std::min(a.fields.size(), b.fields.size()); ++i) {
    if (strictness == Strictness::kByName && a.fields[i].name == kSensorNumber) continue;
    std::optional<Difference> found = CompareFields(a.fields[i], b.fields[i]);
    if (found) return found;
  }
  if (a.fields.size() == b.fields.size()) return std::nullopt;
  Difference found;
  found.field = "number of fields";
  found.a = std::to_string(a.fields.size());
  found.b = std::to_string(b.fields.size());
  return found;
}

/// What a record that only one run has says: "issued 5.000 s, expires 5.500 s, p_OB.x 0, …".
std::string Summary(const Record& record) {
  std::string text;
  for (const Field& field : record.fields) {
    const auto* words = std::get_if<std::string>(&field.value);
    if (words != nullptr) text += (text.empty() ? "" : ", ") + field.name + " " + *words;
  }
  return text;
}

std::optional<Difference> OnlyInOne(const Record* a, const Record* b) {
  Difference found;
  if (a != nullptr) found.a = Summary(*a);
  if (b != nullptr) found.b = Summary(*b);
  return found;
}

/// Pairs the records of one step and stream by name, in order, and compares each pair.
class Pairing {
 public:
  Pairing(std::span<const Record> a, std::span<const Record> b, Strictness strictness)
      : strictness_(strictness), a_(Pointers(a)), b_(Pointers(b)) {}

  std::optional<Difference> First() {
    while (!a_.empty() || !b_.empty()) {
      const auto partner_of_a = a_.empty() ? b_.end() : Find(b_, a_.front()->name);
      if (!a_.empty() && partner_of_a == b_.end()) return Named(*a_.front(), OnlyInOne(a_.front(), nullptr));
      if (!b_.empty() && Find(a_, b_.front()->name) == a_.end()) {
        return Named(*b_.front(), OnlyInOne(nullptr, b_.front()));
      }
      std::optional<Difference> found = Named(*a_.front(), CompareRecords(*a_.front(), **partner_of_a, strictness_));
      if (!found && strictness_ == Strictness::kByNumber && partner_of_a != b_.begin()) {
        found = Named(*a_.front(), Order(*a_.front(), *b_.front()));
      }
      if (found) return found;
      b_.erase(partner_of_a);
      a_.erase(a_.begin());
    }
    return std::nullopt;
  }

 private:
  using Queue = std::vector<const Record*>;
  static Queue Pointers(std::span<const Record> records) {
    Queue queue;
    for (const Record& record : records) queue.push_back(&record);
    return queue;
  }
  static Queue::iterator Find(Queue& queue, const std::string& name) {
    return std::find_if(queue.begin(), queue.end(), [&name](const Record* record) { return record->name == name; });
  }
  static std::optional<Difference> Named(const Record& record, std::optional<Difference> found) {
    if (found) {
      found->stream = sim::kStreamNames[static_cast<std::size_t>(record.stream)];
      found->record = record.name;
    }
    return found;
  }
  static std::optional<Difference> Order(const Record& a, const Record& b) {
    Difference found;
    found.field = "order";
    found.a = a.name;
    found.b = b.name;
    return found;
  }

  Strictness strictness_;
  Queue a_, b_;
};

std::vector<Record>::const_iterator EndOfStream(const std::vector<Record>& records,
                                                std::vector<Record>::const_iterator begin, sim::Stream stream) {
  return std::find_if(begin, records.end(), [stream](const Record& record) { return record.stream != stream; });
}

/// Streams in the order in which a step goes.
constexpr sim::Stream kCausal[] = {sim::Stream::kMeasurements, sim::Stream::kEstimates, sim::Stream::kCommands,
                                   sim::Stream::kEvents, sim::Stream::kTruth};

std::optional<Difference> CompareStep(const KeptStep& a, const SensorNames& sensors_a, const KeptStep& b,
                                      const SensorNames& sensors_b, Strictness strictness) {
  const std::vector<Record> records_a = NameRecords(a, sensors_a), records_b = NameRecords(b, sensors_b);
  auto at_a = records_a.begin(), at_b = records_b.begin();
  for (const sim::Stream stream : kCausal) {
    const auto end_a = EndOfStream(records_a, at_a, stream), end_b = EndOfStream(records_b, at_b, stream);
    std::optional<Difference> found = Pairing({at_a, end_a}, {at_b, end_b}, strictness).First();
    if (found) {
      found->time = stream == sim::Stream::kTruth ? a.end : a.begin;
      found->step = a.number;
      return found;
    }
    at_a = end_a;
    at_b = end_b;
  }
  return std::nullopt;
}

std::optional<Difference> Compare(const Stretch& a, const Stretch& b, Strictness strictness) {
  const std::size_t both = std::min(a.steps.size(), b.steps.size());
  for (std::size_t i = 0; i < both; ++i) {
    const KeptStep& step_a = a.steps[i];
    const KeptStep& step_b = b.steps[i];
    std::optional<Difference> found = CompareStep(step_a, a.sensors, step_b, b.sensors, strictness);
    if (found) return found;
    if (step_a.end != step_b.end) {
      return Difference{step_a.begin,         step_a.number,        "run", "", "step's end",
                        TimeText(step_a.end), TimeText(step_b.end), ""};
    }
  }
  if (a.steps.size() == b.steps.size()) return std::nullopt;
  const KeptStep& more = (a.steps.size() > both ? a : b).steps[both];
  const auto word = [both](const Stretch& run) { return run.steps.size() > both ? std::string("goes on") : run.end; };
  return Difference{more.begin, more.number, "run", "", "end", word(a), word(b), ""};
}

}  // namespace

std::optional<Difference> CompareSteps(const Stretch& a, const Stretch& b) {
  std::optional<Difference> found = Compare(a, b, Strictness::kByName);
  return found ? found : Compare(a, b, Strictness::kByNumber);
}

}  // namespace alula::scenarios::replay

#include "sim/run_digest.h"

#include "sim/run_fields.h"

namespace alula::sim {
namespace {

/// Takes a record's fields into its stream's hash.
struct HashFields {
  base::RollingHash& hash;

  template <typename T>
  void operator()(std::string_view, const T& value) {
    hash.Add(value);
  }
  void operator()(std::string_view, const Word& word) { hash.Add(word.number); }
  void Flags(std::initializer_list<Flag> flags) {
    std::uint64_t bits = 0;
    int i = 0;
    for (const Flag& flag : flags) bits |= std::uint64_t{flag.on} << i++;
    hash.Add(bits);
  }
  template <typename Matrix>
  void Diagonal(std::string_view, const Matrix& m) {
    for (int i = 0; i < m.rows(); ++i) hash.Add(m(i, i));
  }
  void Pixels(std::span<const std::uint8_t> bytes, const PixelGrid&) { hash.AddBytes(bytes); }
  void Pixels(std::span<const std::uint16_t> numbers, const PixelGrid&) {
    for (const std::uint16_t number : numbers) hash.Add(std::uint64_t{number});
  }
};

struct HashSink {
  RunDigest& digest;

  HashFields Record(Stream stream, const RecordName&) { return {digest[stream]}; }
};

}  // namespace

void RunDigest::Add(const StepView& step) {
  HashSink sink{*this};
  const std::vector<base::Transform> roots = step.actors.RootsOfTick(step.truth.begin, step.time);
  VisitRun(StepRecords{step.truth.at_end, step.measurements, step.output, step.fault_events, roots}, sink);
}

std::string RunDigest::Hex() const {
  base::RollingHash all;
  for (const base::RollingHash& stream : streams) all.Add(stream.value());
  return all.Hex();
}

}  // namespace alula::sim

#include "scenarios/replay/first_difference.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "scenarios/replay/compare_steps.h"
#include "scenarios/replay/flight.h"

namespace alula::scenarios::replay {
namespace {

using Rows = std::vector<sim::DigestRow>;

bool HasRows(const RunCase& run) { return run.recorded && !run.recorded->rows.empty(); }

bool RecordedAsOne(const RunCase& a, const RunCase& b) {
  return a.recorded && b.recorded && !a.recorded->digest.empty() && a.recorded->digest == b.recorded->digest;
}

/// The first interval in which two runs differ; the rows' number where one run's rows begin with all of the other's.
std::size_t FirstInterval(const Rows& a, const Rows& b) {
  const std::size_t both = std::min(a.size(), b.size());
  return static_cast<std::size_t>(
      std::mismatch(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(both), b.begin()).first - a.begin());
}

/// What was flown is what `rows` tell, as far as it was flown.
bool Repeats(const Flight& flight, const Rows& rows) {
  const std::size_t same = FirstInterval(flight.rows, rows);
  return same == flight.rows.size() && (flight.complete ? same == rows.size() : same <= rows.size());
}

/// One line where a run, flown again, is not what was recorded; `interval`: of the flight's rows.
std::optional<std::string> Mismatch(char name, const RunCase& run, const Flight& flight, base::Duration interval) {
  if (!run.recorded) return std::nullopt;
  const Recorded& recorded = *run.recorded;
  const bool comparable = HasRows(run) && run.scenario.config.recorder.digest_interval == interval;
  const bool differs = comparable ? !Repeats(flight, recorded.rows)
                                  : flight.complete && !recorded.digest.empty() && flight.digest != recorded.digest;
  if (!differs) return std::nullopt;
  const std::size_t last = comparable ? FirstInterval(flight.rows, recorded.rows) : 0;
  std::string line = std::string("note: ") + name + ", flown again, is not the run that was recorded";
  if (last > 0) line += " (the same up to " + TimeText(recorded.rows[last - 1].time) + ")";
  line += ": ";
  if (recorded.numeric_class == flight.numeric_class) {
    return line + "another build or a stack that is not deterministic, in the same numeric class (" +
           flight.numeric_class + ")";
  }
  return line + "recorded by numeric class " + recorded.numeric_class + ", flown by " + flight.numeric_class;
}

/// One of the two runs, by the name that it has in what is said.
struct Side {
  char name;
  const RunCase& run;
};

/// The work of CompareRuns once it is known that something has to be flown.
class Search {
 public:
  /// `known`: the run whose digests are had first.
  Search(Side known, Side other)
      : known_(known), other_(other), interval_(known.run.scenario.config.recorder.digest_interval) {}

  std::optional<Difference> First(std::vector<std::string>& notes) {
    bool recorded = HasRows(known_.run);
    Rows rows = recorded ? known_.run.recorded->rows : FlyKnown(notes);
    for (;;) {
      const Flight other = FlyAgain(other_.run, interval_, [&rows](const Rows& so_far) {
        return so_far.size() > rows.size() || so_far.back() != rows[so_far.size() - 1];
      });
      const std::size_t interval = FirstInterval(other.rows, rows);
      const bool same = other.complete && interval == rows.size() && interval == other.rows.size();
      if (same) {
        Say(Mismatch(other_.name, other_.run, other, interval_), notes);
        return std::nullopt;
      }
      const Flight known =
          FlyAgain(known_.run, interval_, [interval](const Rows& so_far) { return so_far.size() > interval; });
      if (Repeats(known, rows)) {
        Say(Mismatch(other_.name, other_.run, other, interval_), notes);
        return Compare(known, other);
      }
      if (!recorded) {
        throw base::FaultError("not_deterministic", std::string(1, known_.name) +
                                                        ", flown twice, gave two runs; a run that does not repeat "
                                                        "itself cannot be compared");
      }
      recorded = false;
      rows = FlyKnown(notes);
    }
  }

 private:
  static void Say(std::optional<std::string> note, std::vector<std::string>& notes) {
    if (note) notes.push_back(std::move(*note));
  }
  Rows FlyKnown(std::vector<std::string>& notes) {
    Flight flight = FlyAgain(known_.run, interval_, [](const Rows&) { return false; });
    Say(Mismatch(known_.name, known_.run, flight, interval_), notes);
    return std::move(flight.rows);
  }
  std::optional<Difference> Compare(const Flight& known, const Flight& other) const {
    const bool known_is_a = known_.name == 'A';
    std::optional<Difference> found =
        known_is_a ? CompareSteps(known.last, other.last) : CompareSteps(other.last, known.last);
    if (!found) throw base::FaultError("replay", "two runs have different digests, but no record of them differs");
    return found;
  }

  Side known_, other_;
  base::Duration interval_;
};

}  // namespace

RunComparison CompareRuns(const RunCase& a, const RunCase& b) {
  RunComparison comparison;
  comparison.config = DifferentKeys(a.scenario.config, b.scenario.config);
  if (RecordedAsOne(a, b)) return comparison;
  const Side side_a{'A', a}, side_b{'B', b};
  const bool begin_with_b = HasRows(b) && !HasRows(a);
  Search search = begin_with_b ? Search(side_b, side_a) : Search(side_a, side_b);
  comparison.first = search.First(comparison.notes);
  return comparison;
}

}  // namespace alula::scenarios::replay

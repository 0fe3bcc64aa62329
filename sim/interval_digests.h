#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/run_digest.h"
#include "sim/run_folder.h"

namespace alula::sim {

/// A run's rolling hashes at one instant.
struct DigestRow {
  base::Time time;
  std::array<std::uint64_t, kStreams> streams{};  // by Stream

  bool operator==(const DigestRow&) const = default;
};

/// The file of a run folder that holds its rows: `time_s` and one column a stream, 16 hexadecimal digits each.
inline constexpr std::string_view kDigestsFile = "digests.csv";

/// Keeps a run's digest and notes its value at the end of every interval of simulated time, and at the run's end: two
/// runs first differ in the first interval whose rows do. Memory does not grow with the run.
class IntervalDigests : public Observer {
 public:
  using Tell = std::function<void(const DigestRow&)>;
  /// `folder`: where digests.csv is written, line by line, so that a run that was killed leaves its whole intervals;
  /// null: no file. `tell`: is called with every row as it is made; may be empty. Throws base::FaultError("disk").
  IntervalDigests(base::Duration interval, const RunFolder* folder, Tell tell);

  std::optional<std::string> Observe(const StepView& step) override;
  /// The last row, where the run did not end with an interval; closes the file.
  void Finish();
  const RunDigest& digest() const { return digest_; }

 private:
  void Note();

  base::Duration interval_;
  Tell tell_;
  RunDigest digest_;
  base::Time next_;   // end of the present interval
  base::Time now_;    // end of the last step
  base::Time noted_;  // of the last row
  std::optional<StreamFile> file_;
};

/// The rows of a digests.csv. What stands after the last line feed was cut off by a kill and is left out. Throws
/// base::InputError.
std::vector<DigestRow> ReadDigests(const std::filesystem::path& file);
/// The same of its text; `name` is for messages.
std::vector<DigestRow> ParseDigests(std::string text, const std::string& name);

}  // namespace alula::sim

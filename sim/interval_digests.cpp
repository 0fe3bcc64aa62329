#include "sim/interval_digests.h"

#include <fmt/format.h>

#include <charconv>
#include <iterator>
#include <sstream>
#include <utility>

#include "base/text_rows.h"

namespace alula::sim {
namespace {

constexpr int kHexDigits = 16;
constexpr int kHex = 16;

std::string Header() {
  std::string line = "time_s";
  for (const std::string_view name : kStreamNames) line += ',' + std::string(name);
  return line;
}

/// Nine decimals: exact to the nanosecond.
std::string Line(const DigestRow& row) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  std::string line = fmt::format("{}.{:09}", row.time.ns / kSecond, row.time.ns % kSecond);
  for (const std::uint64_t hash : row.streams) line += fmt::format(",{:0{}x}", hash, kHexDigits);
  return line + '\n';
}

std::uint64_t Hash(const base::TextRow& row, std::size_t column, std::string_view name) {
  const std::string_view word = row.Word(column, name);
  std::uint64_t hash = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), hash, kHex);
  if (error != std::errc() || end != word.data() + word.size() || word.size() != kHexDigits) {
    row.Fail(name, "'" + std::string(word) + "' is no hash; must be 16 hexadecimal digits");
  }
  return hash;
}

}  // namespace

IntervalDigests::IntervalDigests(base::Duration interval, const RunFolder* folder, Tell tell)
    : interval_(interval), tell_(std::move(tell)), next_(base::Time{} + interval) {
  if (interval.ns <= 0) throw base::InputError("recorder.digest_interval: must be positive");
  if (folder == nullptr) return;
  file_.emplace(folder->PathOf(kDigestsFile));
  file_->Write(Header() + '\n');
}

std::optional<std::string> IntervalDigests::Observe(const StepView& step) {
  digest_.Add(step);
  now_ = step.time;
  if (now_ >= next_) Note();
  return std::nullopt;
}

void IntervalDigests::Note() {
  while (next_ <= now_) next_ += interval_;
  noted_ = now_;
  DigestRow row{now_, {}};
  for (std::size_t i = 0; i < kStreams; ++i) row.streams[i] = digest_.streams[i].value();
  if (file_) file_->Write(Line(row));
  if (tell_) tell_(row);
}

void IntervalDigests::Finish() {
  if (now_ > noted_) Note();
  if (file_) file_->Close();
}

std::vector<DigestRow> ReadDigests(const std::filesystem::path& file) {
  std::ifstream stream = base::OpenText(file);
  return ParseDigests(std::string{std::istreambuf_iterator<char>(stream), {}}, file.string());
}

std::vector<DigestRow> ParseDigests(std::string text, const std::string& name) {
  text.resize(text.rfind('\n') + 1);  // npos + 1 is 0
  if (!text.starts_with(Header() + '\n')) {
    throw base::InputError({name, 1}, "", "is no table of digests; the first line must be " + Header());
  }
  std::istringstream lines(std::move(text));
  std::vector<DigestRow> rows;
  base::ForEachRow(lines, name, [&rows](const base::TextRow& row) {
    if (row.where().line == 1) return;  // the header
    DigestRow digests{row.TimeInSeconds(0, "time_s"), {}};
    for (std::size_t i = 0; i < kStreams; ++i) digests.streams[i] = Hash(row, i + 1, kStreamNames[i]);
    rows.push_back(digests);
  });
  return rows;
}

}  // namespace alula::sim

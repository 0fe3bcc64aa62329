#include "scenarios/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace alula::scenarios {

Progress::Progress(std::string name, std::optional<base::Duration> limit, bool on)
    : name_(std::move(name)), limit_(limit), on_(on), terminal_(::isatty(STDERR_FILENO) != 0) {}

void Progress::Show(base::Time time) {
  if (!on_) return;
  constexpr std::int64_t kPlainPeriod = 10'000'000'000;
  if (!terminal_) {
    if (time.ns % kPlainPeriod == 0) fmt::print(stderr, "{}: {:.0f} s flown\n", name_, time.Seconds());
    return;
  }
  constexpr int kWidth = 40;
  const double share = limit_ ? std::min(1.0, time.Seconds() / limit_->Seconds()) : 0.0;
  const int full = static_cast<int>(share * kWidth);
  fmt::print(stderr, "\r{} [{}{}] {:6.1f} s of at most {:.0f} s ", name_, std::string(full, '#'),
             std::string(kWidth - full, '.'), time.Seconds(), limit_ ? limit_->Seconds() : 0.0);
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::Clear() {
  if (drawn_) fmt::print(stderr, "\r{:100}\r", "");
  drawn_ = false;
}

}  // namespace alula::scenarios

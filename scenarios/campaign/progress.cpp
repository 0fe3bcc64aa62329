#include "scenarios/campaign/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace alula::scenarios::campaign {
namespace {

std::string Rest(const SweepNews& news) {
  if (news.flown == 0) return "";
  const double rate = static_cast<double>(news.flown) / news.seconds;  // runs a second
  return fmt::format(", {:.3g} runs/min, {} left", 60.0 * rate,
                     DurationText(static_cast<double>(news.planned - news.done) / rate));
}

std::string Counts(const SweepNews& news) {
  return fmt::format("{}/{}: {} pass, {} fail, {} fault", news.done, news.planned, news.passes, news.failures,
                     news.faults);
}

}  // namespace

std::string DurationText(double seconds) {
  const auto whole = static_cast<long long>(std::lround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

SweepProgress::SweepProgress(std::string name, bool on, bool names_failures)
    : name_(std::move(name)), on_(on), names_failures_(names_failures), terminal_(::isatty(STDERR_FILENO) != 0) {}

void SweepProgress::Show(const SweepNews& news) {
  if (!on_) return;
  if (!terminal_) return ShowPlain(news);
  constexpr std::size_t kWidth = 30;
  const std::size_t full = news.planned == 0 ? kWidth : news.done * kWidth / news.planned;
  fmt::print(stderr, "\r\033[K{} [{}{}] {}{}", name_, std::string(full, '#'), std::string(kWidth - full, '.'),
             Counts(news), Rest(news));
  std::fflush(stderr);
  drawn_ = true;
}

void SweepProgress::ShowPlain(const SweepNews& news) {
  if (news.row == nullptr) return;
  const Verdict& verdict = news.row->verdict;
  if (names_failures_ && verdict.outcome != Outcome::kPass) {
    fmt::print(stderr, "{}: seed {}: {} ({})\n", name_, verdict.seed, Word(verdict.outcome), FailureOf(verdict));
  }
  constexpr std::size_t kLines = 20;
  const std::size_t reached = news.done * kLines / news.planned;
  if (reached == told_) return;
  told_ = reached;
  fmt::print(stderr, "{}: {}{}\n", name_, Counts(news), Rest(news));
}

void SweepProgress::Clear() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
  drawn_ = false;
}

}  // namespace alula::scenarios::campaign

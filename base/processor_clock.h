#pragma once

#include <ctime>

namespace alula::base {

/// Processor time of the calling thread, ms. For reports alone: it never enters a result.
inline double ProcessorMs() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

}  // namespace alula::base

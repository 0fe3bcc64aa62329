#pragma once

#if defined(__SSE__)
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

namespace alula::scenarios::plugin {

/// Gives the simulation back its rounding. A library that was linked with -ffast-math makes denormal numbers zero for
/// its whole thread when it is loaded, and one may change the mode at any time: truth and digest would change with it.
class KeepFloatState {
 public:
#if defined(__SSE__)
  KeepFloatState() : control_(_mm_getcsr() & ~kFlags) {}
  ~KeepFloatState() {
    if ((_mm_getcsr() & ~kFlags) != control_) _mm_setcsr(control_);
  }

 private:
  static constexpr unsigned kFlags = 0x3f;  // what has happened so far, not how to compute
  unsigned control_;
#else
  KeepFloatState() { std::fegetenv(&state_); }
  ~KeepFloatState() { std::fesetenv(&state_); }

 private:
  std::fenv_t state_;
#endif

 public:
  KeepFloatState(const KeepFloatState&) = delete;
  KeepFloatState& operator=(const KeepFloatState&) = delete;
};

}  // namespace alula::scenarios::plugin

#pragma once

#include <cfenv>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace alula::scenarios::plugin {

/// Gives the simulation back its arithmetic. A library that was linked with -ffast-math makes denormal numbers zero for
/// its whole thread when it is loaded, and one may change the rounding at any time: truth and digest would change.
class KeepFloatState {
 public:
  KeepFloatState() : rounding_(std::fegetround()), control_(Control()) {}
  ~KeepFloatState() {
    if (std::fegetround() != rounding_) std::fesetround(rounding_);
    if (Control() != control_) SetControl(control_);
  }
  KeepFloatState(const KeepFloatState&) = delete;
  KeepFloatState& operator=(const KeepFloatState&) = delete;

 private:
#if defined(__SSE__)
  static constexpr unsigned kFlags = 0x3f;  // what has happened so far, not how to compute
  static unsigned Control() { return _mm_getcsr() & ~kFlags; }
  static void SetControl(unsigned control) { _mm_setcsr(control); }
#else
  static unsigned Control() { return 0; }
  static void SetControl(unsigned) {}
#endif

  int rounding_;
  unsigned control_;
};

}  // namespace alula::scenarios::plugin

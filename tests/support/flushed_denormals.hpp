#pragma once

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace zonal {

/// While it lives, this thread reads denormals as zeros and writes zeros for them, as audio threads do.
class FlushedDenormals {
  public:
#if defined(__SSE__)
    static constexpr bool kIsSupported = true;
    FlushedDenormals() : state_(_mm_getcsr()) { _mm_setcsr(state_ | 0x8040); }
    ~FlushedDenormals() { _mm_setcsr(state_); }
#else
    static constexpr bool kIsSupported = false;
    FlushedDenormals() : state_(0) {}
#endif
    FlushedDenormals(const FlushedDenormals&) = delete;

  private:
    unsigned state_;
};

}  // namespace zonal

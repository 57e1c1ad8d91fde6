#pragma once

#include <cstdint>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace zonal {

/// While it lives, this thread reads denormals as zeros and writes zeros for them, as audio threads do.
class FlushedDenormals {
  public:
    static constexpr bool kIsSupported =
#if defined(__SSE__) || defined(__aarch64__)
        true;
#else
        false;
#endif
    FlushedDenormals() : state_(read()) { write(state_ | kFlush); }
    ~FlushedDenormals() { write(state_); }
    FlushedDenormals(const FlushedDenormals&) = delete;

  private:
#if defined(__SSE__)
    static constexpr std::uint64_t kFlush = 0x8040;  // FTZ and DAZ of MXCSR
    static std::uint64_t read() { return _mm_getcsr(); }
    static void write(std::uint64_t state) { _mm_setcsr(static_cast<unsigned>(state)); }
#elif defined(__aarch64__)
    static constexpr std::uint64_t kFlush = std::uint64_t{1} << 24U;  // FZ of FPCR
    static std::uint64_t read() {
        std::uint64_t state = 0;
        __asm__ volatile("mrs %0, fpcr" : "=r"(state));
        return state;
    }
    static void write(std::uint64_t state) { __asm__ volatile("msr fpcr, %0" : : "r"(state)); }
#else
    static constexpr std::uint64_t kFlush = 0;
    static std::uint64_t read() { return 0; }
    static void write(std::uint64_t) {}
#endif

    std::uint64_t state_;
};

}  // namespace zonal

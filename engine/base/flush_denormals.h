#pragma once
// Flush-to-zero for floats. Embree asks for it on every thread that traces; parallel_for sets it for all work, so that
// the calling thread and the threads of the pool compute the same bits.

#if defined(__SSE2__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

namespace aleph {

/// Sets flush-to-zero and denormals-are-zero for a scope.
class FlushDenormals {
  public:
#if defined(__SSE2__)
    FlushDenormals() : saved_(_mm_getcsr()) {
        _mm_setcsr(saved_ | _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON);
    }
    ~FlushDenormals() {
        _mm_setcsr(saved_);
    }
#else
    FlushDenormals() = default;
#endif
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

  private:
#if defined(__SSE2__)
    unsigned saved_;
#endif
};

}  // namespace aleph

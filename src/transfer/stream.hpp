// Stores that go past the cache, straight to memory, where the processor has them.
#pragma once

#if defined(__SSE2__) && !defined(GEODROP_NO_STREAMING)
#include <emmintrin.h>
#endif

namespace geodrop {

/// to[k] = scale * from[k] for an even `count`; both are aligned to 16 bytes.
inline void stream_scaled(double scale, const double* from, int count, double* to) {
#if defined(__SSE2__) && !defined(GEODROP_NO_STREAMING)
  const __m128d factor = _mm_set1_pd(scale);
  for (int k = 0; k < count; k += 2) _mm_stream_pd(to + k, _mm_mul_pd(factor, _mm_load_pd(from + k)));
#else
  for (int k = 0; k < count; ++k) to[k] = scale * from[k];
#endif
}

/// Streamed stores reach the other threads before what comes after.
inline void finish_streaming() {
#if defined(__SSE2__) && !defined(GEODROP_NO_STREAMING)
  _mm_sfence();
#endif
}

}  // namespace geodrop

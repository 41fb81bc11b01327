// Kernels for several processors. The body of a kernel is compiled for x86-64-v4 (32 vector registers: no spills),
// x86-64-v3 (AVX2, FMA) and the baseline; `flatten` inlines the templates that it calls into each.
//
// All give the same bits but for one choice, made here and not by the compiler (-ffp-contract=off): the sums of the
// transfers round once for each product on v3 and v4, twice on the baseline, which has no such instruction. Without
// any the main case takes 5 % more processor time. Functions of its own for each processor, not target_clones: those
// cannot tell which of them they are, and nothing but the processor chooses among them.
#pragma once

#ifdef __x86_64__
#include <immintrin.h>  // declares the instruction below
#endif

#include <geodrop/base/types.hpp>

namespace geodrop {

enum class KernelLevel { x86_64_v2, x86_64_v3, x86_64_v4 };

/// The level that this process uses: the processor's, or a lower one that the environment variable GEODROP_KERNELS
/// names (x86-64-v2, -v3, -v4). A build for one processor (GEODROP_MARCH, sanitizers, Clang) has no choice.
KernelLevel kernel_level();

/// "x86-64-v4" ...; "one" in a build for one processor.
const char* kernel_level_name();

/// "fused" or "plain": all that the bits of a run depend on, of the above.
const char* kernel_arithmetic();

/// Products are rounded before they are added.
struct PlainArithmetic {
  [[gnu::always_inline]] static void add_product(Vec4& sum, double factor, Vec4 u) { sum += factor * u; }
};

/// A product and its addition are rounded once. Where the processor has no such instruction the C library computes the
/// same bits, slowly.
struct FusedArithmetic {
  [[gnu::always_inline]] static void add_product(Vec4& sum, double factor, Vec4 u) {
#if !defined(GEODROP_ONE_LEVEL) || defined(__FMA__)
    // By name: from four scalar calls g++ 12 does not make one instruction in every place.
    sum = __builtin_ia32_vfmaddpd256(Vec4{factor, factor, factor, factor}, u, sum);
#else
    for (int a = 0; a < 4; ++a) sum[a] = __builtin_fma(factor, u[a], sum[a]);
#endif
  }
};

#ifdef GEODROP_ONE_LEVEL

template <class F>
auto with_level(F&& f) {
  return f(FusedArithmetic{});
}

#else

template <class F>
[[gnu::target("arch=x86-64-v4"), gnu::flatten]] auto on_v4(F& f) {
  return f(FusedArithmetic{});
}
template <class F>
[[gnu::target("arch=x86-64-v3"), gnu::flatten]] auto on_v3(F& f) {
  return f(FusedArithmetic{});
}
template <class F>
[[gnu::flatten]] auto on_v2(F& f) {
  return f(PlainArithmetic{});
}

/// Calls f(arithmetic), compiled for the level in use.
template <class F>
auto with_level(F&& f) {
  switch (kernel_level()) {
    case KernelLevel::x86_64_v4:
      return on_v4(f);
    case KernelLevel::x86_64_v3:
      return on_v3(f);
    case KernelLevel::x86_64_v2:
      break;
  }
  return on_v2(f);
}

#endif

}  // namespace geodrop

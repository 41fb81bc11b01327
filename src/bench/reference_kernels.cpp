// Two kernels that do nothing useful as fast as the machine can: the roofs that all benchmarks are compared with.
#include <geodrop/bench.hpp>
#include <geodrop/types.hpp>

#include "../kernels/chunk.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>

namespace geodrop {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Twelve independent chains of fused multiply-adds hide the latency of one.
GEODROP_KERNEL double multiply_add(long rounds) {
  constexpr int chains = 12;
  Vec4 x[chains];
  const Vec4 a = {0.999, 0.998, 0.997, 0.996}, b = {1e-3, 2e-3, 3e-3, 4e-3};
  for (int c = 0; c < chains; ++c) x[c] = a + static_cast<double>(c);
  for (long r = 0; r < rounds; ++r)
    for (int c = 0; c < chains; ++c) x[c] = x[c] * a + b;
  Vec4 sum{};
  for (const Vec4& value : x) sum += value;
  return sum[0] + sum[1] + sum[2] + sum[3];
}

double measure_gflops(int threads) {
  constexpr long rounds = 4'000'000;
  constexpr double flops_per_round = 12 * 4 * 2;
  double sink = 0;
  const auto start = std::chrono::steady_clock::now();
#pragma omp parallel for num_threads(threads) reduction(+ : sink)
  for (int t = 0; t < threads; ++t) sink += multiply_add(rounds + (t & 1));
  const double seconds = seconds_since(start);
  return sink == 0 ? 0 : flops_per_round * rounds * threads / seconds * 1e-9;
}

double measure_gbytes(int threads) {
  constexpr std::ptrdiff_t n = 1 << 24;
  Array<double> a(n), b(n, 1.0), c(n, 2.0);
  double best = 1e300;
  for (int repeat = 0; repeat < 4; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::ptrdiff_t k = 0; k < n; ++k) a[k] = b[k] + 0.5 * c[k];
    best = std::min(best, seconds_since(start));
  }
  return 3.0 * sizeof(double) * n / best * 1e-9;
}

}  // namespace

MachineRoofs measure_roofs(int threads) {
  MachineRoofs best;
  for (int repeat = 0; repeat < 3; ++repeat) {
    best.gflops = std::max(best.gflops, measure_gflops(threads));
    best.gbytes_s = std::max(best.gbytes_s, measure_gbytes(threads));
  }
  return best;
}

}  // namespace geodrop

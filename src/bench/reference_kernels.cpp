#include "reference_kernels.hpp"

#include "stopwatch.hpp"
#include "transfer/chunk.hpp"

#include <omp.h>

#include <algorithm>

namespace geodrop {
namespace {

/// Twelve independent chains of fused multiply-adds hide the latency of one.
constexpr int chains = 12;

template <class Arithmetic>
double multiply_add(long rounds) {
  Vec4 x[chains];
  const double a = 0.999;
  const Vec4 b = {1e-3, 2e-3, 3e-3, 4e-3};
  for (int c = 0; c < chains; ++c) x[c] = a + static_cast<double>(c) * b;
  for (long r = 0; r < rounds; ++r)
    for (int c = 0; c < chains; ++c) {
      Vec4 next = b;
      Arithmetic::add_product(next, a, x[c]);
      x[c] = next;
    }
  Vec4 sum{};
  for (const Vec4& value : x) sum += value;
  return sum[0] + sum[1] + sum[2] + sum[3];
}

/// The kernels' own instruction set, as the other one.
void triad(double* a, const double* b, const double* c, std::ptrdiff_t n) {
  with_level([&](auto) {
    for (std::ptrdiff_t k = 0; k < n; ++k) a[k] = b[k] + 0.5 * c[k];
  });
}

constexpr std::ptrdiff_t triad_size = 1 << 23;  // 64 MiB an array, twice the last cache of the machine at hand

}  // namespace

ReferenceKernels::ReferenceKernels(int threads)
    : threads_(threads), a_(triad_size, 0.0), b_(triad_size, 1.0), c_(triad_size, 2.0) {}

MachineRoofs ReferenceKernels::sample() {
  constexpr long rounds = 4'000'000;
  constexpr double flops_per_round = chains * 4 * 2;
  MachineRoofs roofs;
  double sink = 0;
  const Stopwatch arithmetic;
#pragma omp parallel for num_threads(threads_) reduction(+ : sink)
  for (int t = 0; t < threads_; ++t)
    sink += with_level([&](auto level) { return multiply_add<decltype(level)>(rounds + (t & 1)); });
  const double gflop = sink == 0 ? 0 : 1e-9 * flops_per_round * rounds * threads_;
  roofs.gflops = gflop / arithmetic.wall_seconds();

  const std::ptrdiff_t share = triad_size / threads_;
  const Stopwatch memory;
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (int t = 0; t < threads_; ++t) triad(a_.data() + t * share, b_.data() + t * share, c_.data() + t * share, share);
  const double gbyte = 1e-9 * 3 * sizeof(double) * static_cast<double>(share) * threads_;
  roofs.gbytes_s = gbyte / memory.wall_seconds();
  return roofs;
}

MachineRoofs best_of(const std::vector<MachineRoofs>& samples) {
  MachineRoofs best;
  for (const MachineRoofs& roofs : samples) {
    best.gflops = std::max(best.gflops, roofs.gflops);
    best.gbytes_s = std::max(best.gbytes_s, roofs.gbytes_s);
  }
  return best;
}

}  // namespace geodrop

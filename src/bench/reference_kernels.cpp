#include "reference_kernels.hpp"

#include "../kernels/chunk.hpp"
#include "stopwatch.hpp"

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

ReferenceSample ReferenceKernels::sample() {
  constexpr long rounds = 4'000'000;
  constexpr double flops_per_round = chains * 4 * 2;
  ReferenceSample sample;
  double sink = 0;
  const Stopwatch arithmetic(threads_);
#pragma omp parallel for num_threads(threads_) reduction(+ : sink)
  for (int t = 0; t < threads_; ++t)
    sink += with_level([&](auto level) { return multiply_add<decltype(level)>(rounds + (t & 1)); });
  const double gflop = sink == 0 ? 0 : 1e-9 * flops_per_round * rounds * threads_;
  sample.wall.gflops = gflop / arithmetic.wall_seconds();
  sample.judged.gflops = gflop / arithmetic.judged_seconds();

  const std::ptrdiff_t share = triad_size / threads_;
  const Stopwatch memory(threads_);
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (int t = 0; t < threads_; ++t) triad(a_.data() + t * share, b_.data() + t * share, c_.data() + t * share, share);
  const double gbyte = 1e-9 * 3 * sizeof(double) * static_cast<double>(share) * threads_;
  sample.wall.gbytes_s = gbyte / memory.wall_seconds();
  sample.judged.gbytes_s = gbyte / memory.judged_seconds();
  return sample;
}

ReferenceSample best_of(const std::vector<ReferenceSample>& samples) {
  ReferenceSample best;
  const auto keep_better = [](MachineRoofs& kept, const MachineRoofs& roofs) {
    kept.gflops = std::max(kept.gflops, roofs.gflops);
    kept.gbytes_s = std::max(kept.gbytes_s, roofs.gbytes_s);
  };
  for (const ReferenceSample& sample : samples) {
    keep_better(best.wall, sample.wall);
    keep_better(best.judged, sample.judged);
  }
  return best;
}

}  // namespace geodrop

// Two kernels that do nothing useful as fast as the machine can: the roofs that all benchmarks are compared with.
#pragma once

#include <geodrop/base/types.hpp>

#include <vector>

namespace geodrop {

/// What the machine can do.
struct MachineRoofs {
  double gflops = 0;    ///< fused multiply-adds on register-resident data, 2 flops each [1e9/s]
  double gbytes_s = 0;  ///< a = b + s c on arrays far larger than the caches, 3 x 8 bytes each [1e9 byte/s]
};

/// Samples of some 10 ms each, to be taken between those of a benchmark: another process that takes a core for a while
/// then slows both.
class ReferenceKernels {
 public:
  explicit ReferenceKernels(int threads);
  MachineRoofs sample();
  int threads() const { return threads_; }

 private:
  int threads_;
  Array<double> a_, b_, c_;
};

/// The best of some samples.
MachineRoofs best_of(const std::vector<MachineRoofs>& samples);

}  // namespace geodrop

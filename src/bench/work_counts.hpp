// Floating-point operations and bytes of a particle-step, counted by hand from the kernels: what turns a speed into a
// fraction of the machine's roofs.
#pragma once

#include "benchmarks.hpp"

namespace geodrop {

/// Work of one particle in one step.
struct WorkCount {
  double flops = 0;  ///< executed, a fused multiply-add as two; divisions and roots as one, comparisons as none
  double bytes = 0;  ///< that must pass to or from memory if no stage finds its data in a cache; a store counts once

  WorkCount& operator+=(const WorkCount& other) {
    flops += other.flops;
    bytes += other.bytes;
    return *this;
  }
  WorkCount operator*(double factor) const { return {flops * factor, bytes * factor}; }
};

WorkCount work_of(const WorkKind& kind);

}  // namespace geodrop

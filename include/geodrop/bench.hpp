// Speed of the whole step, as million particle-steps per second, beside the roofs of the machine.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace geodrop {

/// One row of bench.csv.
struct BenchRow {
  std::string name;
  int dimension = 2;
  std::string basis, material, transfer;
  std::string pressure;  ///< cell or particle
  std::size_t particles = 0;
  int threads = 1;
  double mpps = 0;  ///< million particle-steps per second, median of the repeats
  double mpps_min = 0, mpps_max = 0;
  double ns_per_particle_step = 0;  ///< wall time, all threads together
  double bytes_per_particle = 0;    ///< resident particle data [byte]
  double memory_share = 0;          ///< of the memory roof, if each particle's data moved in and out once a step [-]
  double arithmetic_ratio = 0;      ///< mpps over the reference kernel's million 1000-flop packets per second [-]
  std::string slowest_stage;
};

/// What the machine can do, measured in the same run by small reference kernels on the same number of threads.
struct MachineRoofs {
  double gflops = 0;    ///< fused multiply-adds on register-resident data, 2 flops each [1e9/s]
  double gbytes_s = 0;  ///< a = b + s c on arrays far larger than the caches, 3 x 8 bytes each [1e9 byte/s]
};

struct BenchOptions {
  std::filesystem::path directory;  ///< bench.csv goes here
  int threads = 1;
  bool quick = false;  ///< 1e5 instead of 1e6 particles, fewer repeats
  std::string only;    ///< part of a name; empty: all
};

MachineRoofs measure_roofs(int threads);

/// Runs all benchmarks, prints a table, writes bench.csv. Returns the exit code.
int run_bench(const BenchOptions& options);

}  // namespace geodrop

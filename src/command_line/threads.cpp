#include "threads.hpp"

#include <omp.h>

#include <iostream>

#include "only_if.hpp"

namespace geodrop {

void add_threads(CLI::App& command, int& threads) {
  constexpr int most = 1024;  // far above what pays on any machine, far below what the system refuses without a word
  command.add_option("--threads", threads, "number of threads (default: all cores)")->check(whole_number(most));
}

int choose_threads(int asked) {
  const int cores = omp_get_num_procs();
  if (asked == 0) return cores;
  if (asked > cores)
    std::cerr << "geodrop: warning: " << asked << " threads on " << cores << " cores: slower, same result\n";
  return asked;
}

}  // namespace geodrop

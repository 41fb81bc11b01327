#include "threads.hpp"

#include <omp.h>

#include <iostream>
#include <string>

#include "only_if.hpp"

namespace geodrop {

namespace {

void add(CLI::App& command, int& threads, const std::string& meaning) {
  constexpr int most = 1024;  // far above what pays on any machine, far below what the system refuses without a word
  command.add_option("--threads", threads, meaning)->check(whole_number(most));
}

}  // namespace

void add_threads(CLI::App& command, int& threads) { add(command, threads, "number of threads (default: all cores)"); }

void add_most_threads(CLI::App& command, int& threads) {
  add(command, threads, "threads at most (default: all cores); fewer where they are faster, the result is the same");
}

int choose_threads(int asked) {
  const int cores = omp_get_num_procs();
  if (asked == 0) return cores;
  if (asked > cores)
    std::cerr << "geodrop: warning: " << asked << " threads on " << cores << " cores: slower, same result\n";
  return asked;
}

}  // namespace geodrop

// Jobs that change nothing of each other, at the same time.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <vector>

namespace geodrop {

/// Runs each job on one thread, all at the same time if `apart` says that no two of them change the same, otherwise in
/// their order with all threads. Throws what the first of them in their order throws.
inline void run_side_by_side(const std::vector<std::function<void()>>& jobs, bool apart) {
  std::vector<std::exception_ptr> errors(jobs.size());
#pragma omp parallel for schedule(dynamic, 1) if (apart && jobs.size() > 1)
  for (std::size_t j = 0; j < jobs.size(); ++j) try {
      jobs[j]();
    } catch (...) {
      errors[j] = std::current_exception();
    }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace geodrop

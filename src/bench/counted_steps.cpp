#include "counted_steps.hpp"

namespace geodrop {

// Of a translation unit of their own, without link-time optimisation: the calls stay calls. What follows each body
// keeps it from being left by a jump, which callgrind would not notice.

void counted_steps(const std::function<void()>& run) {
  run();
  asm volatile("" ::: "memory");
}

void end_count() { asm volatile("" ::: "memory"); }

}  // namespace geodrop

// The two functions by whose names callgrind knows which instructions to count, and where a count ends.
#pragma once

#include <functional>

namespace geodrop {

/// Calls `run`; what is executed in it is counted.
void counted_steps(const std::function<void()>& run);

/// Ends the count of a benchmark and begins the next.
void end_count();

/// As callgrind spells them.
inline constexpr const char* counted_steps_name = "geodrop::counted_steps(std::function<void ()> const&)";
inline constexpr const char* end_count_name = "geodrop::end_count()";

}  // namespace geodrop

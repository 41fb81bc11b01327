// Error against work: wall time, particle-steps, memory.
#pragma once

#include "judge.hpp"
#include "plot/chart.hpp"

#include <vector>

namespace geodrop {

/// A picture for each handful of rows with errors at three or more spacings.
std::vector<Chart> work_precision_charts(const std::vector<VerifyRow>& rows);

}  // namespace geodrop

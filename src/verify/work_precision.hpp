// Error against work: wall time, particle-steps, memory.
#pragma once

#include "judge.hpp"
#include "plot/chart.hpp"

#include <string>
#include <vector>

namespace geodrop {

struct WorkPicture {
  std::string name;  ///< of its file, without ending
  Chart chart;
};

/// A picture for each scene that has errors at four or more spacings, named after it, and one for each handful of rows
/// of other scenes with three.
std::vector<WorkPicture> work_precision_pictures(const std::vector<VerifyRow>& rows);

}  // namespace geodrop

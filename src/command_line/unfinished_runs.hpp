// What is drawn of a run that is not over is all that it has written so far: said on stderr.
#pragma once

#include <string>
#include <vector>

namespace geodrop {

void tell_unfinished_runs(const std::vector<std::string>& directories);

}  // namespace geodrop

#include "unfinished_runs.hpp"

#include <iostream>

#include "files/run_record.hpp"

namespace geodrop {

void tell_unfinished_runs(const std::vector<std::string>& directories) {
  for (const std::string& directory : directories)
    if (const auto record = find_run_record(directory); record && record->is_running())
      std::cerr << "note: " << directory
                << " is not over (status running): at work, or killed; this is what it has written so far\n";
}

}  // namespace geodrop

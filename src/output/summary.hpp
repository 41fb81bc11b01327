// summary.json and the tables at the end of a run.
#pragma once

#include <geodrop/output.hpp>

#include <cstdint>
#include <string>

namespace geodrop {

/// What the run was, beside what it gave.
struct RunIdentity {
  int threads = 1;
  std::uint64_t steps = 0;  ///< since t = 0
  double t = 0;             ///< simulated [s]
  std::size_t particles = 0;
};

std::string status_name(RunStatus status);

/// The text of summary.json.
std::string summary_json(const Scene& scene, const RunIdentity& run, const RunStatistics& statistics,
                         const Summary& summary);

}  // namespace geodrop

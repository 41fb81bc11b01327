// summary.json and the tables at the end of a run.
#pragma once

#include <geodrop/files/output.hpp>

#include <cstdint>
#include <string>

namespace geodrop {

/// What the run was, beside what it gave.
struct RunIdentity {
  std::string started, ended;  ///< date and time, UTC; `ended` is empty while it runs
  std::string host, command;
  int threads = 1;
  std::uint64_t steps = 0;  ///< since t = 0
  double t = 0;             ///< simulated [s]
  std::size_t particles = 0;
};

/// Now, in UTC: "2026-03-01T12:00:00Z".
std::string date_and_time();

std::string status_name(RunStatus status);

/// The text of summary.json.
std::string summary_json(const Scene& scene, const RunIdentity& run, const RunStatistics& statistics,
                         const Summary& summary);

}  // namespace geodrop

// Where a run leaves its files, and what becomes of an earlier run's there.
#pragma once

#include <cstddef>
#include <filesystem>
#include <geodrop/files/output.hpp>
#include <geodrop/scene/scene.hpp>
#include <optional>
#include <string>
#include <vector>

#include "run_lock.hpp"

namespace geodrop {

/// `runs/NAME`, NAME that of the scene file without its ending, or the one that was asked for.
std::filesystem::path choose_directory(const Scene& scene, const std::filesystem::path& asked_for);

/// A directory that is this run's alone.
struct RunPlace {
  RunLock lock;
  std::string notice;  ///< what became of an earlier run; empty if there was none
};

/// Makes the directory for a new run. An earlier run's directory becomes NAME.1, NAME.2, ... with all that is in it, or
/// its files are taken out of it. Throws SceneError if `directory` is none, holds files and is not of an earlier run
/// (nobody's data is lost to a mistyped name), or another run is at work there; WriteError if the disk refuses.
RunPlace take_for_new_run(const std::filesystem::path& directory, EarlierRun earlier);

/// Simulated time [s] at which the run in `directory` was done, from its summary; empty if it was not.
std::optional<double> done_at(const std::filesystem::path& directory);

/// Leaves the frames of these times, first in the collections, then on the disk.
void cut_back_frames(const std::filesystem::path& directory, const std::vector<double>& times);

}  // namespace geodrop

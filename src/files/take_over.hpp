// How a run comes by its directory, and a resumed one by its state.
#pragma once

#include <geodrop/files/output.hpp>

#include <filesystem>
#include <optional>

#include "checkpoint_files.hpp"
#include "run_directory.hpp"

namespace geodrop {

/// All that can refuse a run without a look at its checkpoint, then the directory, locked.
RunPlace take_place(const Scene& scene, const RunOptions& options, const std::filesystem::path& directory);

/// The newest good checkpoint (see find_checkpoint) if the run is to be resumed, else nothing. Throws SceneError if it
/// cannot go on from there.
template <int Dim>
std::optional<FoundCheckpoint<Dim>> check_resume(const Scene& scene, const RunOptions& options,
                                                 const std::filesystem::path& directory, const FaultOf<Dim>& fault_of);

}  // namespace geodrop

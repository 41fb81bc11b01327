// Where a run leaves its files, and what may be replaced there.
#pragma once

#include <cstddef>
#include <filesystem>
#include <geodrop/scene.hpp>
#include <optional>

namespace geodrop {

/// runs/<name of the scene file without its ending>, or the one that was asked for.
std::filesystem::path choose_directory(const Scene& scene, const std::filesystem::path& asked_for);

/// Throws SceneError if `directory` is no directory, or holds files and is not of an earlier run: nobody's data is lost
/// to a mistyped name.
void check_replaceable(const std::filesystem::path& directory);

/// Simulated time [s] at which the run in `directory` was done, from its summary; empty if it was not.
std::optional<double> done_at(const std::filesystem::path& directory);

/// Makes the directory, or takes the files of an earlier run out of it and leaves all others. Returns their number.
std::size_t prepare_directory(const std::filesystem::path& directory);

/// Removes the frames from number `first` on. Returns how many files those were.
std::size_t remove_frames(const std::filesystem::path& directory, std::size_t first);

}  // namespace geodrop

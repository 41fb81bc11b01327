// The state in a file, bit for bit, and the hash of a state.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <geodrop/measure/history.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>
#include <string>
#include <vector>

namespace geodrop {

/// What a run has written so far: nothing that the physics depends on, but what a resumed run must continue.
struct OutputRecord {
  std::vector<double> frame_times;        ///< of particles_NNNNNN.vtu, NNNNNN = index [s]
  std::vector<std::vector<double>> rows;  ///< of history.csv
};

template <int Dim>
struct Checkpoint {
  State<Dim> state;
  OutputRecord output;
  std::string warning;  ///< why a resumed run may differ in its last bits, one line; empty: it does not
};

/// What of a state that was read is not as in a run of its scene, in one line; empty: nothing.
template <int Dim>
using FaultOf = std::function<std::string(const State<Dim>&)>;

/// XXH3 over every value of the state in storage order, as 16 hex digits. docs/reproducibility.md: what it depends on.
template <int Dim>
std::string state_hash(const State<Dim>& state);

/// Writes to a temporary file and renames it, so that `path` is always a whole checkpoint. Throws RunError.
template <int Dim>
void write_checkpoint(const std::filesystem::path& path, const Scene& scene, const State<Dim>& state,
                      const OutputRecord& output);

/// Safe whatever the file holds. Throws SceneError (exit code 2) that says why `path` cannot continue this scene:
/// missing, no regular file, not a checkpoint, other format, other scene (with the first key that differs), truncated,
/// damaged. When the scene ends, what it writes and what it is judged by may differ. What the state holds is judged by
/// check_resumable.
template <int Dim>
Checkpoint<Dim> read_checkpoint(const std::filesystem::path& path, const Scene& scene);

}  // namespace geodrop

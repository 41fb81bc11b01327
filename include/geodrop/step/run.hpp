// A whole run: from a checked scene to a run directory.
#pragma once

#include <geodrop/files/output.hpp>
#include <geodrop/scene/scene.hpp>

#include <string>
#include <vector>

namespace geodrop {

/// How a run ended and what it found.
struct RunOutcome {
  RunStatistics statistics;
  Summary summary;
};

/// Runs the scene (or goes on from its checkpoint) and leaves a run directory.
RunOutcome perform_run(const Scene& scene, const RunOptions& options);

/// Runs the scene (or goes on from its checkpoint) and leaves a run directory. Returns the exit code: 0 done, 1 broken
/// (the last frame is kept) or, with `verify`, an expectation not met, 74 the disk does not take its files, 75 stopped
/// with a checkpoint.
int run_scene(const Scene& scene, const RunOptions& options, bool verify);

/// The facts of the scene's first state, see state_facts.
std::vector<Fact> scene_facts(const Scene& scene);

/// What is no mistake, but what the scene's results must not be believed without: a sentence each, printed by `check`
/// and `info` and logged by a run.
std::vector<std::string> scene_notes(const Scene& scene);

/// Throws SceneError if a run would end at its first step: the time step collapses, or a velocity is not finite.
void check_first_step(const Scene& scene);

/// The stages that the scene needs, one line each: name and what it reads and writes.
std::string stages_text(const Scene& scene);

}  // namespace geodrop

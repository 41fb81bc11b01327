#include "initial_state.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/reader/scene_reader.hpp>
#include <geodrop/setup/setup.hpp>

#include <algorithm>
#include <filesystem>

#include "base/text.hpp"
#include "check_resumable.hpp"
#include "files/checkpoint_files.hpp"

namespace geodrop {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& found, const std::string& allowed) {
  throw SceneError(file, {{{}, "start_from", found, allowed, ProblemSource::elsewhere}});
}

/// Whether something of the scene was in the run.
bool shares_a_name(const auto& of_scene, const auto& of_run) {
  return std::ranges::any_of(of_scene, [&](const auto& spec) {
    return std::ranges::any_of(of_run, [&](const auto& part) { return part.name == spec.name; });
  });
}

}  // namespace

template <int Dim>
State<Dim> initial_state(const Scene& scene) {
  if (scene.start_from.empty()) return build_state<Dim>(scene);
  const std::filesystem::path directory = std::filesystem::absolute(scene.start_from).lexically_normal();
  if (!std::filesystem::exists(directory / "scene.toml"))
    refuse(scene.file, '"' + directory.string() + "\", which is no run directory",
           "the directory of a run, from where geodrop is started or as an absolute path");
  const Scene before = read_scene(directory / "scene.toml");
  if (before.dimension != Dim)
    refuse(scene.file, "a run with dimension = " + std::to_string(before.dimension), "one of the same dimension");
  const FoundCheckpoint<Dim> found = find_checkpoint<Dim>(directory, before);
  if (found.name != newest_checkpoint && std::filesystem::exists(directory / newest_checkpoint))
    refuse(directory / newest_checkpoint,
           "a file that is damaged; the checkpoint before it, at t = " + format_number(found.checkpoint.state.t) +
               " s, is good",
           "a good one; without " + std::string(newest_checkpoint) + " the run begins with the one before");
  const State<Dim>& end = found.checkpoint.state;
  const std::string fault = fault_in_state(before, initial_state<Dim>(before), end);
  if (!fault.empty()) refuse(directory, "a checkpoint with " + fault, "a state of the scene of that run");
  const bool any = shares_a_name(scene.bodies, end.bodies) || shares_a_name(scene.membranes, end.membranes);
  if (!any)
    refuse(scene.file, "a run that has no body and no membrane of this scene", "a run with one of the same name");
  return build_state(scene, &end);
}

template State<2> initial_state(const Scene&);
template State<3> initial_state(const Scene&);

}  // namespace geodrop

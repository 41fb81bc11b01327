#include "take_over.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/setup/setup.hpp>

#include "base/text.hpp"
#include "run_report.hpp"
#include "vtk_files.hpp"

namespace geodrop {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& option, const std::string& found,
                         const std::string& allowed) {
  throw SceneError(path.string(), {{{}, option, found, allowed, ProblemSource::elsewhere}});
}

[[noreturn]] void refuse_finished(const std::filesystem::path& directory, double end) {
  refuse(directory, "--resume", "a run that is finished (t = " + format_number(end, time_digits) + " s)",
         "one with a checkpoint and something left to do, e.g. by a later time.end");
}

/// A frame that the disk did not take in the end cannot be made again.
std::string drop_missing_frames(const std::filesystem::path& directory, std::vector<double>& times) {
  const std::size_t recorded = times.size();
  while (!times.empty() && !std::filesystem::exists(directory / frame_file_name("particles", times.size() - 1, "vtu")))
    times.pop_back();
  if (times.size() == recorded) return "";
  return "warning: the frames from number " + std::to_string(times.size()) + " to " + std::to_string(recorded - 1) +
         ", before the checkpoint, are not on the disk; the next one takes the first of these numbers";
}

}  // namespace

RunPlace take_place(const Scene& scene, const RunOptions& options, const std::filesystem::path& directory) {
  check_results(scene);
  if (!options.resume) return take_for_new_run(directory, options.earlier);
  const auto exists = [&](const char* name) { return std::filesystem::exists(directory / name); };
  const bool found = exists(newest_checkpoint) || exists(previous_checkpoint);
  if (const auto end = done_at(directory); end && !found) refuse_finished(directory, *end);
  if (!found)
    refuse(directory / newest_checkpoint, "--resume", "no such file",
           "the directory of a run that has written a checkpoint");
  return {RunLock(directory), ""};
}

template <int Dim>
std::optional<FoundCheckpoint<Dim>> check_resume(const Scene& scene, const RunOptions& options,
                                                 const std::filesystem::path& directory, const FaultOf<Dim>& fault_of) {
  if (!options.resume) return std::nullopt;
  FoundCheckpoint<Dim> found = find_checkpoint<Dim>(directory, scene, fault_of);
  const double t = found.checkpoint.state.t;
  if (const auto end = done_at(directory); end && is_over(scene, found.checkpoint.state))
    refuse_finished(directory, *end);
  if (options.end > 0 && options.end <= t)
    refuse(directory / found.name, "--until", format_number(options.end, time_digits),
           "a time after the checkpoint's, " + format_number(t, time_digits) + " s");
  const std::string missing = drop_missing_frames(directory, found.checkpoint.output.frame_times);
  if (!missing.empty()) found.warning += (found.warning.empty() ? "" : "\n") + missing;
  return found;
}

template std::optional<FoundCheckpoint<2>> check_resume(const Scene&, const RunOptions&, const std::filesystem::path&,
                                                        const FaultOf<2>&);
template std::optional<FoundCheckpoint<3>> check_resume(const Scene&, const RunOptions&, const std::filesystem::path&,
                                                        const FaultOf<3>&);

}  // namespace geodrop
